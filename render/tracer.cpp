#include "render/tracer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "render/certified_root.h"
#include "render/roots.h"

namespace quincunx {
namespace {

constexpr int kUnknown = -1;
constexpr int kLook = -2;
constexpr int kMaxIterations = 200;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// Rounding of a value that the spline computes, as a part of the largest coefficient: sums of some dozens of terms.
constexpr double kValueRounding = 16.0 * kEpsilon;

bool visit_all(const std::vector<Crossing>& crossings, const Tracer::Visitor& visit) {
  return std::all_of(crossings.begin(), crossings.end(), visit);
}

/// Puts crossings that were found surface by surface in ray order.
void sort_along_ray(std::vector<Crossing>& crossings) {
  std::stable_sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) { return a.s < b.s; });
}

}  // namespace

double value_rounding(const Coefficients<double>& coefficients) {
  double largest = 0.0;
  for (const double x : coefficients.data) largest = std::max(largest, std::abs(x));
  return kValueRounding * largest;
}

Tracer::Tracer(const Spline& spline, const Coefficients<double>& coefficients, std::span<const double> isovalues,
               const CellBounds* cells, const Config& config, const VoidCells* voids)
    : spline_(spline),
      coefficients_(coefficients),
      config_(config),
      far_(domain_max(coefficients.lattice, coefficients.extents)),
      cells_(glm::max(glm::ivec3(far_), glm::ivec3(1))),
      isovalues_(isovalues.begin(), isovalues.end()),
      rounding_(value_rounding(coefficients)),
      voids_(voids && voids->count > 0 ? voids : nullptr) {
  assert(spline.lattice() == coefficients.lattice && spline.apron() <= coefficients.apron);
  assert(spline.degree() <= kMaxDegree);
  assert(std::is_sorted(isovalues_.begin(), isovalues_.end()));
  for (double& isovalue : isovalues_) isovalue -= rounding_;
  if (cells == nullptr) return;
  assert(cells->cells == glm::i64vec3(cells_));
  levels_ = classify(block_bounds(*cells, 1), *cells, ranges_of(isovalues_));
}

glm::dvec3 Tracer::place(const LatticeRay& ray, double s) const {
  return glm::clamp(ray.point(s), glm::dvec3(0.0), far_);
}

int Tracer::level_of(double value) const {
  return int(std::upper_bound(isovalues_.begin(), isovalues_.end(), value) - isovalues_.begin());
}

int Tracer::promised_level(const glm::ivec3& cell) const {
  if (levels_.level.empty()) return kLook;
  const glm::i64vec3 c(cell);
  const std::uint8_t level = levels_.level[std::size_t((c.z * levels_.blocks.y + c.y) * levels_.blocks.x + c.x)];
  return level == Classification::active ? kLook : level;
}

/// Collects the crossings of the piece `bernstein` on begin..end in ray order, and moves `level` to its end.
void Tracer::find_crossings(std::span<const double> bernstein, double begin, double end, int& level,
                            Workspace& work) const {
  work.crossings.clear();
  if (level == kUnknown) level = level_of(bernstein.front());
  const auto [smallest, largest] = std::minmax_element(bernstein.begin(), bernstein.end());
  const int first = std::min(level, level_of(*smallest)), last = std::max(level, level_of(*largest));
  for (int k = first; k < last; ++k) {
    std::array<double, kMaxDegree + 1> b{};
    for (std::size_t i = 0; i < bernstein.size(); ++i) b[i] = bernstein[i] - isovalues_[k];
    // The piece starts on the side where the one before ended: a root that rounding put between the two is found at
    // `begin`, and none is found twice.
    const bool above = k < level;
    if (above != (b[0] >= 0.0)) b[0] = above ? 0.0 : -std::numeric_limits<double>::min();
    work.roots.clear();
    append_crossings({b.data(), bernstein.size()}, work.roots);
    for (const double x : work.roots) work.crossings.push_back({begin + x * (end - begin), k});
  }
  sort_along_ray(work.crossings);
  level = level_of(bernstein.back());
}

/// Looks for crossings between the knot planes of one cell; false when the visitor has enough.
bool Tracer::cross_cell(const LatticeRay& ray, const CellWalk& walk, int& level, Workspace& work, RayCost& cost,
                        const Visitor& visit) const {
  const glm::ivec3 cell = walk.cell();
  const glm::dvec3 low(cell), high = glm::min(low + 1.0, far_);
  const auto point = [&](double s) { return glm::clamp(ray.point(s), low, high); };

  work.knots.assign(1, walk.enter());
  spline_.split(cell, ray.origin, ray.direction, walk.enter(), walk.exit(), work.knots);
  work.knots.push_back(walk.exit());

  std::array<double, kMaxDegree + 1> bernstein;
  const std::span<double> piece(bernstein.data(), std::size_t(spline_.degree()) + 1);
  for (std::size_t i = 0; i + 1 < work.knots.size(); ++i) {
    const double begin = work.knots[i], end = work.knots[i + 1];
    if (!(begin < end)) continue;
    spline_.restrict_to_segment(coefficients_, cell, point(begin), point(end), piece);
    ++cost.evaluations;
    find_crossings(piece, begin, end, level, work);
    if (!visit_all(work.crossings, visit)) return false;
  }
  return true;
}

