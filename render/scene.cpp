#include "render/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lattice/error.h"

namespace quincunx {
namespace {

/// An image of more pixels than this does not fit the 32-bit indices of its planes (4 floats a pixel).
constexpr int kMaxSize = 16384;
/// A classification holds levels 0..254.
constexpr std::size_t kMaxIsosurfaces = 254;

/// Of tables of transfer functions.
constexpr double kLeastEntries = 2, kMostEntries = 65536, kMostPreIntegrated = 2048;

/// False for NaN.
bool within(double x, double low, double high) { return x >= low && x <= high; }

void check_range(double x, double low, double high, std::string_view flag) {
  if (!within(x, low, high)) throw InputError(fmt::format("{}: {}; expected a number from {} to {}", flag, x, low, high));
}

void check_color(const glm::dvec3& c, std::string_view flag) {
  if (!within(c.r, 0.0, 1.0) || !within(c.g, 0.0, 1.0) || !within(c.b, 0.0, 1.0))
    throw InputError(fmt::format("{}: {} {} {}; expected red, green and blue from 0 to 1", flag, c.r, c.g, c.b));
}

void check_isosurfaces(const Scene& scene) {
  const std::vector<Isosurface>& isosurfaces = scene.isosurfaces;
  if ((isosurfaces.empty() && !scene.volume) || isosurfaces.size() > kMaxIsosurfaces)
    throw InputError(fmt::format("--iso: {} isovalues; expected 1 to {}", isosurfaces.size(), kMaxIsosurfaces));
  for (const Isosurface& surface : isosurfaces) {
    if (!std::isfinite(surface.isovalue))
      throw InputError(fmt::format("--iso: {}; expected a finite number", surface.isovalue));
    check_color(surface.color, "--color");
    check_range(surface.opacity, 0.0, 1.0, "--opacity");
  }
  std::vector<double> values = isovalues_of(isosurfaces);
  std::sort(values.begin(), values.end());
  const auto twin = std::adjacent_find(values.begin(), values.end());
  if (twin != values.end()) throw InputError(fmt::format("--iso: {} stands twice; expected different isovalues", *twin));
}

void check_volume_look(const DirectVolume& volume) {
  check_transfer_function(volume.function, "--tf");
  const bool post = volume.classify == Classify::post;
  if (volume.entries != 0) check_range(volume.entries, kLeastEntries, post ? kMostEntries : kMostPreIntegrated, "--tf-entries");
  check_range(volume.step, 1e-3, 1e3, "--step");
  if (volume.adaptive && !post) throw InputError("--adaptive: found pre-integrated classification, expected --classify post");
  if (volume.adaptive) check_range(volume.finest, 1e-5, 1.0, "--adaptive");
  check_range(volume.termination, 0.0, 0.5, "--termination");
  if (!(volume.modulate_from == 0.0 && volume.modulate_to == 0.0) &&
      !(within(volume.modulate_from, 0.0, 1e30) && within(volume.modulate_to, 0.0, 1e30) && volume.modulated()))
    throw InputError(fmt::format("--modulate: {},{}; expected two gradient magnitudes, the second one larger", volume.modulate_from, volume.modulate_to));
}

}  // namespace

double cell_length(const World& world) {
  return std::min({glm::length(world.axes[0]), glm::length(world.axes[1]), glm::length(world.axes[2])});
}

std::string_view normal_name(Normal normal) {
  switch (normal) {
    case Normal::analytic: return "analytic";
    case Normal::central: return "central";
    case Normal::samples: return "samples";
  }
  return "";
}

double difference_step(const Scene& scene, LatticeKind lattice) { return scene.normal == Normal::samples ? lattice_step(lattice) : scene.delta; }

std::vector<Isosurface> visible_surfaces(const Scene& scene) {
  std::vector<Isosurface> surfaces = scene.isosurfaces;
  std::erase_if(surfaces, [](const Isosurface& s) { return s.opacity == 0.0; });
  std::sort(surfaces.begin(), surfaces.end(),
            [](const Isosurface& a, const Isosurface& b) { return a.isovalue < b.isovalue; });
  return surfaces;
}

std::vector<double> isovalues_of(const std::vector<Isosurface>& surfaces) {
  std::vector<double> values;
  for (const Isosurface& surface : surfaces) values.push_back(surface.isovalue);
  return values;
}

CostSums cost_sums(const Frame& frame) {
  double sums[3] = {};
  for (std::size_t i = 0; i < frame.cost.size(); ++i) sums[i % 3] += frame.cost[i];
  return {std::uint64_t(sums[0]), std::uint64_t(sums[1]), std::uint64_t(sums[2])};
}

std::uint64_t count_hits(const Frame& frame) {
  std::uint64_t hits = 0;
  for (std::size_t p = 0; p < frame.depth.size(); ++p) hits += std::isfinite(frame.depth[p]) || frame.color[4 * p + 3] > 0.0f;
  return hits;
}

void check_scene(const Scene& scene) {
  check_isosurfaces(scene);
  if (scene.volume) check_volume_look(*scene.volume);
  if (scene.width < 1 || scene.height < 1 || scene.width > kMaxSize || scene.height > kMaxSize)
    throw InputError(fmt::format("--size: {} x {}; expected 1 to {} pixels each way", scene.width, scene.height, kMaxSize));
  camera_frame(scene.camera, scene.width, scene.height, "--camera");
  check_color(scene.background, "--background");
  check_range(scene.ambient, 0.0, 1.0, "--ambient");
  check_range(scene.step, 1e-3, 1e3, "--step");
  check_range(scene.delta, 1e-3, 1e2, "--delta");
}

}  // namespace quincunx
