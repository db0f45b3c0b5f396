// The reference of direct volume rendering against closed forms and fine sums of the emission-absorption integral.
#include "render/reference_volume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "tests/render/volumes.h"

namespace quincunx {
namespace {

using Function = std::function<double(const glm::dvec3&)>;

const glm::dvec3 kColor{0.9, 0.5, 0.2};

/// A spline through f (lattice coordinates), 24 cells or so along each axis, and a ray through it.
struct Line {
  std::unique_ptr<Spline> spline;
  Coefficients<double> coefficients;
  glm::dvec3 direction;  ///< unit, world
  LatticeRay ray;

  Line(std::string_view name, const Function& f) : spline(make_spline(name)) {
    const World world{.origin = {2.0, -1.0, 0.5}, .axes = glm::dmat3(0.7, 0.1, 0.0, -0.1, 0.9, 0.2, 0.0, 0.1, 0.8)};
    const bool bcc = spline->lattice() == LatticeKind::bcc;
    const Volume volume = bcc ? bcc_volume({13, 13, 13}, f, world) : cartesian_volume({25, 25, 25}, f, world);
    coefficients = spline->coefficients(volume, Spline::Prefilter::none);
    const glm::dvec3 eye = world.to_world({10.0, 9.0, -7.0});
    direction = glm::normalize(world.to_world({13.0, 14.0, 27.0}) - eye);
    ray = *clip_ray(ray_space(coefficients.lattice, coefficients.extents, world, eye), direction);
  }

  double value(double s) const {
    return spline->evaluate(coefficients, glm::clamp(ray.point(s), glm::dvec3(0.0), glm::dvec3(domain_max(coefficients.lattice, coefficients.extents)))).value;
  }
  double world_length() const { return ray.length * ray.scale; }
  double cell() const { return cell_length(coefficients.world); }

