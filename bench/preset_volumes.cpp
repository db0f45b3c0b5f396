#include "bench/preset_volumes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>

#include "bench/drawn_shapes.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

using glm::dvec3;

constexpr double kThreshold = 128.0, kValueSlope = 32.0;  ///< values per cell of distance
constexpr double kSoft = 4.0;                        ///< cells about a surface within which values differ: more is 0 or 255
constexpr int kBlock = 4;                            ///< cells: of the blocks whose active part is told

/// Draws shapes into samples. Places in cells.
class Splatter {
 public:
  Splatter(LatticeKind lattice, int cells) {
    volume_.lattice = lattice;
    volume_.extents = Extents(lattice == LatticeKind::bcc ? (cells + 1) / 2 : cells + 1);
    edge_ = double(domain_max(lattice, volume_.extents).x);
    blocks_ = (int(edge_) + kBlock - 1) / kBlock;
    const std::int64_t n = volume_.extents.x;
    samples_.resize(std::size_t(coset_count(lattice)) * std::size_t(n * n * n));
    active_.resize(std::size_t(blocks_) * std::size_t(blocks_) * std::size_t(blocks_));
  }

  double edge() const { return edge_; }
  double step() const { return double(lattice_step(volume_.lattice)); }  ///< from one sample of a row to the next
  double active_part() const { return double(active_blocks_) / double(active_.size()); }
  Volume take() {
    volume_.samples = std::move(samples_);
    return std::move(volume_);
  }

  /// Each sample at u within low..high becomes value(u, its value), which is 0..255.
  template <class Value>
  void change(const dvec3& low, const dvec3& high, const Value& value) {
    const int step = lattice_step(volume_.lattice);
    const std::int64_t n = volume_.extents.x;
    for (int coset = 0; coset < coset_count(volume_.lattice); ++coset) {
      const glm::i64vec3 first = glm::max(glm::i64vec3(glm::ceil((low - double(coset)) / double(step))), glm::i64vec3(0));
      const glm::i64vec3 last = glm::min(glm::i64vec3(glm::floor((high - double(coset)) / double(step))), glm::i64vec3(n - 1));
      for (std::int64_t k = first.z; k <= last.z; ++k)
        for (std::int64_t j = first.y; j <= last.y; ++j)
          for (std::int64_t i = first.x; i <= last.x; ++i) {
            const dvec3 u = dvec3(i * step + coset, j * step + coset, k * step + coset);
            std::uint8_t& sample = samples_[std::size_t(((coset * n + k) * n + j) * n + i)];
            sample = std::uint8_t(std::lround(std::clamp(value(u, double(sample)), 0.0, 255.0)));
            if (sample >= kThreshold) mark(u);
          }
    }
  }
  void change_all(const auto& value) { change(dvec3(0.0), dvec3(edge_), value); }
  /// The nearer of what is there and an ellipsoid; the distance from its surface along its shortest radius.
  void ellipsoid(const dvec3& middle, const dvec3& radii) {
    const double least = std::min({radii.x, radii.y, radii.z});
    const dvec3 reach = radii * (1.0 + kSoft / least);
    change(middle - reach, middle + reach, [&](const dvec3& u, double before) {
      return std::max(before, kThreshold + kValueSlope * least * (1.0 - glm::length((u - middle) / radii)));
    });
  }
  /// Adds a point's mass, `most` at itself, none 2 cells away.
  void point(const dvec3& middle, double most) {
    change(middle - 2.0, middle + 2.0, [&](const dvec3& u, double before) { return before + most * std::max(0.0, 1.0 - 0.5 * glm::length(u - middle)); });
  }

 private:
  void mark(const dvec3& u) {
    const glm::ivec3 b = glm::min(glm::ivec3(u) / kBlock, glm::ivec3(blocks_ - 1));
    std::uint8_t& active = active_[(std::size_t(b.z) * std::size_t(blocks_) + std::size_t(b.y)) * std::size_t(blocks_) + std::size_t(b.x)];
    active_blocks_ += active == 0;
    active = 1;
  }

  Volume volume_;
  std::vector<std::uint8_t> samples_, active_;
  std::size_t active_blocks_ = 0;
  double edge_ = 0.0;
  int blocks_ = 0;
};

