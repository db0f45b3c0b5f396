#include "app/heat.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <numeric>

#include "accel/structure.h"
#include "app/render_report.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

double mean(const std::vector<float>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}
double largest(const std::vector<float>& values) { return *std::max_element(values.begin(), values.end()); }

/// The place of a kind among a pixel's cost channels.
std::size_t cost_channel(HeatKind kind) {
  return kind == HeatKind::evaluations ? 0 : kind == HeatKind::steps ? 1 : 2;
}

/// What the numbers are.
std::string meaning(HeatKind kind, const Scene& scene, const RenderStats& stats) {
  if (stats.voxels)
    return kind == HeatKind::evaluations ? "voxels that a ray looks at" : kind == HeatKind::steps ? "nodes of the tree that a ray visits" : "voxels that a ray passes";
  const char* ray = scene.stub_sampling ? "the whole ray" : "a ray";
  if (kind == HeatKind::evaluations)
    return scene.intersect == Intersect::exact ? "polynomial pieces evaluated along a ray" : "samples of the spline along a ray";
  // Without a structure, and for the double-precision caster, there are no blocks.
  const std::string walked = stats.blocks > 0 ? fmt::format(" ({})", skip_label(stats.skip)) : "";
  if (kind == HeatKind::steps) return fmt::format("steps of the walk along {}{}", ray, walked);
  const std::string intervals = fmt::format("intervals that {} meets", ray);
  if (kind == HeatKind::intervals) return intervals + walked;
  const glm::i64vec3 n = stats.block_extents;
  return fmt::format("depth complexity{}: {} over {} + {} + {} blocks", walked, intervals, n.x, n.y, n.z);
}

}  // namespace

const std::vector<std::pair<std::string, HeatKind>>& heat_kinds() {
  static const std::vector<std::pair<std::string, HeatKind>> kinds{{"evaluations", HeatKind::evaluations},
                                                                   {"steps", HeatKind::steps},
                                                                   {"intervals", HeatKind::intervals},
                                                                   {"depth", HeatKind::depth}};
  return kinds;
}

void check_heat(HeatKind kind, const Scene& scene, const std::string& structure) {
  if (kind == HeatKind::evaluations && scene.stub_sampling) {
    throw InputError(
        "--heat: found evaluations with --stub-sampling, which evaluates nothing; expected steps, intervals or depth");
  }
  const bool counts_intervals = kind == HeatKind::intervals || kind == HeatKind::depth;
  if (counts_intervals && structure == "none")
    throw InputError("--heat: intervals and depth are a structure's, found --skip none; expected evaluations, steps or a structure");
}

HeatMap make_heat(HeatKind kind, const Frame& frame, const Scene& scene, const RenderStats& stats) {
  assert(kind != HeatKind::none && !frame.cost.empty());
  const double blocks = double(stats.block_extents.x + stats.block_extents.y + stats.block_extents.z);
  const double unit = kind == HeatKind::depth ? blocks : 1.0;
  HeatMap map{.width = frame.width, .height = frame.height, .values = {}, .title = {}, .maximum = {}};
  map.values.reserve(frame.cost.size() / 3);
  for (std::size_t i = cost_channel(kind); i < frame.cost.size(); i += 3) map.values.push_back(float(frame.cost[i] / unit));
  map.title = fmt::format("{}: mean {:.3g}, max {:.4g}", meaning(kind, scene, stats), mean(map.values), largest(map.values));
  return map;
}

nlohmann::ordered_json heat_json(HeatKind kind, const HeatMap& map) {
  const auto named = std::find_if(heat_kinds().begin(), heat_kinds().end(), [&](const auto& k) { return k.second == kind; });
  return {{"kind", named->first},
          {"max", largest(map.values)},
          {"mean", mean(map.values)},
          {"p99", percentile({map.values.begin(), map.values.end()}, 0.99)}};
}

}  // namespace quincunx
