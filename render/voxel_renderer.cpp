#include "render/voxel_renderer.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "accel/bih_build.h"
#include "lattice/error.h"
#include "lattice/stopwatch.h"
#include "render/reference_voxels.h"
#include "render/trace_frame.h"
#include "render/transfer_table.h"
#include "render/voxel_table.h"
#include "shaders/shaders.h"

namespace quincunx {
namespace {

constexpr int kTile = 8;                       // pixels of a group's edge
constexpr std::int64_t kBandPixels = 1 << 20;  // of one dispatch at most, so that progress and Ctrl-C come through
constexpr std::uint64_t kPixelBytes = 16;      // of each buffer of the picture
constexpr int kMostForks = 48;                 // of the tree above a leaf: the stack of shaders/nearest_voxels.glsl

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& v) {
  return std::as_bytes(std::span<const T>(v));
}

/// The largest floats not above them.
glm::vec3 floats_below(const glm::dvec3& x) { return {float_below(x.x), float_below(x.y), float_below(x.z)}; }

/// `values` in the order of the leaves.
template <class T>
void reorder(std::vector<T>& values, const std::vector<std::uint32_t>& order) {
  std::vector<T> ordered;
  ordered.reserve(values.size());
  for (const std::uint32_t n : order) ordered.push_back(values[n]);
  values = std::move(ordered);
}

}  // namespace

gpu::KernelSource voxel_kernel(const VoxelVariant& variant) {
  gpu::KernelSource source{"voxels.comp", {}};
  for (const auto& [wanted, define] : {std::pair{variant.spheres, "SPHERES"}, {variant.lit, "LIT"}, {variant.modulated, "MODULATED"}, {variant.cost, "COST"}})
    if (wanted) source.defines.emplace_back(define, "1");
  return source;
}

VoxelRenderer::VoxelRenderer(std::shared_ptr<gpu::Device> device, Voxels voxels, const Config& config)
    : device_(std::move(device)), voxels_(std::move(voxels)), config_(config), stats_(voxel_stats(voxels_)) {
  if (config_.frame_bytes == 0) config_.frame_bytes = gpu::info(*device_).max_storage_buffer_range;
}

void VoxelRenderer::build(RenderStats& stats) {
  if (built_) return;
  const Stopwatch building;
  const glm::dvec3 centre = 0.5 * glm::dvec3(domain_max(voxels_.lattice, voxels_.extents));
  std::vector<BihBox> boxes;
  boxes.reserve(voxels_.size());
  for (std::size_t n = 0; n < voxels_.size(); ++n) {
    const VoxelBox box = voxels_.box(n);
    boxes.push_back({floats_below(box.low - centre), -floats_below(centre - box.high)});
  }
  Bih tree = build_bih(boxes, {.leaf_size = config_.leaf_size, .chunk_levels = 4, .max_forks = kMostForks});
  reorder(voxels_.data, tree.order);
  if (!voxels_.places.empty()) reorder(voxels_.places, tree.order);
  if (!voxels_.spheres.empty()) reorder(voxels_.spheres, tree.order);
  stats.build_ms = building.ms();
  stats_.nodes = tree.nodes.size(), stats_.one_child = tree.one_child, stats_.depth = tree.depth;
  numbers_.root_low = vec4(glm::vec3(tree.low), 0.0f);
  numbers_.root_step = vec4(glm::vec3(tree.step), 0.0f);
  stats_.node_bytes = tree.nodes.size() * sizeof(BihNode);

  const Stopwatch uploading;
  // A buffer has at least one texel.
  if (tree.nodes.empty()) tree.nodes.resize(1);
  if (voxels_.data.empty()) voxels_.data.resize(1), voxels_.places.resize(1), voxels_.spheres.resize(1);
  nodes_ = gpu::create_filled(*device_, bytes_of(tree.nodes), gpu::BufferUse::texel, "nodes", VK_FORMAT_R32G32_UINT);
  data_ = gpu::create_filled(*device_, bytes_of(voxels_.data), gpu::BufferUse::texel, "voxels", VK_FORMAT_R32G32_UINT);
  places_ = voxels_.shape == VoxelShape::cuboid ? gpu::create_filled(*device_, bytes_of(voxels_.places), gpu::BufferUse::texel, "places", VK_FORMAT_R32G32_UINT)
                                                : gpu::create_filled(*device_, bytes_of(voxels_.spheres), gpu::BufferUse::texel, "spheres", VK_FORMAT_R32G32B32A32_SFLOAT);
  stats.upload_ms += uploading.ms();
  voxels_.data = {}, voxels_.places = {}, voxels_.spheres = {};
  built_ = true;
}

VoxelVariant VoxelRenderer::variant(const Scene& scene) const {
  return {.spheres = voxels_.shape == VoxelShape::sphere, .lit = scene.volume->shade, .modulated = scene.volume->modulated(), .cost = scene.cost};
}

