#include "accel/volume_voxels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "lattice/error.h"

namespace quincunx {
namespace {

constexpr std::int64_t kMostCells = 32766;  // 16 bits of half cells, and the border

/// A cuboid that is not yet packed.
struct Cuboid {
  std::uint16_t low[3], level;
  float density;
  glm::vec3 gradient;
};

/// Some samples together, or one.
struct Merged {
  double sum = 0.0, min = 0.0, max = 0.0;
  glm::dvec3 gradient{0.0};  ///< their sum
  double count = 0.0;

  void add(const Merged& m) {
    min = count > 0.0 ? std::min(min, m.min) : m.min;
    max = count > 0.0 ? std::max(max, m.max) : m.max;
    sum += m.sum, gradient += m.gradient, count += m.count;
  }
  double mean() const { return sum / count; }
  /// Of any sample from the mean.
  double deviation() const { return std::max(max - mean(), mean() - min); }
};

class Collector {
 public:
  Collector(const Volume& volume, const VoxelConfig& config, const Voxels& voxels, const Progress& progress)
      : volume_(volume), config_(config), voxels_(voxels), progress_(progress), to_world_(glm::transpose(glm::inverse(volume.world.axes))) {}

  /// The cuboids of the cube of 2^level samples an axis (in edges that grow) from `low` on. Whole: it may become one, which the caller adds; else they are in the list.
  std::optional<Merged> collect(int coset, const glm::i64vec3& low, int level) {
    if (glm::any(glm::greaterThanEqual(low, volume_.extents))) return std::nullopt;
    if (level == 0) return sample(coset, low);
    if (level == kReportLevel) report(progress_, std::min(1.0, double(visited_) / double(volume_.sample_count())));
    const std::int64_t half = std::int64_t(1) << (level - 1);
    std::array<std::optional<Merged>, 8> parts;
    std::array<glm::i64vec3, 8> places;
    int count = 0;
    for (int z = 0; z <= int(voxels_.grows.z); ++z)
      for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x) {
          places[std::size_t(count)] = low + half * glm::i64vec3(x, y, z);
          parts[std::size_t(count)] = collect(coset, places[std::size_t(count)], level - 1);
          ++count;
        }
    Merged all;
    bool whole = config_.deviation.has_value();
    for (int n = 0; n < count && whole; ++n) {
      whole = parts[std::size_t(n)].has_value();
      if (whole) all.add(*parts[std::size_t(n)]);
    }
    if (whole && all.deviation() <= *config_.deviation) return all;
    for (int n = 0; n < count; ++n)
      if (parts[std::size_t(n)]) put(*parts[std::size_t(n)], coset, places[std::size_t(n)], level - 1);
    return std::nullopt;
  }

  /// Adds a cuboid to the list.
  void put(const Merged& m, int coset, const glm::i64vec3& index, int level) {
    const std::int64_t step = 2 * lattice_step(volume_.lattice);  // half cells from sample to sample
    const glm::i64vec3 centre = step * index + std::int64_t(2 * coset);
    const glm::i64vec3 low = centre - glm::i64vec3(voxels_.edge) / std::int64_t(2) + std::int64_t(kVoxelOrigin);
    const glm::dvec3 gradient = m.gradient / m.count;
    cuboids_.push_back({{std::uint16_t(low.x), std::uint16_t(low.y), std::uint16_t(low.z)}, std::uint16_t(level), float(m.mean()), glm::vec3(gradient)});
  }

  const std::vector<Cuboid>& cuboids() const { return cuboids_; }

 private:
  static constexpr int kReportLevel = 5;

  std::optional<Merged> sample(int coset, const glm::i64vec3& index) {
    ++visited_;
    const double value = volume_.sample(coset, index);
    if (!(value >= config_.minimum) || !std::isfinite(value)) return std::nullopt;
    return Merged{value, value, value, gradient(coset, index, value), 1.0};
  }

