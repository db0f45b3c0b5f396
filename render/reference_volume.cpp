#include "render/reference_volume.h"

#include <algorithm>
#include <cmath>

namespace quincunx {
namespace {

constexpr int kParts = 256;  // of a pre-integrated stretch

/// Twin of shaders/volume.glsl, pixel_noise.
double pixel_noise(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  x = x * 1664525u + 1013904223u, y = y * 1664525u + 1013904223u, z = z * 1664525u + 1013904223u;
  x += y * z, y += z * x, z += x * y;
  x ^= x >> 16, y ^= y >> 16, z ^= z >> 16;
  x += y * z;
  return double(x >> 8) / 16777216.0;
}

}  // namespace

ReferenceVolume::ReferenceVolume(const Spline& spline, const Coefficients<double>& coefficients, const DirectVolume& volume, double ambient,
                                 const VoidCells* voids)
    : spline_(spline), coefficients_(coefficients), volume_(volume), voids_(voids), ambient_(ambient) {
  const double cell = cell_length(coefficients.world);
  unit_ = volume.function.unit > 0.0 ? volume.function.unit : cell;
  length_ = volume.step * cell;
}

ReferenceVolume::March ReferenceVolume::begin(int i, int j) const {
  March march;
  if (volume_.jitter) march.shift = pixel_noise(std::uint32_t(i), std::uint32_t(j), *volume_.jitter);
  return march;
}

ReferenceVolume::March ReferenceVolume::begin(int i, int j, const LatticeRay& ray) const {
  March march = begin(i, j);
  march.voids.find(ray, glm::ivec3(cell_count(coefficients_.lattice, coefficients_.extents)), voids_);
  return march;
}

glm::dvec3 ReferenceVolume::place(const LatticeRay& ray, double s) const {
  return glm::clamp(ray.point(s), glm::dvec3(0.0), glm::dvec3(domain_max(coefficients_.lattice, coefficients_.extents)));
}

ReferenceVolume::Stretch ReferenceVolume::classified(double value, double length) const {
  const double opacity = std::min(volume_.function.opacity(value), 1.0 - 0x1p-24);
  const double seen = -std::expm1(length / unit_ * std::log1p(-opacity));
  return {seen * volume_.function.color(value), seen};
}

ReferenceVolume::Stretch ReferenceVolume::pre_integrated(double front, double back, double length) const {
  Composite sum;
  for (int n = 0; n < kParts; ++n) {
    const Stretch part = classified(front + (back - front) * (n + 0.5) / kParts, length / kParts);
    sum.color += sum.transmittance * part.color;
    sum.transmittance *= 1.0 - part.opacity;
  }
  return {sum.color, 1.0 - sum.transmittance};
}

ReferenceVolume::Stretch ReferenceVolume::lit(Stretch stretch, const glm::dvec3& gradient, const glm::dvec3& direction) const {
  const glm::dvec3 world = coefficients_.world.gradient_to_world(gradient);
  if (volume_.shade) stretch.color = headlight(stretch.color, ambient_, facing_normal(world, direction), direction);
  if (!volume_.modulated()) return stretch;
  const double left = std::clamp((glm::length(world) - volume_.modulate_from) / (volume_.modulate_to - volume_.modulate_from), 0.0, 1.0);
  return share(stretch, left);
}

ReferenceVolume::Stretch ReferenceVolume::share(const Stretch& stretch, double part) {
  if (stretch.opacity == 0.0) return {};
  const double opacity = -std::expm1(part * std::log1p(-std::min(stretch.opacity, 1.0 - 0x1p-53)));
  return {opacity / stretch.opacity * stretch.color, opacity};
}

ReferenceVolume::Stretch ReferenceVolume::sampled(const LatticeRay& ray, const glm::dvec3& direction, double s, double length,
                                                  const VoidStretches& voids, RayCost& cost, double* change) const {
  const Jet jet = spline_.evaluate(coefficients_, place(ray, s));
  ++cost.evaluations;
  if (change) *change = std::abs(glm::dot(jet.gradient, ray.direction)) * length_ / ray.scale / (volume_.function.high() - volume_.function.low());
  if (voids.touch(s, s)) return {};
  return lit(classified(jet.value, length), jet.gradient, direction);
}

ReferenceVolume::Stretch ReferenceVolume::stretch(const LatticeRay& ray, const glm::dvec3& direction, double first, double last,
                                                  const VoidStretches& voids, RayCost& cost) const {
  if (volume_.classify == Classify::pre_integrated) {
    const Jet front = spline_.evaluate(coefficients_, place(ray, first)), back = spline_.evaluate(coefficients_, place(ray, last));
    ++cost.evaluations;
    if (voids.touch(first, last)) return {};
    return lit(pre_integrated(front.value, back.value, length_), back.gradient, direction);
  }
  double change = 0.0;
  const Stretch whole = sampled(ray, direction, 0.5 * (first + last), length_, voids, cost, &change);
  if (!volume_.adaptive || change <= volume_.finest) return whole;
  const int parts = change <= 2.0 * volume_.finest ? 2 : change <= 4.0 * volume_.finest ? 4 : 8;
  Composite sum;
  for (int n = 0; n < parts; ++n) {
    const Stretch part = sampled(ray, direction, first + (last - first) * (n + 0.5) / parts, length_ / parts, voids, cost);
    sum.color += sum.transmittance * part.color;
    sum.transmittance *= 1.0 - part.opacity;
  }
  return {sum.color, 1.0 - sum.transmittance};
}

void ReferenceVolume::integrate(const LatticeRay& ray, const glm::dvec3& direction, double end, March& march, Composite& seen,
                                RayCost& cost) const {
  const double dt = length_ / ray.scale;
  const auto begin_of = [&](double k) { return (k - march.shift) * dt; };
  while (!opaque(seen) && std::max(begin_of(march.k), march.reached) < end) {
    const double first = std::max(begin_of(march.k), march.reached);
    const bool cut = begin_of(march.k + 1.0) > end;
    const double last = cut ? end : begin_of(march.k + 1.0);
    const double part = std::clamp((last - first) / dt, 0.0, 1.0);
    Stretch met = stretch(ray, direction, first, last, march.voids, cost);
    if (part < 1.0) met = share(met, part);
    ++cost.steps;
    seen.color += seen.transmittance * met.color;
    seen.transmittance *= 1.0 - met.opacity;
    if (!march.half && seen.transmittance <= 0.5) march.half = last;
    if (cut) {
      march.reached = last;
    } else {
      march.k += 1.0;
    }
  }
}

}  // namespace quincunx
