// The reference where cells are void: against brute force, and where its answer is known.
#include <gtest/gtest.h>

#include "render/reference_renderer.h"
#include "render/void_stretches.h"
#include "tests/render/void_volumes.h"

namespace quincunx {
namespace {

constexpr double kVoid = std::numeric_limits<double>::quiet_NaN();

/// Random rays through the domain, from outside and from inside of it.
std::vector<LatticeRay> random_rays(const Coefficients<double>& c, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const glm::dvec3 far(domain_max(c.lattice, c.extents));
  std::vector<LatticeRay> rays;
  while (int(rays.size()) < count) {
    const glm::dvec3 through = far * glm::dvec3(uniform(random), uniform(random), uniform(random)), direction = random_direction(random);
    const auto ray = clip_ray(ray_space(c.lattice, c.extents, c.world, through - (rays.size() % 3 ? 60.0 : 0.0) * direction), direction);
    if (ray && ray->length > 1.0) rays.push_back(*ray);
  }
  return rays;
}

std::vector<double> crossings_of(const Tracer& tracer, const LatticeRay& ray) {
  std::vector<double> places;
  Tracer::Workspace work;
  RayCost cost;
  tracer.trace(ray, work, cost, [&](const Crossing& crossing) {
    places.push_back(crossing.s);
    return true;
  });
  return places;
}

/// Places between two samples, `step` apart along the ray, neither of which is in a void cell, on different sides.
std::vector<double> sampled_crossings(const Emptied& e, const LatticeRay& ray, double isovalue, double step) {
  const auto place = [&](double s) { return glm::clamp(ray.point(s), glm::dvec3(0.0), glm::dvec3(domain_max(e.volume.lattice, e.volume.extents))); };
  std::vector<double> places;
  bool known = false, above = false;
  for (double s = 0.0; s < ray.length; s += step) {
    const glm::dvec3 u = place(s);
    const bool seen = !e.voids.at(cell_of(u, domain_max(e.volume.lattice, e.volume.extents)));
    const bool now = seen && e.spline->evaluate(e.coefficients, u).value >= isovalue;
    if (seen && known && now != above) places.push_back(s - 0.5 * step);
    known = seen;
    above = now;
  }
  return places;
}

TEST(TracerWithVoids, CrossesWhatDenseSamplesCrossOutsideVoidCellsAndNothingElse) {
  constexpr double kStep = 0.005, kIso = 0.55;
  for (const std::string_view name : spline_names()) {
    std::size_t crossed = 0, passed = 0;
    for (const VoidVolume& v : void_volumes(make_spline(name)->lattice())) {
      const Emptied e(v.volume, name);
      CellBounds bounds = cell_bounds(*e.spline, e.spline->coefficients_float(e.volume, Spline::Prefilter::automatic));
      const Tracer all(*e.spline, e.coefficients, std::array{kIso}, nullptr, {}, &e.voids), skipping(*e.spline, e.coefficients, std::array{kIso}, &bounds, {}, &e.voids);
      VoidStretches stretches;
      for (const LatticeRay& ray : random_rays(e.coefficients, 40, 7)) {
        const std::vector<double> found = crossings_of(all, ray), sampled = sampled_crossings(e, ray, kIso, kStep);
        EXPECT_EQ(crossings_of(skipping, ray), found) << name << ", " << v.name;
        for (const double s : sampled)
          EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](double f) { return std::abs(f - s) <= kStep; })) << name << ", " << v.name << ": lost at " << s;
        stretches.find(ray, glm::ivec3(e.voids.cells), &e.voids);
        for (const double s : found) {
          const glm::dvec3 u = all.place(ray, s);
          EXPECT_NEAR(e.spline->evaluate(e.coefficients, u).value, kIso, 1e-6) << name << ", " << v.name << ": false at " << s;
          EXPECT_FALSE(stretches.touch(s - 1e-9, s + 1e-9) && stretches.touch(s - 1e-6, s - 1e-6) && stretches.touch(s + 1e-6, s + 1e-6)) << "inside a void cell";
        }
        crossed += sampled.size();
        passed += stretches.touch(0.0, ray.length);
        EXPECT_FALSE(v.name == "all" && !found.empty());
      }
    }
    EXPECT_GT(crossed, 150u) << name;
    EXPECT_GT(passed, 60u) << name;
  }
}

