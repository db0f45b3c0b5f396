#include "bench/cluster_masks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "bench/drawn_shapes.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

using glm::dvec3;
using std::numbers::pi;

/// Makes blocks active whose middles lie in shapes. Places in blocks.
class Painter {
 public:
  explicit Painter(int edge) : edge_(edge) {
    mask_.blocks = glm::i64vec3(edge);
    mask_.level.resize(std::size_t(edge) * std::size_t(edge) * std::size_t(edge));
  }

  double edge() const { return edge_; }
  double active_part() const { return double(mask_.active_blocks) / double(mask_.level.size()); }
  Classification take() { return std::move(mask_); }

  /// All blocks for which in(middle) holds, within `low`..`high`.
  template <class Shape>
  void fill(const dvec3& low, const dvec3& high, const Shape& in) {
    const glm::ivec3 first = glm::max(glm::ivec3(glm::floor(low)), glm::ivec3(0));
    const glm::ivec3 end = glm::min(glm::ivec3(glm::floor(high)) + 1, glm::ivec3(edge_));
    for (int z = first.z; z < end.z; ++z)
      for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) {
          std::uint8_t& level = mask_.level[(std::size_t(z) * std::size_t(edge_) + std::size_t(y)) * std::size_t(edge_) + std::size_t(x)];
          if (level == Classification::active || !in(dvec3(x, y, z) + 0.5)) continue;
          level = Classification::active;
          ++mask_.active_blocks;
        }
  }
  void fill_all(const auto& in) { fill(dvec3(0.0), dvec3(edge_), in); }
  void ellipsoid(const dvec3& middle, const dvec3& radii) {
    fill(middle - radii, middle + radii, [&](const dvec3& p) {
      const dvec3 q = (p - middle) / radii;
      return glm::dot(q, q) <= 1.0;
    });
  }

 private:
  int edge_;
  Classification mask_;
};

void strands(Painter& painter) {
  PortableRandom random;
  while (painter.active_part() < 1.0 / 12.0) {
    const double radius = random.uniform(1.0, 2.0);
    dvec3 p = random.point(painter.edge()), d = random.direction();
    for (; !outside(p, painter.edge()); p += 0.5 * d) {
      painter.ellipsoid(p, dvec3(radius));
      d = wound(d, 0.1, random);
    }
  }
}

void solid_parts(Painter& painter) {
  PortableRandom random;
  while (painter.active_part() < 1.0 / 7.0) draw_solid_part(painter, random);
}

void vessels(Painter& painter) {
  draw_vessels(painter, 0.7, [](int) {});
}

/// Blocks that g = sin x cos y + sin y cos z + sin z cos x, whose gradient is at most sqrt(3) long, may be 0 in.
void gyroid(Painter& painter) {
  const double k = 3.0 * 2.0 * pi / painter.edge(), most = 1.5 * k;
  std::vector<double> sine, cosine;
  for (double x = 0.5; x < painter.edge(); ++x) sine.push_back(std::sin(k * x)), cosine.push_back(std::cos(k * x));
  painter.fill_all([&](const dvec3& p) {
    const std::size_t x = std::size_t(p.x), y = std::size_t(p.y), z = std::size_t(p.z);
    return std::abs(sine[x] * cosine[y] + sine[y] * cosine[z] + sine[z] * cosine[x]) <= most;
  });
}

void noise(Painter& painter) {
  PortableRandom random;
  painter.fill_all([&](const dvec3&) { return random.uniform(0.0, 1.0) < 0.1; });
}

struct MaskGenerator {
  std::string_view name;
  void (*paint)(Painter&);
};
constexpr MaskGenerator mask_generators[] = {
    {"strands", strands}, {"solid parts", solid_parts}, {"vessels", vessels}, {"gyroid", gyroid}, {"noise", noise}};

}  // namespace

const std::vector<std::string_view>& mask_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> list;
    for (const MaskGenerator& generator : mask_generators) list.push_back(generator.name);
    return list;
  }();
  return names;
}

Classification generated_mask(std::string_view name, int edge) {
  assert(edge >= 1);
  for (const MaskGenerator& generator : mask_generators) {
    if (generator.name != name) continue;
    Painter painter(edge);
    generator.paint(painter);
    return painter.take();
  }
  throw InputError(fmt::format("mask: found '{}', expected one of {}", name, fmt::join(mask_names(), ", ")));
}

}  // namespace quincunx
