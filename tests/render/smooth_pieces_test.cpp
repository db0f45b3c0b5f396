// Splines whose pieces are smooth and no polynomials: first roots that their curvature certifies, and what devices make of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lattice/error.h"
#include "render/certified_root.h"
#include "render/reference_renderer.h"
#include "tests/render/device_fixture.h"

namespace quincunx {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::vector<double> crossings(const std::function<ValueAndSlope(double)>& g, double curvature, double end, bool above) {
  std::vector<double> t;
  append_crossings(g, curvature, 0.0, end, above, t);
  EXPECT_EQ(above, g(end).value >= 0.0);
  return t;
}

TEST(CertifiedRoot, FindsEveryCrossingOfASineHoweverLooseTheBound) {
  for (const double looser : {1.0, 3.0, 100.0}) {
    int evaluations = 0;
    const auto g = [&](double t) {
      ++evaluations;
      return ValueAndSlope{std::sin(7.0 * t - 1.0), 7.0 * std::cos(7.0 * t - 1.0)};
    };
    const std::vector<double> found = crossings(g, 49.0 * looser, 3.0, false);
    ASSERT_EQ(found.size(), 7u);
    for (int n = 0; n < 7; ++n) EXPECT_NEAR(found[std::size_t(n)], (1.0 + n * M_PI) / 7.0, 2e-13);
    EXPECT_LT(evaluations, 70 * std::sqrt(looser)) << "converges quadratically";
  }
}

TEST(CertifiedRoot, TellsTwoCrossingsNextToEachOtherFromATouch) {
  for (const double gap : {1e-3, 1e-5, 1e-7}) {
    const auto valley = [&](double t) { return ValueAndSlope{(t - 0.4) * (t - 0.4) - gap * gap, 2.0 * (t - 0.4)}; };
    const std::vector<double> found = crossings(valley, 2.0, 1.0, true);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR(found[0], 0.4 - gap, 1e-9);
    EXPECT_NEAR(found[1], 0.4 + gap, 1e-9);
    const auto above = [&](double t) { return ValueAndSlope{(t - 0.4) * (t - 0.4) + gap * gap, 2.0 * (t - 0.4)}; };
    EXPECT_TRUE(crossings(above, 2.0, 1.0, true).empty());
  }
}

TEST(CertifiedRoot, IsInDoubtNoFartherThanRoundingAsks) {
  // A slope of 1e-9 crosses 0 where it does, however much longer steps may be; a touch within rounding takes few steps.
  const auto line = [](double t) { return ValueAndSlope{1e-9 * (t - 0.3), 1e-9}; };
  std::vector<double> found;
  bool above = false;
  append_crossings(line, 1.0, 1e-16, 1.0, above, found);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0], 0.3, 1e-6);
  int evaluations = 0;
  const auto flat = [&](double t) {
    ++evaluations;
    return ValueAndSlope{1e-16 * std::sin(40.0 * t) + 2e-16, 4e-15 * std::cos(40.0 * t)};
  };
  found.clear(), above = true;
  append_crossings(flat, 1.0, 1e-16, 1.0, above, found);
  EXPECT_TRUE(found.empty());
  EXPECT_LT(evaluations, 10000);
}

TEST(CertifiedRoot, TakesConstantsLinesAndWhatCameBefore) {
  const auto constant = [](double) { return ValueAndSlope{0.0, 0.0}; };
  EXPECT_TRUE(crossings(constant, 0.0, 1.0, true).empty()) << "0 is above";
  EXPECT_THAT(crossings(constant, 0.0, 1.0, false), testing::ElementsAre(0.0));
  const auto line = [](double t) { return ValueAndSlope{t - 0.25, 1.0}; };
  const std::vector<double> one = crossings(line, 0.0, 1.0, false);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_NEAR(one[0], 0.25, 1e-13);
  EXPECT_EQ(crossings(line, 0.0, 0.25, false).size(), 1u) << "a zero at the end is above";
  EXPECT_EQ(crossings(line, 0.0, 0.2, true).size(), 1u) << "it starts below: a crossing at 0";
}

/// Where the ray's value changes sides between dense samples.
std::vector<double> sampled_crossings(const Spline& spline, const Coefficients<double>& c, const Tracer& tracer, const LatticeRay& ray, double isovalue, double step) {
  std::vector<double> found;
  bool above = spline.evaluate(c, tracer.place(ray, 0.0)).value >= isovalue;
  for (double s = step; s < ray.length; s += step) {
    const bool now = spline.evaluate(c, tracer.place(ray, s)).value >= isovalue;
    if (now != above) found.push_back(s - 0.5 * step);
    above = now;
  }
  return found;
}

TEST(CertifiedRoot, MakesTheReferenceFindEveryCrossingOfNoiseThatDenseSamplesFind) {
  constexpr double kStep = 0.002;
  const std::vector<double> isovalues{0.3, 0.5, 0.52};
  const std::unique_ptr<Spline> spline = make_spline("cwlb");
  const Volume volume = random_volume({6, 7, 5}, 5);
  const Coefficients<double> c = spline->coefficients(volume, Spline::Prefilter::automatic);
  const CellBounds bounds = cell_bounds(*spline, spline->coefficients_float(volume, Spline::Prefilter::automatic));
  const Tracer all(*spline, c, isovalues, nullptr, {}), skipping(*spline, c, isovalues, &bounds, {});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const glm::dvec3 far(domain_max(c.lattice, c.extents));
  std::size_t looked = 0;
  for (int n = 0; n < 150; ++n) {
    const glm::dvec3 through = far * glm::dvec3(uniform(random), uniform(random), uniform(random)), direction = random_direction(random);
    const auto ray = clip_ray(ray_space(c.lattice, c.extents, c.world, through - 40.0 * direction), direction);
    if (!ray) continue;
    Tracer::Workspace work;
    RayCost cost;
    std::vector<Crossing> found, skipped;
    all.trace(*ray, work, cost, [&](const Crossing& x) { return found.push_back(x), true; });
    skipping.trace(*ray, work, cost, [&](const Crossing& x) { return skipped.push_back(x), true; });
    ASSERT_EQ(found.size(), skipped.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].s, skipped[i].s);
      EXPECT_NEAR(spline->evaluate(c, all.place(*ray, found[i].s)).value, isovalues[std::size_t(found[i].surface)], 1e-12);
      EXPECT_TRUE(i == 0 || found[i - 1].s <= found[i].s);
    }
    for (int k = 0; k < int(isovalues.size()); ++k)
      for (const double s : sampled_crossings(*spline, c, all, *ray, isovalues[std::size_t(k)], kStep)) {
        ++looked;
        EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const Crossing& x) { return x.surface == k && std::abs(x.s - s) <= kStep; })) << "lost at " << s;
      }
  }
  EXPECT_GT(looked, 800u);
}

