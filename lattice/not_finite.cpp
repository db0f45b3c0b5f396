#include "lattice/not_finite.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace quincunx {
namespace {

/// The steps, in lattice coordinates, from a sample to its nearest neighbours.
std::vector<glm::i64vec3> neighbour_steps(LatticeKind lattice) {
  std::vector<glm::i64vec3> steps;
  for (std::int64_t z = -2; z <= 2; ++z)
    for (std::int64_t y = -2; y <= 2; ++y)
      for (std::int64_t x = -2; x <= 2; ++x) {
        const glm::i64vec3 size = glm::abs(glm::i64vec3(x, y, z));
        const bool diagonal = size == glm::i64vec3(1), axial = size.x + size.y + size.z == 2 && std::max({size.x, size.y, size.z}) == 2;
        const bool beside = std::max({size.x, size.y, size.z}) == 1;
        if (lattice == LatticeKind::bcc ? diagonal || axial : beside) steps.emplace_back(x, y, z);
      }
  return steps;
}

/// Float samples by their lattice coordinates.
struct FloatSamples {
  LatticeKind lattice;
  Extents extents;
  const std::vector<float>& samples;

  std::size_t number(int coset, const glm::i64vec3& i) const {
    return std::size_t(((coset * extents.z + i.z) * extents.y + i.y) * extents.x + i.x);
  }
  /// The sample at the lattice point u; NaN outside the volume.
  float at(const glm::i64vec3& u) const {
    const std::int64_t step = lattice_step(lattice), coset = lattice == LatticeKind::bcc ? u.x & 1 : 0;
    const glm::i64vec3 from = u - coset;
    if (glm::any(glm::lessThan(from, glm::i64vec3(0))) || glm::any(glm::greaterThanEqual(from, step * extents)))
      return std::numeric_limits<float>::quiet_NaN();
    return samples[number(int(coset), from / step)];
  }
};

float as_float(double value) {
  constexpr double largest = std::numeric_limits<float>::max();
  return float(std::clamp(value, -largest, largest));
}

/// What the finite samples about u say; NaN where there is none.
double extension(const FloatSamples& f, const glm::i64vec3& u, const std::vector<glm::i64vec3>& steps) {
  double linear = 0.0, near = 0.0;
  int pairs = 0, singles = 0;
  for (const glm::i64vec3& step : steps) {
    const double a = f.at(u + step);
    if (!std::isfinite(a)) continue;
    near += a;
    ++singles;
    const double b = f.at(u + std::int64_t(2) * step);
    if (!std::isfinite(b)) continue;
    linear += 2.0 * a - b;
    ++pairs;
  }
  if (pairs > 0) return linear / pairs;
  return singles > 0 ? near / singles : std::numeric_limits<double>::quiet_NaN();
}

class FilledSource final : public SampleSource {
 public:
  FilledSource(std::shared_ptr<const SampleSource> source, double value) : source_(std::move(source)), value_(value) {}

  const Volume& header() const override { return source_->header(); }
  Volume read_box(const glm::i64vec3& low, const glm::i64vec3& high) const override {
    Volume box = source_->read_box(low, high);
    fill_not_finite(box, value_);
    return box;
  }

 private:
  std::shared_ptr<const SampleSource> source_;
  double value_;
};

}  // namespace

bool may_not_be_finite(const Volume& volume) { return volume.type() == SampleType::float32; }

void fill_not_finite(Volume& volume, double value) {
  if (!may_not_be_finite(volume)) return;
  for (float& sample : std::get<std::vector<float>>(volume.samples))
    if (!std::isfinite(sample)) sample = float(value);
}

std::shared_ptr<const SampleSource> filled_source(std::shared_ptr<const SampleSource> source, double value) {
  if (!may_not_be_finite(source->header())) return source;
  return std::make_shared<FilledSource>(std::move(source), value);
}

void extend_finite(Volume& volume) {
  if (!may_not_be_finite(volume)) return;
  const SampleRange range = sample_range(volume);
  if (range.not_finite == 0) return;
  const auto middle = float(0.5 * range.min + 0.5 * range.max);
  auto& samples = std::get<std::vector<float>>(volume.samples);
  const FloatSamples f{volume.lattice, volume.extents, samples};
  const std::vector<glm::i64vec3> steps = neighbour_steps(volume.lattice);
  const std::int64_t step = lattice_step(volume.lattice), planes = coset_count(volume.lattice) * volume.extents.z;

  // Find all extensions, plane by plane, before any sample is replaced.
  std::vector<std::vector<std::pair<std::size_t, float>>> found(static_cast<std::size_t>(planes));
  tbb::parallel_for(std::int64_t(0), planes, [&](std::int64_t plane) {
    const auto coset = int(plane / volume.extents.z);
    const std::int64_t k = plane % volume.extents.z;
    for (std::int64_t j = 0; j < volume.extents.y; ++j)
      for (std::int64_t i = 0; i < volume.extents.x; ++i) {
        const std::size_t n = f.number(coset, {i, j, k});
        if (std::isfinite(samples[n])) continue;
        const double value = extension(f, step * glm::i64vec3(i, j, k) + std::int64_t(coset), steps);
        found[std::size_t(plane)].emplace_back(n, std::isnan(value) ? middle : as_float(value));
      }
  });
  for (const auto& plane : found)
    for (const auto& [n, value] : plane) samples[n] = value;
}

}  // namespace quincunx