/// The same where the cell is one smooth piece that is no polynomial.
bool Tracer::cross_smooth_cell(const LatticeRay& ray, const CellWalk& walk, int& level, Workspace& work, RayCost& cost,
                               const Visitor& visit) const {
  const double length = walk.exit() - walk.enter();
  if (!(length > 0.0)) return true;
  const glm::ivec3 cell = walk.cell();
  const glm::dvec3 low(cell), high = glm::min(low + 1.0, far_), from = ray.point(walk.enter());
  const auto jet = [&](double t) {
    ++cost.evaluations;
    return spline_.evaluate_piece(coefficients_, cell, glm::clamp(from + t * ray.direction, low, high));
  };
  const double curvature = spline_.curvature(coefficients_, cell, ray.direction);
  if (level == kUnknown) level = level_of(jet(0.0).value);
  work.crossings.clear();
  int above_count = 0;
  for (int k = 0; k < int(isovalues_.size()); ++k) {
    const auto less = [&](double t) {
      const Jet j = jet(t);
      return ValueAndSlope{j.value - isovalues_[k], glm::dot(j.gradient, ray.direction)};
    };
    bool above = k < level;
    work.roots.clear();
    append_crossings(less, curvature, rounding_, length, above, work.roots);
    for (const double t : work.roots) work.crossings.push_back({walk.enter() + t, k});
    above_count += above;
  }
  level = above_count;
  sort_along_ray(work.crossings);
  return visit_all(work.crossings, visit);
}

void Tracer::trace_exact(const LatticeRay& ray, Workspace& work, RayCost& cost, const Visitor& visit) const {
  int level = kUnknown;
  bool looking = false;
  for (CellWalk walk(ray, cells_); !walk.done(); walk.advance()) {
    ++cost.steps;
    if (voids_ && voids_->at(walk.cell())) {
      level = kUnknown;
      looking = false;
      continue;
    }
    const int promised = promised_level(walk.cell());
    if (promised != kLook) {
      assert(level == kUnknown || level == promised);
      level = promised;
      looking = false;
      continue;
    }
    cost.intervals += !looking;
    looking = true;
    const auto cross = spline_.polynomial() ? &Tracer::cross_cell : &Tracer::cross_smooth_cell;
    if (!(this->*cross)(ray, walk, level, work, cost, visit)) return;
  }
}

/// A place of a march. The value is NaN where the bounds gave the level without one.
struct Tracer::Sample {
  double s, value;
  int level;
};

double Tracer::value(const LatticeRay& ray, double s, RayCost& cost) const {
  ++cost.evaluations;
  return spline_.evaluate(coefficients_, place(ray, s)).value;
}

Tracer::Sample Tracer::sample(const LatticeRay& ray, double s, bool& looking, RayCost& cost) const {
  ++cost.steps;
  const glm::ivec3 cell = glm::min(glm::ivec3(glm::floor(place(ray, s))), cells_ - 1);
  const int promised = promised_level(cell);
  const bool look = promised == kLook;
  cost.intervals += look && !looking;
  looking = look;
  if (!look) return {s, std::numeric_limits<double>::quiet_NaN(), promised};
  const double f = value(ray, s, cost);
  return {s, f, level_of(f)};
}

/// The crossing between two samples on different sides: regula falsi (the Illinois rule), halving where it is slow.
double Tracer::refine(const LatticeRay& ray, const Sample& from, const Sample& to, double isovalue,
                      RayCost& cost) const {
  double a = from.s, b = to.s;
  double fa = (std::isnan(from.value) ? value(ray, a, cost) : from.value) - isovalue;
  double fb = (std::isnan(to.value) ? value(ray, b, cost) : to.value) - isovalue;
  const bool above = fa >= 0.0;
  int kept = 0;  // the end that the last step kept: -1 for a, 1 for b
  double width = b - a;
  for (int i = 0; i < kMaxIterations && fa != 0.0 && fb != 0.0; ++i) {
    if (b - a <= 2.0 * kEpsilon * std::max(1.0, b)) break;
    double s = a + (b - a) * (fa / (fa - fb));
    // Every third step the bracket must have halved.
    if (!(s > a && s < b) || (i % 3 == 2 && b - a > 0.5 * width)) s = 0.5 * (a + b);
    if (i % 3 == 2) width = b - a;
    const double fs = value(ray, s, cost) - isovalue;
    if ((fs >= 0.0) == above) {
      a = s, fa = fs;
      if (kept == 1) fb *= 0.5;
      kept = 1;
    } else {
      b = s, fb = fs;
      if (kept == -1) fa *= 0.5;
      kept = -1;
    }
  }
  return fa == 0.0 ? a : fb == 0.0 ? b : 0.5 * (a + b);
}

void Tracer::trace_march(const LatticeRay& ray, Workspace& work, RayCost& cost, const Visitor& visit) const {
  bool looking = false;
  work.voids.find(ray, cells_, voids_);
  Sample last = sample(ray, 0.0, looking, cost);
  for (std::int64_t n = 1; last.s < ray.length; ++n) {
    const Sample next = sample(ray, std::min(double(n) * config_.step, ray.length), looking, cost);
    work.crossings.clear();
    if (work.voids.touch(last.s, next.s)) last.level = next.level;
    for (int k = std::min(last.level, next.level); k < std::max(last.level, next.level); ++k)
      work.crossings.push_back({refine(ray, last, next, isovalues_[k], cost), k});
    sort_along_ray(work.crossings);
    if (!visit_all(work.crossings, visit)) return;
    last = next;
  }
}

void Tracer::trace(const LatticeRay& ray, Workspace& work, RayCost& cost, const Visitor& visit) const {
  if (config_.intersect == Intersect::exact) {
    trace_exact(ray, work, cost, visit);
  } else {
    trace_march(ray, work, cost, visit);
  }
}

}  // namespace quincunx