const gpu::Pipeline& VoxelRenderer::pipeline(const VoxelVariant& variant, double& compile_ms) {
  const auto known = pipelines_.find(variant);
  if (known != pipelines_.end()) return known->second;
  const Stopwatch watch;
  const auto files = [](std::string_view name) { return shader_file(name); };
  const auto made = pipelines_.emplace(variant, gpu::create_pipeline(*device_, gpu::compile(*device_, files, voxel_kernel(variant)))).first;
  compile_ms += watch.ms();
  return made->second;
}

void VoxelRenderer::upload_table(const DirectVolume& volume, RenderStats& stats) {
  if (tabled_ && *tabled_ == volume.function) return;
  const Stopwatch watch;
  const std::vector<glm::vec4> table = voxel_table(volume.function, voxels_.scale, voxels_.unit, cell_length(voxels_.world));
  table_ = gpu::create_filled(*device_, bytes_of(table), gpu::BufferUse::texel, "transfer table", VK_FORMAT_R32G32B32A32_SFLOAT);
  stats.table_ms = watch.ms();
  tabled_ = volume.function;
}

void VoxelRenderer::upload_parameters(const Scene& scene) {
  numbers_.edge = ivec4(voxels_.edge, int(voxels_.grows.x) + 2 * int(voxels_.grows.y) + 4 * int(voxels_.grows.z));
  numbers_.counts = ivec4(int(stats_.voxels > 0 ? stats_.nodes : 0), int(stats_.voxels), 0, 0);
  const DirectVolume& volume = *scene.volume;
  if (volume.modulated())
    numbers_.modulation = vec4(float(volume.modulate_from), float(1.0 / (volume.modulate_to - volume.modulate_from)), float(voxels_.scale.steepest / 16383.0), 0.0f);
  voxel_parameters_ = gpu::create_filled(*device_, std::as_bytes(std::span(&numbers_, 1)), gpu::BufferUse::uniform, "voxel parameters");
}

VoxelRenderer::Band VoxelRenderer::make_band(const Scene& scene) const {
  const std::int64_t pixels = std::min<std::int64_t>(kBandPixels, std::int64_t(config_.frame_bytes / kPixelBytes));
  Band band;
  band.rows = int(std::min<std::int64_t>(std::max<std::int64_t>(kTile, pixels / scene.width / kTile * kTile), scene.height));
  const std::uint64_t bytes = std::uint64_t(band.rows) * std::uint64_t(scene.width) * kPixelBytes;
  band.color = gpu::create_buffer(*device_, bytes, gpu::BufferUse::storage, "color");
  band.hit = gpu::create_buffer(*device_, bytes, gpu::BufferUse::storage, "hit");
  if (scene.cost) band.cost = gpu::create_buffer(*device_, bytes, gpu::BufferUse::storage, "cost");
  return band;
}

gpu::Resources VoxelRenderer::resources(const gpu::Pipeline& pipeline, const Band& band) const {
  gpu::Resources all{{"uniforms", parameters_}, {"voxelUniforms", voxel_parameters_}, {"voxelNodes", nodes_}, {"voxelData", data_},
                     {"voxelPlaces", places_}, {"transferTable", table_}, {"Color", band.color}, {"Hit", band.hit}, {"Cost", band.cost}};
  // What the variant leaves out is not bound.
  std::erase_if(all, [&](const auto& resource) {
    return std::none_of(pipeline.reflection.bindings.begin(), pipeline.reflection.bindings.end(), [&](const gpu::Binding& b) { return b.name == resource.first; });
  });
  return all;
}

void VoxelRenderer::finish_compiling(const gpu::Pipeline& pipeline, const Scene& scene, const Band& band) {
  TraceParameters p = make_parameters(scene);
  p.picture = ivec4(scene.width, scene.height, 0, 0);
  gpu::upload(*device_, parameters_, std::as_bytes(std::span(&p, 1)));
  gpu::dispatch(*device_, pipeline, resources(pipeline, band), {}, 1);
}

TraceParameters VoxelRenderer::make_parameters(const Scene& scene) {
  parameters_ = gpu::create_buffer(*device_, sizeof(TraceParameters), gpu::BufferUse::uniform, "parameters");
  return trace_parameters(scene, Coefficients<float>{voxels_.lattice, voxels_.extents, 0, voxels_.world, {}, {}});
}

