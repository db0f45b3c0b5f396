#include "spline/exact_box_spline.h"

#include <cassert>
#include <utility>

namespace quincunx {
namespace {

RationalPoint cross(const RationalPoint& a, const RationalPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

mpq_class dot(const RationalPoint& a, const RationalPoint& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

RationalPoint rational(const glm::ivec3& v) { return {mpq_class(v.x), mpq_class(v.y), mpq_class(v.z)}; }

RationalPoint minus(const RationalPoint& x, const glm::ivec3& v) { return {x[0] - v.x, x[1] - v.y, x[2] - v.z}; }

}  // namespace

ExactBoxSpline::ExactBoxSpline(std::vector<glm::ivec3> directions) : directions_(std::move(directions)) {
  assert(directions_.size() >= 3 && directions_.size() <= 16);
}

const std::vector<RationalPoint>& ExactBoxSpline::pseudo_inverse(Subset subset) {
  if (const auto found = inverses_.find(subset); found != inverses_.end()) return found->second;
  std::vector<RationalPoint> rows;
  std::array<RationalPoint, 3> gram;  // X X^T
  for (std::size_t r = 0; r < directions_.size(); ++r)
    if (subset >> r & 1u)
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) gram[a][b] += directions_[r][a] * directions_[r][b];
  const std::array<RationalPoint, 3> cofactors = {cross(gram[1], gram[2]), cross(gram[2], gram[0]),
                                                  cross(gram[0], gram[1])};
  const mpq_class determinant = dot(gram[0], cofactors[0]);
  if (determinant != 0)
    for (std::size_t r = 0; r < directions_.size(); ++r)
      if (subset >> r & 1u) {
        const RationalPoint xi = rational(directions_[r]);
        rows.push_back({dot(cofactors[0], xi) / determinant, dot(cofactors[1], xi) / determinant,
                        dot(cofactors[2], xi) / determinant});
      }
  return inverses_.emplace(subset, std::move(rows)).first->second;
}

bool ExactBoxSpline::outside_box(Subset subset, const RationalPoint& x) const {
  glm::ivec3 low(0), high(0);
  for (std::size_t r = 0; r < directions_.size(); ++r)
    if (subset >> r & 1u) {
      low += glm::min(directions_[r], 0);
      high += glm::max(directions_[r], 0);
    }
  for (int a = 0; a < 3; ++a)
    if (x[a] < low[a] || x[a] > high[a]) return true;
  return false;
}

mpq_class ExactBoxSpline::recurse(Subset subset, const RationalPoint& x,
                                  std::map<std::pair<Subset, RationalPoint>, mpq_class>& known) {
  if (outside_box(subset, x)) return 0;
  const std::vector<RationalPoint>& inverse = pseudo_inverse(subset);
  if (inverse.empty()) return 0;
  const auto key = std::pair(subset, x);
  if (const auto found = known.find(key); found != known.end()) return found->second;

  mpq_class sum = 0;
  if (inverse.size() == 3) {
    // The indicator of the parallelepiped over its volume; the inverse's determinant is that of the directions,
    // inverted.
    const bool inside = [&] {
      for (const RationalPoint& row : inverse)
        if (const mpq_class t = dot(row, x); t < 0 || t >= 1) return false;
      return true;
    }();
    if (inside) sum = abs(dot(inverse[0], cross(inverse[1], inverse[2])));
  } else {
    std::size_t row = 0;
    for (std::size_t r = 0; r < directions_.size(); ++r) {
      if (!(subset >> r & 1u)) continue;
      const mpq_class t = dot(inverse[row++], x);
      // Equal directions have equal t and leave equal box splines: the last of them counts for all.
      int equal = 0, later = 0;
      for (std::size_t q = 0; q < directions_.size(); ++q)
        if ((subset >> q & 1u) && directions_[q] == directions_[r]) ++equal, later += q > r;
      if (later > 0) continue;
      const Subset rest = subset & ~(1u << r);
      sum += equal * t * recurse(rest, x, known);
      sum += equal * (1 - t) * recurse(rest, minus(x, directions_[r]), known);
    }
    sum /= int(inverse.size()) - 3;
  }
  known.emplace(key, sum);
  return sum;
}

mpq_class ExactBoxSpline::uncentred(Subset subset, const RationalPoint& x) {
  std::map<std::pair<Subset, RationalPoint>, mpq_class> known;
  return recurse(subset, x, known);
}

RationalPoint ExactBoxSpline::shifted_to_origin(const RationalPoint& x) const {
  glm::ivec3 sum(0);
  for (const glm::ivec3& xi : directions_) sum += xi;
  const mpq_class half(1, 2);
  return {x[0] + half * sum.x, x[1] + half * sum.y, x[2] + half * sum.z};
}

mpq_class ExactBoxSpline::value(const RationalPoint& x) {
  return uncentred((1u << directions_.size()) - 1, shifted_to_origin(x));
}

RationalPoint ExactBoxSpline::gradient(const RationalPoint& x) {
  const Subset all = (1u << directions_.size()) - 1;
  const RationalPoint origin = shifted_to_origin(x);
  RationalPoint gradient;
  for (int a = 0; a < 3; ++a) {
    glm::ivec3 step(0);
    step[a] = 2;
    std::size_t r = 0;
    while (r < directions_.size() && directions_[r] != step) ++r;
    assert(r < directions_.size());
    const Subset rest = all & ~(1u << r);
    gradient[a] = (uncentred(rest, origin) - uncentred(rest, minus(origin, step))) / 2;
  }
  return gradient;
}

std::vector<glm::ivec3> bcc4_directions() { return {{-1, 1, 1}, {1, -1, 1}, {1, 1, -1}, {-1, -1, -1}}; }

std::vector<glm::ivec3> bcc7_directions() {
  return {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {-1, 1, 1}, {1, -1, 1}, {1, 1, -1}, {-1, -1, -1}};
}

std::vector<glm::ivec3> bcc8_directions() {
  std::vector<glm::ivec3> twice = bcc4_directions();
  for (const glm::ivec3& direction : bcc4_directions()) twice.push_back(direction);
  return twice;
}

}  // namespace quincunx
