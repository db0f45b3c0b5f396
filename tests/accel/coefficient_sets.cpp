#include "coefficient_sets.h"

#include <cmath>
#include <random>

namespace quincunx {

Coefficients<float> make_coefficients(const Extents& extents, const std::function<double(int, const glm::i64vec3&)>& value,
                                      LatticeKind lattice) {
  Coefficients<float> c;
  c.lattice = lattice;
  c.extents = extents;
  c.apron = 2;
  c.data.resize(std::size_t(coset_count(lattice) * c.stride_coset()));
  const glm::i64vec3 low(-c.apron), high = extents + std::int64_t(c.apron);
  const auto fill = [&](bool inside) {
    for (int coset = 0; coset < coset_count(lattice); ++coset)
      for (std::int64_t k = low.z; k < high.z; ++k)
        for (std::int64_t j = low.y; j < high.y; ++j)
          for (std::int64_t i = low.x; i < high.x; ++i) {
            const glm::i64vec3 p(i, j, k), q = glm::clamp(p, glm::i64vec3(0), extents - std::int64_t(1));
            if (inside && p == q) c.data[c.number(coset, p)] = float(value(coset, p));
            if (!inside) c.data[c.number(coset, p)] = c.data[c.number(coset, q)];
          }
  };
  fill(true);
  fill(false);
  return c;
}

Coefficients<double> in_double(const Coefficients<float>& c) {
  Coefficients<double> d;
  d.lattice = c.lattice, d.extents = c.extents, d.apron = c.apron, d.world = c.world;
  d.data.assign(c.data.begin(), c.data.end());
  return d;
}

std::vector<CoefficientSet> coefficient_sets(LatticeKind lattice) {
  const int last_coset = coset_count(lattice) - 1;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto noise = [&](double middle, double amplitude) {
    return [&uniform, &random, middle, amplitude](int, const glm::i64vec3&) {
      return middle + amplitude * uniform(random);
    };
  };
  const auto sign = [&](int, const glm::i64vec3&) { return uniform(random) < 0.0 ? -1.0 : 1.0; };
  const auto by_coset = [](int coset, const glm::i64vec3&) { return coset == 0 ? 1.0 : -1.0; };
  const auto checkerboard = [](int, const glm::i64vec3& p) { return (p.x + p.y + p.z) % 2 == 0 ? 3.0 : -3.0; };
  const auto spike = [&](int coset, const glm::i64vec3& p) {
    return coset == last_coset && p == glm::i64vec3(4, 3, 2) ? 1e6 : 1.0;
  };
  const auto ramp = [](int coset, const glm::i64vec3& p) {
    return double(coset) + 2.0 * double(p.x) + 10.0 * double(p.z);
  };

  std::vector<CoefficientSet> sets;
  const auto add = [&](const char* name, const Extents& extents,
                       const std::function<double(int, const glm::i64vec3&)>& f) {
    sets.push_back({name, make_coefficients(extents, f, lattice)});
  };
  add("noise", {19, 11, 7}, noise(0.0, 1.0));
  add("noise longer than a register block", {70, 5, 3}, noise(100.0, 30.0));
  add("noise on a large offset", {9, 10, 11}, noise(1e5, 1e-2));
  add("random signs", {13, 9, 10}, sign);
  if (lattice == LatticeKind::bcc) add("cosets of opposite sign", {5, 9, 6}, by_coset);
  add("checkerboard of every coset", {8, 7, 9}, checkerboard);
  add("one spike", {9, 8, 5}, spike);
  add("ramp", {6, 6, 6}, ramp);
  add("constant", {5, 4, 3}, [](int, const glm::i64vec3&) { return 0.7; });
  add("zero", {3, 3, 3}, [](int, const glm::i64vec3&) { return 0.0; });
  add("tiny numbers", {6, 5, 4}, noise(0.0, 1e-30));
  add("huge numbers", {6, 5, 4}, noise(0.0, 1e30));
  add("one sample", {1, 1, 1}, noise(0.0, 1.0));
  add("a column", {1, 1, 17}, noise(0.0, 1.0));
  add("a row", {33, 1, 1}, noise(0.0, 1.0));
  add("a sheet", {1, 12, 9}, noise(0.0, 1.0));
  return sets;
}

Coefficients<float> smooth_coefficients(const Extents& extents, LatticeKind lattice) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> noise(-1.0, 1.0);
  const auto value = [&](int coset, const glm::i64vec3& p) {
    const glm::dvec3 u = double(lattice_step(lattice)) * glm::dvec3(p) + double(coset);
    return 1000.0 + 300.0 * std::sin(0.21 * u.x) * std::cos(0.17 * u.y) + 200.0 * std::sin(0.13 * u.z + 0.1 * u.x) +
           2.0 * noise(random);
  };
  return make_coefficients(extents, value, lattice);
}

CellBounds bounds_of(const Coefficients<float>& c) { return cell_bounds(*make_spline("bcc7"), c); }

}  // namespace quincunx
