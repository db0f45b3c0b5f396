#include "app/render_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

#include "app/skip_flags.h"
#include "app/vector_json.h"

namespace quincunx {
namespace {

using Json = nlohmann::ordered_json;

struct Plane {
  std::vector<std::string> channels;
  std::span<const float> values;  ///< interleaved; empty where the frame has none
};

}  // namespace

Image to_image(const Frame& frame) {
  const std::vector<Plane> planes{{{"R", "G", "B", "A"}, frame.color},
                                  {{"Z"}, frame.depth},
                                  {{"N.X", "N.Y", "N.Z"}, frame.normal},
                                  {{"cost.evaluations", "cost.steps", "cost.intervals"}, frame.cost}};
  Image image{.width = frame.width, .height = frame.height, .channels = {}, .pixels = {}};
  for (const Plane& plane : planes) {
    if (!plane.values.empty())
      image.channels.insert(image.channels.end(), plane.channels.begin(), plane.channels.end());
  }
  const std::size_t pixels = std::size_t(frame.width) * std::size_t(frame.height);
  image.pixels.resize(pixels * image.channels.size());
  std::size_t first = 0;
  for (const Plane& plane : planes) {
    if (plane.values.empty()) continue;
    const std::size_t width = plane.channels.size();
    assert(plane.values.size() == pixels * width);
    for (std::size_t p = 0; p < pixels; ++p) {
      const auto from = plane.values.subspan(p * width, width);
      std::copy(from.begin(), from.end(), image.pixels.begin() + std::ptrdiff_t(p * image.channels.size() + first));
    }
    first += width;
  }
  return image;
}

Image to_opaque_image(const Frame& frame) {
  Image image{.width = frame.width, .height = frame.height, .channels = {"R", "G", "B"}, .pixels = {}};
  image.pixels.reserve(frame.color.size() / 4 * 3);
  for (std::size_t first = 0; first < frame.color.size(); first += 4) {
    image.pixels.insert(image.pixels.end(), frame.color.begin() + std::ptrdiff_t(first),
                        frame.color.begin() + std::ptrdiff_t(first + 3));
  }
  return image;
}

double percentile(std::vector<double> values, double fraction) {
  assert(!values.empty() && fraction >= 0.0 && fraction <= 1.0);
  std::sort(values.begin(), values.end());
  const double place = fraction * double(values.size() - 1);
  const std::size_t below = std::size_t(place), above = std::min(below + 1, values.size() - 1);
  return std::lerp(values[below], values[above], place - double(below));
}

// Keys that pictures of splines and of voxels have.

void add_camera(const Scene& scene, Json& json) {
  json["camera"] = {{"eye", vector_json(scene.camera.eye)},
                    {"target", vector_json(scene.camera.target)},
                    {"up", vector_json(scene.camera.up)},
                    {"fov", scene.camera.fov}};
}
void add_trace(const RenderStats& stats, Json& json) {
  const std::vector<double>& frames = stats.trace_ms;
  json["trace_ms"]["frames"] = frames.size();
  for (const auto& [key, fraction] : {std::pair{"median", 0.5}, {"p5", 0.05}, {"p95", 0.95}}) {
    json["trace_ms"][key] = frames.empty() ? Json() : Json(percentile(frames, fraction));
  }
}
void add_counts(const RenderStats& stats, Json& json) {
  json["rays"] = stats.rays;
  json["hits"] = stats.hits;
  json["evaluations"] = stats.evaluations;
  json["steps"] = stats.steps;
  json["intervals"] = stats.intervals;
}
void add_device_bytes(const RenderStats& stats, Json& json) {
  json["device_bytes"] = Json::object();
  for (const auto& [purpose, bytes] : stats.device_bytes) json["device_bytes"][purpose] = bytes;
}

/// How a volume was looked at.
Json volume_json(const DirectVolume& volume) {
  Json json{{"classify", volume.classify == Classify::post ? "post" : "pre-integrated"}, {"entries", volume.table_entries()},
            {"step", volume.step}, {"shade", volume.shade}, {"termination", volume.termination}};
  if (volume.adaptive) json["adaptive"] = volume.finest;
  if (volume.modulated()) json["modulate"] = {volume.modulate_from, volume.modulate_to};
  if (volume.jitter) json["jitter"] = *volume.jitter;
  return json;
}

Json segments_json(const SegmentStats& segments) {
  return {{"capacity", segments.capacity}, {"ms", percentile(segments.ms, 0.5)}, {"steps", segments.steps}, {"listed", segments.listed}, {"full", segments.full}};
}

Json bricks_json(const BrickStats& bricks) {
  return {{"edge", bricks.edge}, {"count", bricks.count}, {"slots", bricks.slots}, {"resident", bricks.resident}, {"loads", bricks.loads},
          {"evictions", bricks.evictions}, {"loaded_bytes", bricks.loaded_bytes}, {"rounds", bricks.rounds}, {"load_ms", bricks.load_ms}};
}

Json stats_json(const std::string& volume, const Renderer::Request& request, const RenderStats& stats, double read_ms) {
  const Scene& scene = request.scene;
  Json json{{"volume", volume}, {"device", stats.device}, {"size", {scene.width, scene.height}}};
  json["isovalues"] = isovalues_of(scene.isosurfaces);
  if (scene.volume) json["transfer_function"] = volume_json(*scene.volume);
  json["intersect"] = scene.intersect == Intersect::exact ? "exact" : "march";
  if (scene.intersect == Intersect::march) json["step"] = scene.step;
  json["normal"] = normal_name(scene.normal);
  if (scene.normal == Normal::central) json["delta"] = scene.delta;
  json["precision"] = precision_name(stats.precision);
  json["storage"] = stats.storage;
  json["structure"] = stats.skip.structure;
  if (stats.skip.structure == "bvh") json["cluster"] = clustering_name(stats.skip.clustering);
  if (stats.skip.structure == "kdtree") json["kd"] = kd_name(stats.skip.kd);
  if (stats.skip.structure == "hybrid") json["hybrid"] = hybrid_name(stats.skip.hybrid);
  if (has_large_leaves(stats.skip)) json["least_leaf"] = stats.skip.least_leaf;
  if (stats.blocks > 0) json["block"] = stats.skip.block;
  json["cell_test"] = stats.skip.cell_test;
  add_camera(scene, json);
  add_trace(stats, json);
  json["stages_ms"] = {{"read", read_ms},           {"prefilter", stats.prefilter_ms},
                       {"bounds", stats.bounds_ms}, {"classify", stats.classify_ms},
                       {"cluster", stats.cluster_ms}, {"build", stats.build_ms},
                       {"table", stats.table_ms},   {"upload", stats.upload_ms}, {"compile", stats.compile_ms}};
  add_counts(stats, json);
  json["blocks"] = stats.blocks;
  json["active_blocks"] = stats.active_blocks;
  json["active_cells"] = stats.active_cells;
  json["void_cells"] = stats.void_cells;
  json["leaves"] = stats.leaves;
  json["nodes"] = stats.nodes;
  json["one_child"] = stats.one_child;
  json["depth"] = stats.depth;
  if (stats.segments.capacity > 0) json["segments"] = segments_json(stats.segments);
  if (stats.bricks.edge > 0) json["bricks"] = bricks_json(stats.bricks);
  add_device_bytes(stats, json);
  return json;
}

Json voxels_json(const std::string& subject, const Renderer::Request& request, const RenderStats& stats, const VoxelTimes& times) {
  const Scene& scene = request.scene;
  const DirectVolume& look = *scene.volume;
  const VoxelStats& voxels = *stats.voxels;
  Json json{{"volume", subject}, {"device", stats.device}, {"size", {scene.width, scene.height}}, {"render", "bih"}};
  json["transfer_function"] = {{"shade", look.shade}, {"termination", look.termination}};
  if (look.modulated()) json["transfer_function"]["modulate"] = {look.modulate_from, look.modulate_to};
  add_camera(scene, json);
  add_trace(stats, json);
  json["stages_ms"] = {{"read", times.read}, {"resample", times.resample}, {"voxels", times.voxels}, {"build", stats.build_ms},
                       {"table", stats.table_ms}, {"upload", stats.upload_ms}, {"compile", stats.compile_ms}};
  add_counts(stats, json);
  json["shape"] = voxels.shape;
  json["voxels"] = voxels.voxels;
  json["samples"] = voxels.samples;
  json["nodes"] = voxels.nodes;
  json["one_child"] = voxels.one_child;
  json["depth"] = voxels.depth;
  json["bytes"] = {{"data", voxels.leaf_bytes}, {"places", voxels.place_bytes}, {"nodes", voxels.node_bytes}, {"grid", voxels.grid_bytes}};
  add_device_bytes(stats, json);
  return json;
}

Json explain_json(const std::vector<Feature>& features) {
  Json json = Json::array();
  for (const Feature& feature : features) {
    json.push_back({{"name", feature.name}, {"compiled", feature.compiled}, {"why", feature.why}});
  }
  return json;
}

std::string explain_text(const std::vector<Feature>& features) {
  if (features.empty()) return "No kernel is compiled: the CPU renders by itself.\n";
  std::size_t width = 0;
  for (const Feature& feature : features) width = std::max(width, feature.name.size());
  std::string text;
  for (const bool compiled : {true, false}) {
    for (const Feature& feature : features) {
      if (feature.compiled != compiled) continue;
      text += fmt::format("{}  {:<{}}  {}\n", compiled ? "in " : "out", feature.name, width, feature.why);
    }
  }
  return text;
}

}  // namespace quincunx