/// f = x but for a slab of samples 11 <= x <= 12.
Volume ramp_with_a_slab(LatticeKind lattice) {
  return field_volume(lattice, [](const glm::dvec3& u) { return u.x == 11.0 || u.x == 12.0 ? kVoid : u.x; });
}
/// 0 in front of the slab, 1 behind.
Volume step_with_a_slab(LatticeKind lattice) {
  return field_volume(lattice, [](const glm::dvec3& u) { return u.x == 9.0 || u.x == 10.0 ? kVoid : u.x < 9.0 ? 0.0 : 1.0; });
}

TEST(TracerWithVoids, HitsTheSurfaceBehindAVoidAndIsNotPoisonedBesideIt) {
  for (const std::string_view name : spline_names()) {
    const Emptied e(ramp_with_a_slab(make_spline(name)->lattice()), name);
    for (const Intersect way : {Intersect::exact, Intersect::march})
      for (const double x : {5.5, 16.5, 17.3}) {  // the slab's weights reach from 7 to 16, the border's to 5 (bcc12)
        const Tracer tracer(*e.spline, e.coefficients, std::array{x}, nullptr, {way, 0.3}, &e.voids);
        const auto ray = clip_ray(ray_space(e.volume.lattice, e.volume.extents, e.volume.world, {-4.0, 11.3, 12.4}), {1, 0, 0});
        const std::vector<double> found = crossings_of(tracer, *ray);
        ASSERT_EQ(found.size(), 1u) << name << ' ' << x;
        EXPECT_NEAR(found[0], x, 1e-5) << "the linear field, as if no sample had been missing";
      }
  }
}

TEST(TracerWithVoids, HasNoSurfaceAtTheBorderOfAVoidNorFromOneSideOfItToTheOther) {
  for (const std::string_view name : spline_names()) {
    const Emptied e(step_with_a_slab(make_spline(name)->lattice()), name);
    for (const Intersect way : {Intersect::exact, Intersect::march}) {
      const Tracer tracer(*e.spline, e.coefficients, std::array{0.5}, nullptr, {way, 0.7}, &e.voids), filled(*e.spline, e.coefficients, std::array{0.5}, nullptr, {way, 0.7});
      for (const LatticeRay& ray : random_rays(e.coefficients, 60, 3)) {
        const bool along = ray.point(0.0).x < 5.0 && ray.point(ray.length).x > 14.0;
        EXPECT_TRUE(crossings_of(tracer, ray).empty()) << name;
        EXPECT_TRUE(!along || crossings_of(filled, ray).size() == 1) << "there is one where nothing is void";
      }
    }
  }
}

TEST(TracerWithVoids, TellsWhereARayIsInThem) {
  VoidCells voids{.cells = {8, 1, 1}, .bricks = {2, 1, 1}, .words = {0b1100, 0b0001}, .count = 3};  // cells 2, 3 and 4
  const auto ray = clip_ray(ray_space(LatticeKind::cartesian, {9, 2, 2}, {}, {-1.0, 0.5, 0.5}), {1, 0, 0});
  VoidStretches stretches;
  stretches.find(*ray, {8, 1, 1}, &voids);
  for (const auto& [a, b, expected] : {std::tuple{0.0, 1.9, false}, {0.0, 2.0, true}, {3.0, 3.0, true}, {1.0, 7.0, true}, {5.0, 6.0, true}, {5.1, 8.0, false}})
    EXPECT_EQ(stretches.touch(a, b), expected) << a << ' ' << b;
  stretches.find(*ray, {8, 1, 1}, nullptr);
  EXPECT_FALSE(stretches.touch(0.0, 8.0));
}

}  // namespace
}  // namespace quincunx