  Composite seen(DirectVolume volume, double stretches, int i = 0, int j = 0) const {
    volume.step = world_length() / stretches / cell();
    const ReferenceVolume reference(*spline, coefficients, volume, 0.3);
    ReferenceVolume::March march = reference.begin(i, j);
    Composite composite;
    RayCost cost;
    reference.integrate(ray, direction, ray.length, march, composite, cost);
    return composite;
  }
};

/// Opacities between these points, of one colour, without light.
DirectVolume look_of(std::vector<TransferFunction::OpacityPoint> opacities, Classify classify = Classify::post) {
  DirectVolume volume;
  volume.function = {{{0.0, kColor}}, std::move(opacities), 3.0};
  volume.classify = classify;
  volume.shade = false;
  volume.termination = 0.0;
  return volume;
}

/// The transmittance of a line of `length` along which the opacity of a `unit` goes from a to b linearly, a part `modulation` of its extinction:
/// exp of the integral of ln(1 - opacity) / unit, which is p ln p - p between p = 1 - a and 1 - b over their difference.
double linear_transmittance(double a, double b, double length, double unit, double modulation = 1.0) {
  const auto antiderivative = [](double p) { return p * std::log(p) - p; };
  const double p = 1.0 - a, q = 1.0 - b;
  return std::exp(modulation * length / unit * (antiderivative(q) - antiderivative(p)) / (q - p));
}

/// Colour and transmittance by the definition, in 2^18 parts. `opacity` of a unit and `color` by value.
Composite fine_sum(const Line& line, double unit, const std::function<double(double)>& opacity, const std::function<glm::dvec3(double)>& color) {
  constexpr int kParts = 1 << 18;
  Composite sum;
  const double length = line.world_length() / kParts;
  double depth = 0.0;
  for (int n = 0; n < kParts; ++n) {
    const double v = line.value(line.ray.length * (n + 0.5) / kParts), thickness = -std::log(1.0 - opacity(v)) * length / unit;
    sum.color += std::exp(-depth - 0.5 * thickness) * thickness * color(v);
    depth += thickness;
  }
  sum.transmittance = std::exp(-depth);
  return sum;
}

double error_of(const Composite& seen, const Composite& truth) {
  const glm::dvec3 color = glm::abs(seen.color - truth.color);
  return std::max({color.r, color.g, color.b, std::abs(seen.transmittance - truth.transmittance)});
}

/// By which power of the stretches' length errors fall, from the first to the last of stretches halved again and again.
double order_of(const std::vector<double>& errors) { return std::log2(errors.front() / errors.back()) / double(errors.size() - 1); }

constexpr double kRise = 0.37;
double slanted(const glm::dvec3& u) { return 1.5 + 0.02 * u.x - 0.05 * u.y + kRise * u.z; }

TEST(ReferenceVolume, ConvergesToTheClosedFormOfALinearFieldWithOrderTwo) {
  for (const char* name : {"trilinear", "tricubic", "bcc7"}) {
    const Line line(name, slanted);
    // Opacity where all three splines are slanted alike: away from the border.
    const double first = line.value(0.125 * line.ray.length), middle = line.value(0.5 * line.ray.length), last = line.value(0.875 * line.ray.length);
    const DirectVolume volume = look_of({{first, 0.0}, {middle, 0.8}, {last, 0.0}});
    const double half = 0.375 * line.world_length();
    Composite truth;
    truth.transmittance = linear_transmittance(0.0, 0.8, half, 3.0) * linear_transmittance(0.8, 0.0, half, 3.0);
    truth.color = (1.0 - truth.transmittance) * kColor;
    std::vector<double> errors;
    for (const int n : {16, 32, 64, 128, 256}) errors.push_back(error_of(line.seen(volume, n), truth));
    EXPECT_NEAR(order_of(errors), 2.0, 0.05) << name;
    EXPECT_LT(errors.front(), 0.01) << name;

    // Pre-integrated: no error but that of its 256 parts a stretch, however long.
    DirectVolume exact = volume;
    exact.classify = Classify::pre_integrated;
    for (const int n : {8, 16, 256}) EXPECT_LT(error_of(line.seen(exact, n), truth), 1e-6) << name << ", " << n << " stretches";
  }
}

TEST(ReferenceVolume, CutsStretchesWithoutAnError) {
  // Where the domain or a surface ends a stretch, its part has the opacity of its length.
  const Line line("trilinear", slanted);
  const double begin = line.value(0.0), end = line.value(line.ray.length);
  const DirectVolume volume = look_of({{begin, 0.9}, {end, 0.7}}, Classify::pre_integrated);
  const double truth = linear_transmittance(0.9, 0.7, line.world_length(), 3.0);
  for (const double n : {0.3, 1.0, 1.5, 3.3, 10.7}) EXPECT_NEAR(line.seen(volume, n).transmittance, truth, 2e-5) << n;
}

TEST(ReferenceVolume, ConvergesToAFineSumOnACurvedField) {
  const Function waves = [](const glm::dvec3& u) { return 0.5 + 0.4 * std::sin(0.45 * u.z + 0.2 * u.x) * std::cos(0.1 * u.y); };
  const auto peak = [](double v) { return std::max(0.0, 0.9 - std::abs(v - 0.55) * (0.9 / 0.12)); };
  const auto tint = [](double v) { return glm::mix(glm::dvec3(0.9, 0.2, 0.1), glm::dvec3(0.1, 0.3, 0.8), std::clamp((v - 0.4) / 0.3, 0.0, 1.0)); };
  std::printf("%-10s %10s %12s %12s %12s\n", "spline", "stretch", "post", "adaptive", "pre");
  for (const char* name : {"bcc7", "tricubic"}) {
    const Line line(name, waves);
    DirectVolume volume = look_of({{0.43, 0.0}, {0.55, 0.9}, {0.67, 0.0}});
    volume.function.colors = {{0.4, {0.9, 0.2, 0.1}}, {0.7, {0.1, 0.3, 0.8}}};
    const Composite truth = fine_sum(line, 3.0, peak, tint);
    DirectVolume pre = volume, adaptive = volume;
    pre.classify = Classify::pre_integrated;
    adaptive.adaptive = true;
    adaptive.finest = 0.05;
    std::vector<double> post_errors, pre_errors;
    for (int n = 32; n <= 512; n *= 2) {
      // The mean over places of the stretches, which single errors depend on.
      double errors[3] = {};
      for (int shift = 0; shift < 16; ++shift) {
        const double stretches = n * (1.0 + 0.002 * shift);
        errors[0] += error_of(line.seen(volume, stretches), truth) / 16.0;
        errors[1] += error_of(line.seen(adaptive, stretches), truth) / 16.0;
        errors[2] += error_of(line.seen(pre, stretches), truth) / 16.0;
      }
      std::printf("%-10s %10.4f %12.3e %12.3e %12.3e\n", name, line.ray.length / n, errors[0], errors[1], errors[2]);
      post_errors.push_back(errors[0]);
      pre_errors.push_back(errors[2]);
      EXPECT_LT(errors[1], 1.05 * errors[0]) << name << ", " << n;
      EXPECT_LT(errors[2], errors[0]) << name << ", " << n;
    }
    EXPECT_NEAR(order_of(post_errors), 2.0, 0.3) << name;
    EXPECT_NEAR(order_of(pre_errors), 2.0, 0.3) << name;
  }
}

TEST(ReferenceVolume, ModulatesTheExtinctionByTheGradient) {
  const Line line("trilinear", slanted);
  const double size = glm::length(line.coefficients.world.gradient_to_world({0.02, -0.05, kRise}));
  const double begin = line.value(0.0), end = line.value(line.ray.length);
  for (const double part : {0.0, 0.3, 1.0}) {
    DirectVolume volume = look_of({{begin, 0.6}, {end, 0.9}});
    volume.modulate_from = size - part, volume.modulate_to = size - part + 1.0;
    if (volume.modulate_from < 0.0) volume.modulate_from = 0.0, volume.modulate_to = size / part;
    Composite truth;
    truth.transmittance = linear_transmittance(0.6, 0.9, line.world_length(), 3.0, part);
    truth.color = (1.0 - truth.transmittance) * kColor;
    std::vector<double> errors;
    for (const int n : {16, 32, 64, 128}) errors.push_back(error_of(line.seen(volume, n), truth));
    EXPECT_LT(errors.front(), 2e-3) << part;
    if (part > 0.0) {
      EXPECT_NEAR(order_of(errors), 2.0, 0.1) << part;
    }
  }
}

TEST(ReferenceVolume, IsLitAsSurfacesAre) {
  const Line line("trilinear", slanted);
  DirectVolume volume = look_of({{0.0, 0.4}, {1.0, 0.4}});
  const Composite plain = line.seen(volume, 20);
  volume.shade = true;
  const Composite lit = line.seen(volume, 20);
  const glm::dvec3 n = glm::normalize(line.coefficients.world.gradient_to_world({0.02, -0.05, kRise}));
  const double left = 0.3 + 0.7 * std::abs(glm::dot(n, line.direction));
  EXPECT_DOUBLE_EQ(lit.transmittance, plain.transmittance);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(lit.color[c], left * plain.color[c], 1e-7);
}

TEST(ReferenceVolume, ShiftsTheStretchesOfEachPixelByAPartOfOne) {
  const Line line("trilinear", slanted);
  DirectVolume volume = look_of({{0.0, 0.1}, {10.0, 0.9}});
  volume.jitter = 7;
  const ReferenceVolume reference(*line.spline, line.coefficients, volume, 0.3);
  std::vector<double> shifts;
  for (int j = 0; j < 40; ++j)
    for (int i = 0; i < 40; ++i) shifts.push_back(reference.begin(i, j).shift);
  std::sort(shifts.begin(), shifts.end());
  EXPECT_GE(shifts.front(), 0.0);
  EXPECT_LT(shifts.back(), 1.0);
  for (std::size_t n = 0; n < shifts.size(); ++n)  // Kolmogorov's distance from uniform: 1.63 / sqrt(1600) in one of 100 cases
    EXPECT_NEAR(shifts[n], double(n) / double(shifts.size()), 0.041);
  DirectVolume other = volume;
  other.jitter = 8;
  EXPECT_NE(ReferenceVolume(*line.spline, line.coefficients, other, 0.3).begin(3, 4).shift, reference.begin(3, 4).shift);

  const Composite truth = line.seen(look_of({{0.0, 0.1}, {10.0, 0.9}}), 4096);
  for (int i = 0; i < 20; ++i) EXPECT_LT(error_of(line.seen(volume, 64, i, 1), truth), 1e-3);
}

TEST(ReferenceVolume, EndsWhereNothingMoreCanBeSeen) {
  const Line line("trilinear", slanted);
  DirectVolume volume = look_of({{0.0, 0.9}, {10.0, 0.9}});
  const double left = std::pow(0.1, line.world_length() / 64 / 3.0);  // by one stretch
  volume.termination = 0.01;
  const double transmittance = line.seen(volume, 64).transmittance;
  EXPECT_LE(transmittance, 0.01);
  EXPECT_GT(transmittance, 0.01 * left * 0.999);
  volume.termination = 0.0;
  EXPECT_NEAR(line.seen(volume, 64).transmittance, std::pow(left, 64), 1e-12);
}

TEST(ReferenceVolume, SaysWhereHalfOfWhatIsBehindIsHidden) {
  const Line line("trilinear", slanted);
  DirectVolume volume = look_of({{0.0, 0.9}, {10.0, 0.9}});
  const double stretch = line.world_length() / 64;
  volume.step = stretch / line.cell();
  const ReferenceVolume reference(*line.spline, line.coefficients, volume, 0.3);
  ReferenceVolume::March march = reference.begin(0, 0);
  Composite composite;
  RayCost cost;
  reference.integrate(line.ray, line.direction, line.ray.length, march, composite, cost);
  ASSERT_TRUE(march.half);
  const double half = 3.0 * std::log(0.5) / std::log(0.1);
  EXPECT_GE(*march.half * line.ray.scale, half - 1e-9);
  EXPECT_LT(*march.half * line.ray.scale, half + stretch);
}

}  // namespace
}  // namespace quincunx
