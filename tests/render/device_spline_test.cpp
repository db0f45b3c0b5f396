// The splines' GLSL twins against their double-precision classes: value, gradient, Bernstein coefficients, refined roots.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "shaders/shaders.h"
#include "tests/render/device_fixture.h"

namespace quincunx {
namespace {

/// What the kernel below is asked of one cell, and answers; std430.
struct Question {
  std::array<std::int32_t, 4> cell;
  std::array<float, 4> from, to;  ///< lattice coordinates relative to the centre, in the cell; in one piece
};
struct Answer {
  std::array<float, 4> jet;      ///< gradient and value at `from`
  std::array<float, 4> refined;  ///< gradient and t of one Newton step from `from` along to - from, towards the value at `to`
  std::array<float, 2> value;    ///< at `from`: of the cell, of the place
  float scale;                   ///< SPLINE_SCALE: everything else is that many times the spline's
  std::array<float, 13> b;       ///< Bernstein coefficients along from..to; of pieces that are no polynomials, the value at `to`
};
static_assert(sizeof(Question) == 48 && sizeof(Answer) == 96);

constexpr const char* kSplineKernel = R"(#version 460
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 64) in;
#include "real.glsl"
#include "shared/trace_parameters.h"
#include "coefficients.glsl"
#include "spline.glsl"
struct Question { ivec4 cell; vec4 from, to; };
struct Answer { vec4 jet, refined; float value, value_at, scale, b[13]; };
layout(std430, binding = 20) readonly buffer Questions { Question question[]; };
layout(std430, binding = 21) writeonly buffer Answers { Answer answer[]; };
void main() {
  uint n = gl_GlobalInvocationID.x;
  if (n >= question.length()) return;
  vec3 centre = 0.5 * vec3(parameters.cells.xyz);
  SplineCell cell = spline_cell(question[n].cell.xyz, centre);
  vec3 from = cell_point(cell, question[n].from.xyz, vec3(0.0), 0.0);
#ifndef SPLINE_DEGREE
#define SPLINE_DEGREE 0
#define spline_restrict(cell, order, from, d, offset, b) b[0] = spline_value(cell, from + d, offset)
#endif
  vec3 to = cell_point(cell, question[n].to.xyz, vec3(0.0), 0.0);
  AxisOrder order = coded_order(order_code(axis_order(0.5 * (from + to))));
  float value, t, b[SPLINE_DEGREE + 1];
  vec3 gradient, refined;
  spline_jet(cell, from, OFFSET, value, gradient);
  spline_restrict(cell, order, from, to - from, OFFSET, b);
  spline_refine(cell, order, from, cell.sign * (to - from), b[SPLINE_DEGREE] + OFFSET, 10.0, t, refined);
  answer[n].jet = vec4(gradient, value);
  answer[n].refined = vec4(refined, t);
  answer[n].value = spline_value(cell, from, OFFSET);
  answer[n].value_at = spline_value_at(question[n].from.xyz, centre, OFFSET);
  answer[n].scale = SPLINE_SCALE;
  for (int i = 0; i <= SPLINE_DEGREE; ++i) answer[n].b[i] = b[i];
})";
constexpr double kScaledOffset = 0.375;  // OFFSET

class DeviceSplineTest : public DeviceTest, public ::testing::WithParamInterface<std::string_view> {
 protected:
  std::unique_ptr<Spline> spline_ = make_spline(GetParam());
  Volume volume_;
  Coefficients<float> coefficients_;
  Coefficients<double> same_;  ///< as the kernel has them, rounded
  glm::dvec3 cells_{0.0};

  void SetUp() override {
    volume_ = random_volume({7, 6, 5}, 11);
    volume_.lattice = spline_->lattice();
    auto& samples = std::get<std::vector<float>>(volume_.samples);
    if (volume_.lattice == LatticeKind::cartesian) samples.resize(samples.size() / 2);
    coefficients_ = spline_->coefficients_float(volume_, Spline::Prefilter::automatic);
    same_ = spline_->coefficients(volume_, Spline::Prefilter::automatic);
    same_.data.assign(coefficients_.data.begin(), coefficients_.data.end());
    cells_ = domain_max(volume_.lattice, volume_.extents);
  }