  glm::dvec3 gradient(int coset, const glm::i64vec3& index, double value) const {
    const double step = lattice_step(volume_.lattice);
    glm::dvec3 g(0.0);
    for (int a = 0; a < 3; ++a) {
      double ends[2] = {value, value}, length = 0.0;
      for (int side = 0; side < 2; ++side) {
        glm::i64vec3 beside = index;
        beside[a] += 2 * side - 1;
        if (beside[a] < 0 || beside[a] >= volume_.extents[a]) continue;
        const double there = volume_.sample(coset, beside);
        if (!std::isfinite(there)) continue;
        ends[side] = there;
        length += step;
      }
      if (length > 0.0) g[a] = (ends[1] - ends[0]) / length;
    }
    return to_world_ * g;
  }

  const Volume& volume_;
  const VoxelConfig& config_;
  const Voxels& voxels_;
  const Progress& progress_;
  glm::dmat3 to_world_;
  std::uint64_t visited_ = 0;  ///< samples
  std::vector<Cuboid> cuboids_;
};

/// All of the volume: cubes of the largest size, or the squares of each layer.
void collect_all(Collector& collector, const Volume& volume, const Voxels& voxels) {
  const std::int64_t longest = std::max({volume.extents.x, volume.extents.y, voxels.grows.z ? volume.extents.z : 1});
  const int top = int(std::bit_width(std::uint64_t(longest - 1)));
  const auto collect = [&](int coset, const glm::i64vec3& low, int level) {
    if (const std::optional<Merged> whole = collector.collect(coset, low, level)) collector.put(*whole, coset, low, level);
  };
  if (voxels.grows.z) {
    collect(0, {0, 0, 0}, top);
    return;
  }
  for (std::int64_t k = 0; k < volume.extents.z; ++k)
    for (int coset = 0; coset < coset_count(volume.lattice); ++coset) collect(coset, {0, 0, k}, top);
}

VoxelScale scale_of(const std::vector<Cuboid>& cuboids) {
  VoxelScale scale;
  if (cuboids.empty()) return scale;
  scale.low = scale.high = cuboids.front().density;
  for (const Cuboid& c : cuboids) {
    scale.low = std::min(scale.low, double(c.density));
    scale.high = std::max(scale.high, double(c.density));
    scale.steepest = std::max(scale.steepest, glm::length(glm::dvec3(c.gradient)));
  }
  return scale;
}

}  // namespace

Voxels volume_voxels(const Volume& volume, const VoxelConfig& config, const Progress& progress) {
  const glm::i64vec3 cells = domain_max(volume.lattice, volume.extents);
  if (std::max({cells.x, cells.y, cells.z}) > kMostCells)
    throw InputError(fmt::format("--render: found bih for a volume of {} x {} x {} cells, expected at most {} along an axis", cells.x, cells.y, cells.z, kMostCells));
  const bool bcc = volume.lattice == LatticeKind::bcc;
  Voxels voxels;
  voxels.lattice = volume.lattice, voxels.extents = volume.extents, voxels.world = volume.world;
  voxels.unit = std::min({glm::length(volume.world.axes[0]), glm::length(volume.world.axes[1]), glm::length(volume.world.axes[2])});
  voxels.edge = bcc ? glm::ivec3(4, 4, 2) : glm::ivec3(2);
  voxels.grows = glm::bvec3(true, true, !bcc);
  voxels.samples = volume.sample_count();
  voxels.sample_bytes = voxels.samples * sample_type_bytes(volume.type());

  Collector collector(volume, config, voxels, progress);
  collect_all(collector, volume, voxels);
  voxels.scale = scale_of(collector.cuboids());
  voxels.data.reserve(collector.cuboids().size());
  voxels.places.reserve(collector.cuboids().size());
  for (const Cuboid& c : collector.cuboids()) {
    voxels.data.push_back(pack(VoxelShape::cuboid, c.density, glm::dvec3(c.gradient), voxels.scale));
    voxels.places.push_back({{c.low[0], c.low[1], c.low[2]}, c.level});
  }
  report(progress, 1.0);
  return voxels;
}

}  // namespace quincunx