/// Calls `add` until `part` of the blocks are active.
void add_until(Splatter& splatter, double part, const Progress& progress, const auto& add) {
  while (splatter.active_part() < part) {
    report(progress, splatter.active_part() / part);
    add();
  }
}

void strands(Splatter& splatter, const Progress& progress) {
  PortableRandom random;
  add_until(splatter, 1.0 / 12.0, progress, [&] {
    const double radius = random.uniform(2.0, 4.0);
    dvec3 u = random.point(splatter.edge()), d = random.direction();
    for (; !outside(u, splatter.edge()) && splatter.active_part() < 1.0 / 12.0; u += 0.5 * radius * d) {
      splatter.ellipsoid(u, dvec3(radius));
      d = wound(d, 0.1, random);
    }
  });
}

void solid_parts(Splatter& splatter, const Progress& progress) {
  PortableRandom random;
  add_until(splatter, 1.0 / 7.0, progress, [&] { draw_solid_part(splatter, random); });
}

void vessels(Splatter& splatter, const Progress& progress) {
  draw_vessels(splatter, 1.0, [&](int n) { report(progress, n / 3.0); });
}

void points(Splatter& splatter, const Progress& progress) {
  PortableRandom random;
  const double edge = splatter.edge();
  std::vector<dvec3> centres;
  for (int n = 0; n < 32; ++n) centres.push_back(random.point(edge));
  add_until(splatter, 1.0 / 12.0, progress, [&] {
    for (const dvec3& centre : centres) {
      const double r = random.uniform(0.0, 1.0);
      splatter.point(centre + 0.2 * edge * r * r * random.direction(), 160.0);
    }
  });
}

/// Along x a wave goes on by a factor, so that no sine is taken for a sample.
void waves(Splatter& splatter, const Progress&) {
  struct Wave {
    dvec3 k;
    double phase;
  };
  PortableRandom random;
  std::vector<Wave> all;
  for (int n = 0; n < 16; ++n)
    all.push_back({2.0 * std::numbers::pi / splatter.edge() * random.uniform(2.0, 6.0) * random.direction(), random.uniform(0.0, 2.0 * std::numbers::pi)});
  std::vector<std::complex<double>> now(all.size()), factor;
  for (const Wave& wave : all) factor.push_back(std::polar(1.0, wave.k.x * splatter.step()));
  splatter.change_all([&](const dvec3& u, double) {
    double sum = 0.0;
    const bool begins = u.x < splatter.step();  // a row, with a sample of either coset
    for (std::size_t n = 0; n < all.size(); ++n) {
      now[n] = begins ? std::polar(1.0, glm::dot(all[n].k, u) + all[n].phase) : now[n] * factor[n];
      sum += now[n].real();
    }
    return 127.5 + 30.0 * sum / std::sqrt(double(all.size()) / 2.0);
  });
}

struct VolumeGenerator {
  std::string_view name;
  void (*draw)(Splatter&, const Progress&);
};
constexpr VolumeGenerator volume_generators[] = {{"strands", strands}, {"solid parts", solid_parts}, {"vessels", vessels}, {"points", points}, {"waves", waves}};

}  // namespace

const std::vector<std::string_view>& preset_volume_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> list;
    for (const VolumeGenerator& generator : volume_generators) list.push_back(generator.name);
    return list;
  }();
  return names;
}

PresetVolume generated_volume(std::string_view name, LatticeKind lattice, int cells, const Progress& progress) {
  assert(cells >= 8);
  for (const VolumeGenerator& generator : volume_generators) {
    if (generator.name != name) continue;
    Splatter splatter(lattice, cells);
    generator.draw(splatter, progress);
    return {.name = std::string(name), .volume = splatter.take(), .threshold = kThreshold, .soft = 64.0};
  }
  throw InputError(fmt::format("volume: found '{}', expected one of {}", name, fmt::join(preset_volume_names(), ", ")));
}

PresetVolume generated_balls(int count, double radius, LatticeKind lattice, int cells) {
  Splatter splatter(lattice, cells);
  PortableRandom random;
  for (int n = 0; n < count; ++n) splatter.ellipsoid(random.point(splatter.edge()), dvec3(radius));
  return {.name = "balls", .volume = splatter.take(), .threshold = kThreshold, .soft = 64.0};
}

}  // namespace quincunx