  /// Lattice coordinates.
  glm::dvec3 place(const std::array<float, 4>& p) const { return 0.5 * cells_ + glm::dvec3(p[0], p[1], p[2]); }

  TraceParameters parameters() const {
    TraceParameters p{};
    p.cells = ivec4(glm::ivec3(cells_), 1);
    p.strides = ivec4(int(coefficients_.stride_y()), int(coefficients_.stride_z()), int(coefficients_.stride_coset()),
                      int(coefficients_.number(0, glm::i64vec3(0))));
    return p;
  }

  std::vector<Answer> ask(const std::vector<Question>& questions) const {
    gpu::Device& device = test_kernels()->device();
    const auto files = [&](std::string_view name) {
      return name == "test.comp" ? std::string_view(kSplineKernel) : shader_file(name == "spline.glsl" ? spline_->shader() : name);
    };
    const gpu::KernelSource source{"test.comp",
                                   {{"VOLUME", "1"},
                                    {"COEFFICIENT_BUFFERS", "1"},
                                    {"COEFFICIENT_SHIFT", "0"},
                                    {"OFFSET", std::to_string(kScaledOffset)}}};
    const gpu::Pipeline pipeline = gpu::create_pipeline(device, gpu::compile(device, files, source));
    const auto fill = [&](auto values, gpu::BufferUse use, const char* label) {
      const VkFormat format = use == gpu::BufferUse::texel ? VK_FORMAT_R32_SFLOAT : VK_FORMAT_UNDEFINED;
      const gpu::Buffer buffer = gpu::create_buffer(device, values.size_bytes(), use, label, format);
      gpu::upload(device, buffer, std::as_bytes(values));
      return buffer;
    };
    const TraceParameters p = parameters();
    const gpu::Buffer out = gpu::create_buffer(device, questions.size() * sizeof(Answer), gpu::BufferUse::storage, "answers");
    gpu::dispatch(device, pipeline,
                  {{"uniforms", fill(std::span(&p, 1), gpu::BufferUse::uniform, "parameters")},
                   {"coefficients0", fill(std::span(coefficients_.data), gpu::BufferUse::texel, "coefficients")},
                   {"Questions", fill(std::span(questions), gpu::BufferUse::storage, "questions")},
                   {"Answers", out}},
                  {}, std::uint32_t((questions.size() + 63) / 64));
    std::vector<Answer> answers(questions.size());
    gpu::download(device, out, std::as_writable_bytes(std::span(answers)));
    return answers;
  }
};

// Segments that lie in one piece: from a random place in a random cell at most as far as the first knot plane.
std::vector<Question> random_questions(const Spline& spline, const glm::dvec3& cells, int count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Question> questions;
  while (int(questions.size()) < count) {
    glm::dvec3 u, v;
    glm::ivec3 cell;
    bool in_face = false;
    for (int a = 0; a < 3; ++a) {
      cell[a] = int(uniform(random) * cells[a]);
      // Every third place is in a face of the cell; none is in an edge, where gradients may jump.
      const bool here = !in_face && uniform(random) < 0.125;
      u[a] = cell[a] + (here ? double(uniform(random) < 0.5) : uniform(random));
      in_face = in_face || here;
      v[a] = cell[a] + uniform(random);
    }
    std::vector<double> cuts;
    spline.split(cell, u, v - u, 0.0, 1.0, cuts);
    if (!cuts.empty()) v = u + 0.999 * cuts.front() * (v - u);
    if (glm::distance(u, v) < 0.02) continue;
    Question q{};
    for (int a = 0; a < 3; ++a) q.cell[a] = cell[a], q.from[a] = float(u[a] - 0.5 * cells[a]), q.to[a] = float(v[a] - 0.5 * cells[a]);
    questions.push_back(q);
  }
  return questions;
}