TEST(CertifiedRoot, GoesThroughPlateausAndAlongSheetsInFewSteps) {
  // Samples of one value, and an odd field whose isosurface the ray lies in: the surface is above itself, so nothing is crossed. At the border the spline
  // of the latter is not linear: only by symmetry is it 0 along the ray.
  const std::unique_ptr<Spline> spline = make_spline("cwlb");
  for (const bool plateau : {true, false}) {
    const Volume volume = bcc_volume({8, 8, 8}, [&](const glm::dvec3& u) { return plateau ? 0.7 : u.x - u.y; });
    const Coefficients<double> c = spline->coefficients(volume, Spline::Prefilter::automatic);
    const Tracer tracer(*spline, c, std::array{double(plateau ? 0.7f : 0.0f)}, nullptr, {});
    const auto ray = clip_ray(ray_space(c.lattice, c.extents, c.world, {-3.0, -3.0, 2.3}), glm::normalize(glm::dvec3(1.0, 1.0, 0.4)));
    Tracer::Workspace work;
    RayCost cost;
    int count = 0;
    tracer.trace(*ray, work, cost, [&](const Crossing&) { return ++count, true; });
    EXPECT_EQ(count, 0);
    EXPECT_LT(cost.evaluations, plateau ? 20 * cost.steps : 50000);
  }
}

std::string refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

class SmoothPieces : public DeviceTest {
 protected:
  Volume volume_ = bcc_volume({12, 12, 12}, [](const glm::dvec3& u) { return std::sin(0.35 * u.x) * std::cos(0.3 * u.y) + 0.5 * std::sin(0.28 * u.z); });
  Renderer::Config config_;
  SmoothPieces() { config_.spline = "cwlb"; }
};

TEST_F(SmoothPieces, AreMarchedToWhereTheReferenceHasItsFirstRoots) {
  DeviceRenderer device(test_kernels(), volume_, config_);
  ReferenceRenderer reference(volume_, config_);
  for (const char* structure : {"none", "grid"}) {
    Renderer::Request request = request_for(volume_, 0.4, 64);
    request.skip = {.structure = structure, .block = 4, .cell_test = true};
    request.scene.step = 0.1;
    RenderStats stats;
    const Frame truth = reference.render(request, stats);
    request.scene.intersect = Intersect::march;
    const Frame frame = device.render(request, stats);
    int hits = 0, off = 0;
    for (std::size_t p = 0; p < truth.depth.size(); ++p) {
      hits += std::isfinite(truth.depth[p]);
      if (std::isfinite(truth.depth[p]) != std::isfinite(frame.depth[p])) {
        ++off;
        continue;
      }
      if (!std::isfinite(truth.depth[p])) continue;
      const glm::dvec3 a(truth.normal[3 * p], truth.normal[3 * p + 1], truth.normal[3 * p + 2]), b(frame.normal[3 * p], frame.normal[3 * p + 1], frame.normal[3 * p + 2]);
      off += std::abs(truth.depth[p] - frame.depth[p]) > 1e-3 || glm::distance(a, b) > 0.02;
    }
    EXPECT_GT(hits, 1000);
    EXPECT_LE(off, 12) << "edges, where a step of 0.1 loses sheets, and faces of cells, where normals jump";
  }
}

TEST_F(SmoothPieces, HaveNoFirstRootsOnADeviceAndExplainSaysSo) {
  DeviceRenderer device(test_kernels(), volume_, config_);
  Renderer::Request request = request_for(volume_, 0.4, 8);
  RenderStats stats;
  EXPECT_THAT(refusal([&] { device.render(request, stats); }), AllOf(HasSubstr("--intersect: found exact, expected march"), HasSubstr("cwlb")));
  EXPECT_THAT(refusal([&] { device.explain(request); }), HasSubstr("--intersect"));
  request.scene.intersect = Intersect::march;
  for (const Feature& feature : device.explain(request))
    EXPECT_TRUE(feature.name != kExactPart || (!feature.compiled && feature.why.find("no polynomials") != std::string::npos)) << feature.why;
  EXPECT_EQ(default_intersect("", *make_spline("cwlb")), Intersect::march);
  EXPECT_EQ(default_intersect("cpu", *make_spline("cwlb")), Intersect::exact);
  EXPECT_EQ(default_intersect("", *make_spline("bcc7")), Intersect::exact);
  config_.pool_bytes = 1 << 20;
  DeviceRenderer pooled(test_kernels(), std::make_shared<VolumeSource>(volume_), "waves", config_);
  EXPECT_THAT(refusal([&] { pooled.render(request, stats); }), HasSubstr("--pool: found surfaces"));
}

}  // namespace
}  // namespace quincunx
