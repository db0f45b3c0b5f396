// The judge of stability is judged: by pictures that are right, and by pictures made wrong in every way that it tells apart.
#include "bench/judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "render/reference.h"

namespace quincunx {
namespace {

constexpr float kNoHit = std::numeric_limits<float>::infinity();

/// A ball of radius 10 in a domain of 31 cells, and the reference's picture of it.
class JudgeTest : public ::testing::TestWithParam<std::string_view> {
 protected:
  std::unique_ptr<Spline> spline_ = make_spline(GetParam());
  Coefficients<double> coefficients_;
  Scene scene_;
  Frame frame_;

  void SetUp() override {
    const LatticeKind lattice = spline_->lattice();
    Volume volume{lattice, lattice == LatticeKind::bcc ? Extents(16) : Extents(32), {}, std::vector<float>{}, {}};
    std::vector<float> samples;
    const int step = lattice_step(lattice);
    for (int c = 0; c < coset_count(lattice); ++c)
      for (std::int64_t k = 0; k < volume.extents.z; ++k)
        for (std::int64_t j = 0; j < volume.extents.y; ++j)
          for (std::int64_t i = 0; i < volume.extents.x; ++i) {
            const glm::dvec3 d = double(step) * glm::dvec3(i, j, k) + double(c) - 15.5;
            samples.push_back(float(100.0 - glm::dot(d, d)));
          }
    volume.samples = samples;
    coefficients_ = spline_->coefficients(volume, Spline::Prefilter::automatic);
    scene_.isosurfaces = {Isosurface{}};
    scene_.width = scene_.height = 40;
    scene_.camera = framing_camera(lattice, volume.extents, volume.world, {30.0, 20.0, 1.0}, 40, 40);
    frame_ = render_reference(*spline_, coefficients_, scene_, nullptr);
  }