TEST_P(DeviceSplineTest, ComputesWhatTheDoublePrecisionClassDoes) {
  const std::vector<Question> questions = random_questions(*spline_, cells_, 4000);
  const std::vector<Answer> answers = ask(questions);
  const double scale = answers.front().scale, offset = kScaledOffset / scale;
  const std::size_t coefficients = std::size_t(spline_->degree()) + 1;
  double value = 0.0, slope = 0.0, bernstein = 0.0;
  for (std::size_t n = 0; n < questions.size(); ++n) {
    const Question& q = questions[n];
    const Answer& a = answers[n];
    const glm::ivec3 cell(q.cell[0], q.cell[1], q.cell[2]);
    const glm::dvec3 from = place(q.from), to = place(q.to);
    std::vector<double> b(coefficients);
    if (spline_->polynomial()) {
      spline_->restrict_to_segment(same_, cell, from, to, b);
    } else {
      b[0] = spline_->evaluate(same_, from).value;
      bernstein = std::max(bernstein, std::abs(a.b[0] / scale + offset - spline_->evaluate(same_, to).value));
    }
    for (std::size_t i = 0; i < coefficients && spline_->polynomial(); ++i) bernstein = std::max(bernstein, std::abs(a.b[i] / scale + offset - b[i]));
    value = std::max({value, std::abs(a.jet[3] / scale + offset - b[0]), std::abs(a.value[0] / scale + offset - b[0]),
                      std::abs(a.value[1] / scale + offset - b[0])});
    // The gradient of the cell's own polynomial: a face belongs to the next one where it is not smooth.
    const glm::dvec3 inside = from + 1e-9 * (glm::dvec3(cell) + 0.5 - from);
    const Jet truth = spline_->evaluate(same_, inside);
    for (int i = 0; i < 3; ++i) slope = std::max(slope, std::abs(a.jet[i] / scale - truth.gradient[i]));
  }
  // Samples are in [0,1]; the prefilter makes at most five times as much of them, and errors are a few roundings.
  EXPECT_LT(value, 5e-7);
  EXPECT_LT(slope, 5e-7);
  EXPECT_LT(bernstein, 8e-7);
}

TEST_P(DeviceSplineTest, RefinesARootByOneNewtonStepAndGivesTheGradientThere) {
  // From 4 % of a segment beside a root; the error that is left is quadratic.
  std::vector<Question> questions = random_questions(*spline_, cells_, 4000);
  for (Question& q : questions)
    for (int a = 0; a < 3; ++a) q.to[a] = q.from[a] + 0.04f * (q.to[a] - q.from[a]);
  const std::vector<Answer> answers = ask(questions);
  const double scale = answers.front().scale;
  int checked = 0;
  for (std::size_t n = 0; n < questions.size(); ++n) {
    const Question& q = questions[n];
    const glm::dvec3 from = place(q.from), to = place(q.to);
    const glm::dvec3 middle(q.cell[0] + 0.5, q.cell[1] + 0.5, q.cell[2] + 0.5);
    const Jet jet = spline_->evaluate(same_, from + 1e-9 * (middle - from));
    const double drop = spline_->evaluate(same_, to).value - jet.value, along = glm::dot(jet.gradient, to - from);
    const glm::dvec3 reached = from + drop / along * (to - from);
    if (std::abs(along) < 1e-3 || glm::any(glm::greaterThan(glm::abs(reached - middle), glm::dvec3(0.5)))) continue;
    ++checked;
    const Answer& a = answers[n];
    EXPECT_NEAR(a.refined[3], drop / along, 2e-6 / std::abs(along)) << n;
    const Jet there = spline_->evaluate(same_, reached + 1e-9 * (middle - reached));
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a.refined[i] / scale, there.gradient[i], 2e-5 + 5e-6 / std::abs(along)) << n;
  }
  EXPECT_GT(checked, 1000);
}

INSTANTIATE_TEST_SUITE_P(Splines, DeviceSplineTest, ::testing::ValuesIn(spline_names()),
                         [](const auto& instance) {
                           std::string name(instance.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace quincunx