double VoxelRenderer::trace(const gpu::Pipeline& pipeline, const Scene& scene, const Band& band, Frame* frame, const Progress& progress) {
  TraceParameters p = make_parameters(scene);
  double ms = 0.0;
  for (int row = 0; row < scene.height; row += band.rows) {
    const int rows = std::min(band.rows, scene.height - row);
    report(progress, double(row) / scene.height);
    p.picture = ivec4(scene.width, scene.height, row, rows);
    gpu::upload(*device_, parameters_, std::as_bytes(std::span(&p, 1)));
    ms += gpu::dispatch(*device_, pipeline, resources(pipeline, band), {}, std::uint32_t((scene.width + kTile - 1) / kTile), std::uint32_t((rows + kTile - 1) / kTile));
    if (!frame) continue;
    const std::size_t first = std::size_t(row) * std::size_t(scene.width), count = std::size_t(rows) * std::size_t(scene.width);
    gpu::download(*device_, band.color, std::as_writable_bytes(std::span(frame->color).subspan(4 * first, 4 * count)));
    std::vector<glm::vec4> pixels(count);
    gpu::download(*device_, band.hit, std::as_writable_bytes(std::span(pixels)));
    for (std::size_t i = 0; i < count; ++i) frame->depth[first + i] = pixels[i].w;
    if (frame->cost.empty()) continue;
    gpu::download(*device_, band.cost, std::as_writable_bytes(std::span(pixels)));
    for (std::size_t i = 0; i < count; ++i)
      for (int a = 0; a < 3; ++a) frame->cost[3 * (first + i) + std::size_t(a)] = pixels[i][a];
  }
  report(progress, 1.0);
  return ms;
}

void VoxelRenderer::describe(const Band& band, RenderStats& stats) const {
  stats.device = gpu::info(*device_).name;
  stats.voxels = stats_;
  stats.device_bytes = {{"nodes", nodes_.bytes}, {"voxels", data_.bytes}, {"places", places_.bytes}, {"transfer table", table_.bytes},
                        {"frame", band.color.bytes + band.hit.bytes + band.cost.bytes}, {"parameters", parameters_.bytes + voxel_parameters_.bytes}};
}

Frame VoxelRenderer::render(const Request& request, RenderStats& stats, const Progress& progress) {
  check_scene(request.scene);
  if (!request.scene.volume || !request.scene.isosurfaces.empty()) throw InputError("--render: found bih without a transfer function or with isosurfaces, expected --tf alone");
  stats = RenderStats{};
  build(stats);
  upload_table(*request.scene.volume, stats);
  upload_parameters(request.scene);

  const Scene& scene = request.scene;
  const gpu::Pipeline& made = pipeline(variant(scene), stats.compile_ms);
  const Band band = make_band(scene);
  const std::size_t pixels = std::size_t(scene.width) * std::size_t(scene.height);
  Frame frame{scene.width, scene.height, std::vector<float>(4 * pixels), std::vector<float>(pixels), std::vector<float>(3 * pixels),
              std::vector<float>(scene.cost ? 3 * pixels : 0)};
  if (stats.compile_ms > 0.0) {
    const Stopwatch rest;
    finish_compiling(made, scene, band);
    stats.compile_ms += rest.ms();
  }
  if (request.repeat > 1) trace(made, scene, band, nullptr, {});  // warm-up
  for (int i = 0; i < request.repeat; ++i) stats.trace_ms.push_back(trace(made, scene, band, i == 0 ? &frame : nullptr, i == 0 ? progress : Progress{}));
  describe(band, stats);
  if (request.count_costs) {
    Scene counting = scene;
    counting.cost = true;
    Frame counted = frame;
    counted.cost.resize(3 * pixels);
    RenderStats unused;
    const Band counting_band = make_band(counting);
    trace(pipeline(variant(counting), unused.compile_ms), counting, counting_band, &counted, {});
    const CostSums sums = cost_sums(counted);
    stats.evaluations = sums.evaluations, stats.steps = sums.steps, stats.intervals = sums.intervals;
  }
  stats.rays = pixels;
  stats.hits = count_hits(frame);
  if (config_.validation && !gpu::validation_messages(*device_).empty()) throw std::runtime_error("validation: " + gpu::validation_messages(*device_).front());
  return frame;
}

std::vector<Feature> VoxelRenderer::explain(const Request& request) {
  const VoxelVariant v = variant(request.scene);
  const auto feature = [](const char* name, bool wanted, const char* why, const char* why_not) { return Feature{name, wanted, wanted ? why : why_not}; };
  return {feature("bounding interval hierarchy", true, "--render bih", ""),
          feature("cuboids", !v.spheres, "voxels of a volume", "--particles"),
          feature("spheres", v.spheres, "--particles", "voxels of a volume"),
          feature("light on the voxels", v.lit, "--shade on", "--shade off"),
          feature("gradient modulation", v.modulated, "--modulate", "no --modulate"),
          feature("cost channels", v.cost, "costs were asked for", "no costs were asked for")};
}

std::unique_ptr<Renderer> make_voxel_renderer(const std::string& device, Voxels voxels, const VoxelRenderer::Config& config) {
  if (device == "cpu") return std::make_unique<ReferenceVoxelRenderer>(std::move(voxels));
  gpu::DeviceConfig choice;
  choice.select = device;
  choice.validation = choice.gpu_assisted = config.validation;
  return std::make_unique<VoxelRenderer>(gpu::open_device(choice), std::move(voxels), config);
}

}  // namespace quincunx