  Verdict judge(const Frame& frame) const { return Judge(*spline_, coefficients_, scene_, nullptr).judge(frame, {}); }
  /// A pixel of the ball's middle.
  static constexpr std::size_t kMiddle = 20 * 40 + 20;
};

TEST_P(JudgeTest, PassesTheReferencesOwnPicture) {
  const Verdict v = judge(frame_);
  EXPECT_TRUE(v.passed());
  EXPECT_EQ(v.rays, 1600u);
  EXPECT_GT(v.expected, 150u);
  EXPECT_EQ(v.hits, v.expected);
  EXPECT_EQ(v.undecided, 0u);
  EXPECT_LT(v.depth, 1e-5);
  EXPECT_LT(v.residual, 0.5);
}

TEST_P(JudgeTest, SeesAHole) {
  frame_.depth[kMiddle] = kNoHit;
  const Verdict v = judge(frame_);
  EXPECT_EQ(v.holes, 1u);
  EXPECT_FALSE(v.passed());
}

TEST_P(JudgeTest, SeesAHitBehindTheFirstOne) {
  // Where the ray leaves the ball again, right on the surface.
  frame_.depth[kMiddle] += 17.0f;
  const Verdict v = judge(frame_);
  EXPECT_EQ(v.wrong, 1u);
  EXPECT_FALSE(v.passed());
}

TEST_P(JudgeTest, SeesAHitBesideTheSurfaceAndOneWhereThereIsNone) {
  frame_.depth[kMiddle] -= 2e-3f;
  Verdict v = judge(frame_);
  EXPECT_GT(v.residual, 1.0);
  EXPECT_FALSE(v.passed());
  EXPECT_GT(v.depth, 1e-3);

  frame_ = render_reference(*spline_, coefficients_, scene_, nullptr);
  frame_.depth[0] = frame_.depth[kMiddle];  // a corner of the picture, where the ray may pass the domain but no ball
  frame_.normal[2] = 1.0f;
  const bool meets = clip_ray(ray_space(coefficients_.lattice, coefficients_.extents, coefficients_.world, scene_.camera.eye),
                              pixel_direction(camera_frame(scene_.camera, 40, 40), 40, 40, 0, 0)).has_value();
  v = judge(frame_);
  EXPECT_EQ(meets ? v.wrong : v.undecided, 1u);
}

TEST_P(JudgeTest, SeesATurnedNormalAndOneThatIsNoUnitVector) {
  const std::size_t n = 3 * kMiddle;
  const glm::dvec3 normal(frame_.normal[n], frame_.normal[n + 1], frame_.normal[n + 2]);
  const glm::dvec3 aside = glm::normalize(glm::cross(normal, glm::dvec3(0.3, 0.5, 0.8)));
  const glm::dvec3 turned = glm::normalize(normal + 0.02 * aside);
  for (int a = 0; a < 3; ++a) frame_.normal[n + a] = float(turned[a]);
  const Verdict v = judge(frame_);
  EXPECT_GT(v.normal_part, 1.0);
  EXPECT_NEAR(v.normal, std::atan(0.02) * 180.0 / M_PI, 0.02);
  EXPECT_FALSE(v.passed());
  for (int a = 0; a < 3; ++a) frame_.normal[n + a] = 0.0f;
  EXPECT_EQ(judge(frame_).not_finite, 1u);
}

TEST_P(JudgeTest, SeesNaN) {
  frame_.color[4 * kMiddle + 1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(judge(frame_).not_finite, 1u);
  EXPECT_FALSE(judge(frame_).passed());
}

INSTANTIATE_TEST_SUITE_P(Splines, JudgeTest, ::testing::ValuesIn(spline_names()), [](const auto& instance) {
  std::string name(instance.param);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

/// A plane of rays along x at heights about a sheet that they graze: f = z - 15.25 - 1e-9 (x - 15.5)^2 would be decided by rounding.
TEST(Judge, ExcusesWhatRoundingMayDecideAndNothingMore) {
  const auto spline = make_spline("tricubic");
  const auto picture_of = [&](double height) {
    Volume volume{LatticeKind::cartesian, Extents(32), {}, std::vector<float>{}, {}};
    std::vector<float> samples;
    for (int k = 0; k < 32; ++k)
      for (int j = 0; j < 32; ++j)
        for (int i = 0; i < 32; ++i) samples.push_back(float((i - 15.5) * (i - 15.5)));
    volume.samples = samples;
    const auto coefficients = spline->coefficients(volume, Spline::Prefilter::automatic);
    Scene scene;
    scene.width = scene.height = 4;
    scene.isosurfaces = {Isosurface{.isovalue = height}};
    scene.camera = {{-40.0, 15.5, 15.5}, {15.5, 15.5, 15.5}, {0, 0, 1}, 5.0};
    Frame none = render_reference(*spline, coefficients, scene, nullptr);
    for (float& depth : none.depth) depth = kNoHit;
    return Judge(*spline, coefficients, scene, nullptr).judge(none, {});
  };
  // The parabola's vertex below the isovalue by less than rounding: nothing need be seen. By more: holes.
  const Verdict within = picture_of(1e-6), beyond = picture_of(1e-2);
  EXPECT_EQ(within.expected, 16u);
  EXPECT_EQ(within.undecided, 16u);
  EXPECT_TRUE(within.passed());
  EXPECT_EQ(beyond.holes, 16u);
}

TEST(Judge, TakesTheLargestCoefficientNearAPlace) {
  // The apron tells how far samples reach: of bcc7, of bcc12, on the Cartesian lattice. Four or five cells away one does not.
  for (const auto& [lattice, apron, away] : {std::tuple{LatticeKind::bcc, 1, 4.5}, {LatticeKind::bcc, 2, 5.5}, {LatticeKind::cartesian, 1, 4.5}}) {
    Coefficients<double> c;
    c.lattice = lattice;
    c.extents = Extents(12);
    c.apron = apron;
    c.data.assign(std::size_t(coset_count(lattice) * c.stride_coset()), 3.0);
    c.data[c.number(0, {6, 6, 6})] = -50.0;
    const double at = 6.0 * lattice_step(lattice);
    EXPECT_EQ(local_magnitude(c, glm::dvec3(at + 0.5), 0.0), 50.0);
    EXPECT_EQ(local_magnitude(c, glm::dvec3(at + 0.5), 1.0), 51.0);
    EXPECT_EQ(local_magnitude(c, glm::dvec3(at + away), 1.0), 2.0);
    EXPECT_EQ(local_magnitude(c, glm::dvec3(0.0), 0.0), 3.0);
  }
}

}  // namespace
}  // namespace quincunx
