// The exact caster against a search that knows nothing of polynomials: values and a bound of the slope.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "volumes.h"

namespace quincunx {
namespace {

/// A bound of |grad s| for coefficients within +-1: the largest sum of |grad M(u - j)| met at random u, and a tenth more.
double slope_bound(const Spline& spline) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0.0, 2.0);
  double largest = 0.0;
  for (int trial = 0; trial < 300; ++trial) {
    const glm::dvec3 u(uniform(random), uniform(random), uniform(random));
    double sum = 0.0;
    for (int x = -4; x <= 5; ++x)
      for (int y = -4; y <= 5; ++y)
        for (int z = -4; z <= 5; ++z)
          if ((x & 1) == (y & 1) && (y & 1) == (z & 1))
            sum += glm::length(spline.generator(u - glm::dvec3(x, y, z)).gradient);
    largest = std::max(largest, sum);
  }
  return 1.1 * largest;
}

/// The changes of side of f along [0, length], found by halving until the slope bound excludes another.
class Search {
 public:
  static constexpr double kWidth = 1e-6;
  std::vector<double> found;  ///< within kWidth
  bool doubtful = false;      ///< f comes so near to 0 somewhere that the bound cannot tell

  Search(std::function<double(double)> f, double slope, double length) : f_(std::move(f)), slope_(slope) {
    search(0.0, f_(0.0), length, f_(length));
    judge();
  }

 private:
  /// An interval of at most kWidth that the bound does not clear.
  struct Open {
    double a, b;
    bool changes;
  };

  void search(double a, double fa, double b, double fb) {
    const bool same = (fa >= 0.0) == (fb >= 0.0);
    if (same && std::abs(fa) + std::abs(fb) > slope_ * (b - a)) return;
    if (b - a <= kWidth) {
      open_.push_back({a, b, !same});
      return;
    }
    const double middle = 0.5 * (a + b), fm = f_(middle);
    search(a, fa, middle, fm);
    search(middle, fm, b, fb);
  }

  /// A run of open intervals stands for one crossing where one of them changes sides, and for a doubt otherwise.
  void judge() {
    for (std::size_t i = 0; i < open_.size();) {
      int changes = 0;
      std::size_t end = i;
      do {
        if (open_[end].changes) found.push_back(0.5 * (open_[end].a + open_[end].b));
        changes += open_[end].changes;
        ++end;
      } while (end < open_.size() && open_[end].a == open_[end - 1].b);
      doubtful = doubtful || changes != 1;
      i = end;
    }
  }

  std::function<double(double)> f_;
  double slope_;
  std::vector<Open> open_;
};

struct Tally {
  int rays = 0, crossings = 0, doubtful = 0;
};

/// Compares all crossings of random rays through random samples with the search.
Tally compare(const Sampled& volume, double isovalue, int rays, std::mt19937& random) {
  const auto& c = volume.coefficients;
  const glm::dvec3 far(domain_max(c.lattice, c.extents));
  double largest = 0.0;
  for (const double x : c.data) largest = std::max(largest, std::abs(x - 0.5));
  const double slope = largest * slope_bound(*volume.spline);
  const Tracer tracer(*volume.spline, c, std::array{isovalue}, nullptr, {});
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Tally tally;
  for (int trial = 0; trial < rays; ++trial) {
    const glm::dvec3 through = far * glm::dvec3(uniform(random), uniform(random), uniform(random));
    const glm::dvec3 d = random_direction(random);
    const auto ray = clip_ray(ray_space(c.lattice, c.extents, c.world, through - (trial % 3) * 20.0 * d), d);
    if (!ray) continue;
    const Search search([&](double s) { return volume.value(tracer.place(*ray, s)) - isovalue; }, slope, ray->length);
    Tracer::Workspace work;
    RayCost cost;
    std::vector<double> found;
    tracer.trace(*ray, work, cost, [&](const Crossing& crossing) {
      found.push_back(crossing.s);
      return true;
    });
    ++tally.rays;
    if (search.doubtful) {
      ++tally.doubtful;
      continue;
    }
    tally.crossings += int(found.size());
    EXPECT_EQ(found.size(), search.found.size()) << "ray " << trial;
    for (std::size_t i = 0; i < std::min(found.size(), search.found.size()); ++i)
      EXPECT_NEAR(found[i], search.found[i], 0.51 * Search::kWidth);
    for (const double s : found) EXPECT_NEAR(volume.value(tracer.place(*ray, s)), isovalue, 1e-13);
  }
  return tally;
}

TEST(BruteForce, FindsWhatTheExactCasterFindsInNoise) {
  std::mt19937 random(21);
  Tally total;
  for (unsigned seed = 0; seed < 4; ++seed) {
    const auto prefilter = seed % 2 ? Spline::Prefilter::none : Spline::Prefilter::automatic;
    const Sampled noise(random_volume({7, 6, 8}, seed), prefilter);
    for (const double isovalue : {0.35, 0.5, 0.62}) {
      const Tally tally = compare(noise, isovalue, 300, random);
      total.rays += tally.rays;
      total.crossings += tally.crossings;
      total.doubtful += tally.doubtful;
    }
  }
  EXPECT_EQ(total.rays, 3600);
  EXPECT_GT(total.crossings, 5000);
  EXPECT_LT(total.doubtful, 10) << "the search must decide nearly all rays";
}

TEST(BruteForce, AgreesOnRaysInLatticeAndKnotPlanesAndThroughLatticePoints) {
  const Sampled noise(random_volume({6, 6, 6}, 9));
  const auto& c = noise.coefficients;
  const double isovalue = 0.5;
  const Tracer tracer(*noise.spline, c, std::array{isovalue}, nullptr, {});
  double largest = 0.0;
  for (const double x : c.data) largest = std::max(largest, std::abs(x - 0.5));
  const double slope = largest * slope_bound(*noise.spline);
  std::mt19937 random(22);
  std::uniform_int_distribution<int> lattice(0, 11), sign(-1, 1), slant(-3, 3);
  int crossings = 0;
  for (int trial = 0; trial < 1200; ++trial) {
    // From a point with integer coordinates along an axis, a diagonal (in knot planes) or another rational direction.
    const glm::dvec3 point(lattice(random), lattice(random), lattice(random));
    glm::dvec3 d(sign(random), sign(random), sign(random));
    if (trial % 3 == 2) d = {slant(random), slant(random), slant(random)};
    if (d == glm::dvec3(0.0)) continue;
    d = glm::normalize(d);
    const auto ray = clip_ray(ray_space(c.lattice, c.extents, c.world, point - (trial % 2) * 30.0 * d), d);
    ASSERT_TRUE(ray || trial % 2) << "an eye in the domain sees it";
    if (!ray) continue;
    const Search search([&](double s) { return noise.value(tracer.place(*ray, s)) - isovalue; }, slope, ray->length);
    if (search.doubtful) continue;
    const auto found = crossing_distances(tracer, c, point - (trial % 2) * 30.0 * d, d);
    ASSERT_EQ(found.size(), search.found.size()) << "ray " << trial;
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_NEAR(found[i], ray->entry + search.found[i], 0.51 * Search::kWidth);
    crossings += int(found.size());
  }
  EXPECT_GT(crossings, 1000);
}

}  // namespace
}  // namespace quincunx
