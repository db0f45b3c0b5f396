#include "render/device_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#include "accel/streamed_bounds.h"
#include "lattice/error.h"
#include "lattice/stopwatch.h"
#include "render/seen_values.h"
#include "render/tracer.h"
#include "render/transfer_table.h"

namespace quincunx {
namespace {

constexpr int kTile = 8;                     // pixels of a group's edge
constexpr std::int64_t kBandPixels = 1 << 21;  // of one dispatch at most, so that progress and Ctrl-C come through
constexpr std::uint64_t kPixelBytes = 16;      // of each buffer of the picture
constexpr std::uint64_t kRayBytes = 16;        // of the list of rays.glsl; twice as many where t is a double
constexpr std::uint64_t kRayCountBytes = 16;   // before the list of rays.glsl
constexpr std::uint64_t kParkedBytes = 96;     // of a ray of park.glsl
constexpr std::uint32_t kTraceGroup = 64;      // rays of a group
constexpr std::int64_t kMostCells = 65535;     // along an axis: lists of roots and boxes hold 16 bits (root.glsl, box.glsl)
constexpr std::uint32_t kRaysPerLane = 16;     // of the seeking pass, one after another, on a CPU

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& v) {
  return std::as_bytes(std::span<const T>(v));
}

std::string pieces_of(const Spline& spline) { return fmt::format("pieces of {}", spline.name()); }

/// A picture's edge in whole tiles.
std::int64_t round_up(std::int64_t pixels) { return (pixels + kTile - 1) / kTile * kTile; }

/// What the pass of segments counts (shaders/segments_octree.glsl).
struct SegmentCounts {
  std::uint32_t steps = 0, listed = 0, full = 0;
};

/// Whether both are looked up in the same table.
bool same_table(const DirectVolume& a, const DirectVolume& b) {
  return a.function == b.function && a.classify == b.classify && a.table_entries() == b.table_entries() && a.step == b.step;
}

}  // namespace

DeviceRenderer::DeviceRenderer(std::shared_ptr<KernelCache> kernels, const Volume& volume, const Config& config, const DeviceLimits& limits)
    : kernels_(std::move(kernels)), device_(kernels_->device()), config_(config), limits_(limits),
      spline_(make_spline(config.spline, volume.lattice)), volume_(volume), skipping_(std::in_place, device_) {
  const gpu::DeviceInfo& device_info = gpu::info(device_);
  if (limits_.texel_elements == 0) limits_.texel_elements = device_info.max_texel_buffer_elements;
  if (limits_.frame_bytes == 0) limits_.frame_bytes = device_info.max_storage_buffer_range;
  check_storage(config.storage, config.precision);
  check_precision();
  check_device_storage();
}

DeviceRenderer::DeviceRenderer(std::shared_ptr<KernelCache> kernels, std::shared_ptr<const SampleSource> source, const std::string& what,
                               const Config& config, const DeviceLimits& limits)
    : DeviceRenderer(std::move(kernels), source->header(), config, limits) {
  assert(config.pool_bytes);
  if (config.nan.kind == NanPolicy::Kind::empty && may_not_be_finite(volume_))
    throw InputError("--nan: found empty for a volume that is read brick by brick (--pool), expected fill=V or refuse");
  if (config.precision == Precision::float64)
    throw InputError("--precision: found double with a pool of bricks (--pool), expected float: bricks hold 32-bit floats");
  source_ = config.nan.kind == NanPolicy::Kind::fill ? filled_source(std::move(source), config.nan.value) : std::move(source);
  what_ = what;
}

// ---- what a request needs ----

void DeviceRenderer::check_precision() const {
  if (config_.precision == Precision::float32 || (gpu::features(device_).float64 && !limits_.no_float64)) return;
  throw gpu::DeviceError(fmt::format("--precision: found double, expected float: {} has no 64-bit floats (shaderFloat64)", gpu::info(device_).name));
}

void DeviceRenderer::check_device_storage() const {
  if (config_.storage == Storage::float32 || (gpu::reads_texels(device_, format().texels()) && !limits_.no_small_texels)) return;
  throw gpu::DeviceError(fmt::format("--storage: found {}, expected float32: {} has no texel buffers of it", storage_name(config_.storage), gpu::info(device_).name));
}

void DeviceRenderer::check_cells() const {
  const glm::i64vec3 cells = domain_max(volume_.lattice, volume_.extents);
  if (std::max(cells.x, std::max(cells.y, cells.z)) > kMostCells)
    throw InputError(fmt::format("volume: {} x {} x {} cells; expected at most {} along an axis", cells.x, cells.y, cells.z, kMostCells));
}

TexelLayout DeviceRenderer::coefficient_layout() const {
  if (bricks_) return bricks_->texels();
  if (coefficients_) return texels_.layout();
  check_cells();
  return texel_layout(coefficient_count(volume_.lattice, volume_.extents, spline_->apron()), limits_.texel_elements, gpu::info(device_).name);
}

void DeviceRenderer::check_intersect(const Scene& scene) const {
  if (spline_->polynomial() || scene.intersect == Intersect::march || scene.isosurfaces.empty() || scene.stub_sampling) return;
  throw InputError(fmt::format("--intersect: found exact, expected march: {} are no polynomials (--device cpu finds their first roots)", pieces_of(*spline_)));
}

void DeviceRenderer::check_bricks(const Scene& scene) const {
  if (!source_ || scene.isosurfaces.empty()) return;
  if (!spline_->polynomial()) throw InputError(fmt::format("--pool: found surfaces whose {} are no polynomials, expected --tf alone or another --spline", pieces_of(*spline_)));
  if (scene.intersect == Intersect::march) throw InputError("--pool: found --intersect march, expected --intersect exact");
  if (scene.normal != Normal::analytic)
    throw InputError(fmt::format("--pool: found --normal {}, whose differences reach beyond a brick; expected --normal analytic", normal_name(scene.normal)));
}

KernelVariant DeviceRenderer::variant(const Request& request) const {
  const std::vector<Isosurface> surfaces = visible_surfaces(request.scene);
  const std::unique_ptr<SkippingStructure> structure = make_structure(request.skip);
  const TexelLayout layout = coefficient_layout();
  KernelVariant v;
  v.spline_shader = spline_->shader();
  set_structure(v, *structure);
  v.cell_test = request.skip.cell_test && request.skip.structure != "none";
  v.intersect = request.scene.intersect;
  v.normal = request.scene.normal == Normal::analytic ? Normal::analytic : Normal::central;
  v.surfaces = !surfaces.empty();
  v.many_isovalues = surfaces.size() > 1;
  v.composite = std::any_of(surfaces.begin(), surfaces.end(), [&](const Isosurface& s) { return s.opacity < 1.0 || request.scene.volume || source_; });
  if (request.scene.volume) {
    const DirectVolume& volume = *request.scene.volume;
    v.volume = true;
    v.pre_integrated = volume.classify == Classify::pre_integrated;
    v.adaptive = volume.adaptive;
    v.lit = volume.shade;
    v.modulated = volume.modulated();
    v.jitter = volume.jitter.has_value();
  }
  if (!v.surfaces) v.intersect = Intersect::exact, v.normal = Normal::analytic;
  v.stub = request.scene.stub_sampling;
  v.cost = request.scene.cost || v.stub;
  v.bricks = source_ != nullptr;
  v.brick_units = v.bricks && config_.storage != Storage::float32;
  v.voids = voids_ && voids_->count > 0;
  v.precision = config_.precision;
  v.coefficient_buffers = layout.buffers;
  v.coefficient_shift = layout.shift;
  return v;
}

std::vector<Feature> DeviceRenderer::explain(const Request& request) {
  check_intersect(request.scene);
  RenderStats unused;
  prepare_samples(unused);
  Request completed = request;
  const SkipChoice choice = complete(request, unused, {});
  completed.skip = choice.config;
  std::vector<Feature> features;
  for (const KernelPart& part : kernel_parts(variant(completed))) features.push_back(part.feature);
  const std::string label = completed.skip.structure == "none" ? "none" : fmt::format("{}, blocks of {} cells", skip_label(completed.skip), completed.skip.block);
  for (Feature& feature : features) {
    if (feature.name == kSkipPart && !choice.why.empty()) feature.why = fmt::format("{}: {}", label, choice.why);
    if (feature.name == kDifferencesPart && feature.compiled) feature.why = fmt::format("--normal {}", normal_name(request.scene.normal));
    if (feature.name == kExactPart && !spline_->polynomial()) feature.why = fmt::format("{} are no polynomials", pieces_of(*spline_));
  }
  const Spline::Prefilter prefilter = spline_->filter(config_.prefilter).kind;
  features.push_back({"small coefficients", config_.storage != Storage::float32,
                      fmt::format("--storage {}: {} bytes a coefficient", format().name(), format().bytes())});
  features.push_back({"prefilter pass", prefilter != Spline::Prefilter::none, fmt::format("{} of {}", prefilter_name(prefilter), spline_->name())});
  return features;
}

// ---- stages, each done only when what it depends on has changed ----

void DeviceRenderer::prepare_samples(RenderStats& stats) {
  if (voids_) return;
  const Stopwatch watch;
  voids_ = source_ ? VoidCells{} : make_finite(volume_, *spline_, config_.nan);
  stats.prefilter_ms += watch.ms();
  if (voids_->count > 0)
    void_buffer_ = gpu::create_filled(device_, bytes_of(voids_->words), gpu::BufferUse::texel, "voids", VK_FORMAT_R32G32_UINT);
}

void DeviceRenderer::prepare_coefficients(RenderStats& stats, const Progress& progress) {
  if (coefficients_) return;
  check_cells();
  if (source_) {
    const ValueUnit unit = source_unit(progress);
    const BrickLayout layout(volume_.lattice, volume_.extents, spline_->apron(), config_.brick, config_.storage);
    bricks_.emplace(device_, layout, std::make_shared<SampleBricks>(layout, *source_, *spline_, config_.prefilter, unit), *config_.pool_bytes,
                    limits_.texel_elements);
    coefficients_ = Coefficients<float>{volume_.lattice, volume_.extents, spline_->apron(), volume_.world, {}, unit};
    return;
  }
  coefficient_layout();
  prepare_samples(stats);
  const Stopwatch prefilter;
  const std::vector<std::byte> read = make_coefficients(progress);
  stats.prefilter_ms += prefilter.ms();
  volume_.samples = {};

  const Stopwatch upload;
  texels_ = CoefficientTexels(device_, coefficients_->data.size(), limits_.texel_elements, "coefficients", format());
  texels_.upload(device_, 0, read.empty() ? bytes_of(coefficients_->data) : std::span(read));
  stats.upload_ms += upload.ms();
}

std::vector<std::byte> DeviceRenderer::make_coefficients(const Progress& progress) {
  if (config_.precision == Precision::float32) {
    std::vector<std::byte> packed;
    coefficients_ = stored_coefficients(*spline_, volume_, config_.prefilter, config_.storage, progress, &packed);
    return packed;
  }
  const SampleRange range = sample_range(volume_);
  const ValueUnit unit = float_unit(volume_.type(), range.min, range.max);
  Coefficients<double> exact = spline_->coefficients(volume_, config_.prefilter, progress);
  exact.unit = unit;
  for (double& c : exact.data) c = unit.number(c);
  value_rounding_ = value_rounding(exact);
  coefficients_ = narrowed(exact);
  const std::span<const std::byte> bytes = bytes_of(exact.data);
  return {bytes.begin(), bytes.end()};
}

void DeviceRenderer::prepare_bounds(const Request& request, RenderStats& stats, const Progress& progress) {
  const int finest = source_ ? std::min(request.skip.block > 0 ? request.skip.block : kChoiceBlock, config_.brick) : 1;
  if (bounds_ && bounds_->finest() <= finest) return;
  const Stopwatch watch;
  if (source_) {
    StreamedBounds streamed = streamed_bounds(*source_, *spline_, config_.prefilter, finest, what_, progress, source_range_, &bricks_->layout());
    bounds_.emplace(streamed.scale, std::move(streamed.blocks));
    skipping_.emplace(device_);
  } else {
    CellBounds cells = cell_bounds(*spline_, *coefficients_, progress);
    leave_out(*voids_, cells);
    bounds_.emplace(std::move(cells));
  }
  stats.bounds_ms = watch.ms();
}

void DeviceRenderer::check_samples(const Progress& progress) {
  if (!source_ || bounds_ || source_range_) return;
  const SampleRange range = sample_range(*source_, progress);
  check_finite(range, source_->header(), what_);
  source_range_ = range;
}

ValueUnit DeviceRenderer::source_unit(const Progress& progress) {
  if (volume_.type() != SampleType::float32) return {};
  check_samples(progress);
  return float_unit(volume_.type(), source_range_->min, source_range_->max);
}

std::vector<ValueRange> DeviceRenderer::seen_numbers(const Scene& scene) const { return numbers_of(seen_values(scene), coefficients_->unit); }

SkipChoice DeviceRenderer::complete(const Request& request, RenderStats& stats, const Progress& progress) {
  SkipConfig wanted = request.skip;
  wanted.cell_test = wanted.cell_test && !source_;  // of a volume that stays in its file, only blocks are bounded
  if (wanted.structure == "none" || !is_open(wanted)) return {wanted, ""};
  prepare_coefficients(stats, progress);
  prepare_bounds(request, stats, progress);
  return skipping_->choose(wanted, *bounds_, seen_numbers(request.scene), request.scene.volume && visible_surfaces(request.scene).empty(), stats);
}

void DeviceRenderer::upload_isosurfaces(const std::vector<Isosurface>& isosurfaces) {
  std::vector<float> data;
  for (const Isosurface& s : isosurfaces) {
    const ValueUnit& unit = coefficients_->unit;
    const auto words = std::bit_cast<std::array<float, 2>>(unit.number(s.isovalue) - value_rounding_);
    data.insert(data.end(), {kernel_isovalue(s.isovalue, unit), float(s.opacity), words[0], words[1]});
    data.insert(data.end(), {float(s.color.r), float(s.color.g), float(s.color.b), 0.0f});
  }
  if (data.empty()) return;
  isosurfaces_ = gpu::create_filled(device_, bytes_of(data), gpu::BufferUse::storage, "isosurfaces");
}

void DeviceRenderer::upload_transfer_table(const Scene& scene, RenderStats& stats) {
  if (!scene.volume) return;
  const DirectVolume& v = *scene.volume;
  if (tabled_ && same_table(*tabled_, v)) return;
  tabled_.reset();
  const double cell = cell_length(coefficients_->world), length = v.step * cell;
  const Stopwatch watch;
  const std::vector<glm::vec4> entries = v.classify == Classify::post ? bake(v.function, v.table_entries(), length, cell).entries
                                                                      : pre_integrate(v.function, v.table_entries(), length, cell).cells;
  stats.table_ms = watch.ms();
  transfer_table_ = gpu::create_filled(device_, bytes_of(entries), gpu::BufferUse::texel, "transfer table", VK_FORMAT_R32G32B32A32_SFLOAT);
  stats.upload_ms += watch.ms() - stats.table_ms;
  tabled_ = v;
}

// ---- pictures ----

std::uint64_t DeviceRenderer::segment_bytes() const {
  const std::optional<SegmentPass> pass = skipping_->segment_pass();
  return pass ? std::uint64_t(pass->capacity) * (config_.precision == Precision::float64 ? 16 : 8) : 0;
}

DeviceRenderer::Band DeviceRenderer::make_band(const Scene& scene, bool cost) {
  const std::uint64_t ray_bytes = kRayBytes * (config_.precision == Precision::float64 ? 2 : 1), list_bytes = segment_bytes();
  const std::uint64_t most_bytes = std::max({kPixelBytes, ray_bytes, list_bytes, bricks_ ? kParkedBytes : 0});
  std::int64_t pixels = std::min<std::int64_t>(kBandPixels, std::int64_t(limits_.frame_bytes / most_bytes));
  if (list_bytes > 0) pixels = std::min(pixels, std::int64_t(gpu::info(device_).max_texel_buffer_elements / std::uint64_t(skipping_->segment_pass()->capacity)));
  const std::int64_t width = list_bytes > 0 ? round_up(scene.width) : scene.width;
  const std::int64_t rows = std::max<std::int64_t>(kTile, pixels / width / kTile * kTile);
  Band band;
  band.rows = int(std::min<std::int64_t>(rows, scene.height));
  const std::uint64_t bytes = std::uint64_t(band.rows) * scene.width * kPixelBytes;
  band.color = gpu::create_buffer(device_, bytes, gpu::BufferUse::storage, "color");
  band.hit = gpu::create_buffer(device_, bytes, gpu::BufferUse::storage, "hit");
  if (cost) band.cost = gpu::create_buffer(device_, bytes, gpu::BufferUse::storage, "cost");
  if (bricks_) band.parked = gpu::create_buffer(device_, bytes / kPixelBytes * kParkedBytes, gpu::BufferUse::storage, "parked");
  band.rays = gpu::create_buffer(device_, bytes / kPixelBytes * ray_bytes + kRayCountBytes, gpu::BufferUse::storage, "rays");
  if (list_bytes > 0) {
    const VkFormat format = config_.precision == Precision::float64 ? VK_FORMAT_R32G32B32A32_UINT : VK_FORMAT_R32G32_UINT;
    band.segments = gpu::create_buffer(device_, std::uint64_t(width * round_up(band.rows)) * list_bytes, gpu::BufferUse::texel, "ray segments", format);
    band.segment_counts = gpu::create_buffer(device_, sizeof(SegmentCounts), gpu::BufferUse::storage, "segment counts");
  }
  return band;
}

gpu::Resources DeviceRenderer::resources(const gpu::Pipeline& pipeline, const Band& band) const {
  gpu::Resources all = skipping_->resources();
  all.insert(all.end(), {{"uniforms", parameters_}, {"Isosurfaces", isosurfaces_}, {"transferTable", transfer_table_},
                         {"Color", band.color}, {"Hit", band.hit}, {"Cost", band.cost}, {"Rays", band.rays}, {"voids", void_buffer_},
                         {"RaySegments", band.segments}, {"raySegments", band.segments}, {"SegmentCounts", band.segment_counts}});
  if (bricks_) all.emplace_back("Parked", band.parked);
  const gpu::Resources coefficients = bricks_ ? bricks_->resources() : texels_.resources();
  all.insert(all.end(), coefficients.begin(), coefficients.end());
  // What the variant leaves out is not bound.
  std::erase_if(all, [&](const auto& resource) {
    return std::none_of(pipeline.reflection.bindings.begin(), pipeline.reflection.bindings.end(),
                        [&](const gpu::Binding& b) { return b.name == resource.first; });
  });
  return all;
}

TraceParameters DeviceRenderer::make_parameters(const Scene& scene) {
  TraceParameters p = trace_parameters(scene, *coefficients_);
  skipping_->set_parameters(p);
  if (bricks_) bricks_->set_parameters(p);
  if (voids_ && voids_->count > 0) p.bricks = ivec4(glm::ivec3(voids_->bricks), 0);
  p.bricks.w = int(rays_per_lane());
  parameters_ = gpu::create_buffer(device_, sizeof p, gpu::BufferUse::uniform, "parameters");
  return p;
}

void DeviceRenderer::finish_compiling(const Kernels& kernels, const Scene& scene, const Band& band) {
  TraceParameters p = make_parameters(scene);
  p.picture = ivec4(scene.width, scene.height, 0, 0);
  gpu::upload(device_, parameters_, std::as_bytes(std::span(&p, 1)));
  for (const KernelPass& pass : kernels) gpu::dispatch(device_, pass.pipeline, resources(pass.pipeline, band), {}, 1);
}

std::uint32_t DeviceRenderer::rays_per_lane() const {
  // A CPU has few lanes, and all of them are as slow as the slowest; a GPU wants many groups.
  return gpu::info(device_).type == "CPU" ? kRaysPerLane : 1;
}

DeviceRenderer::Traced DeviceRenderer::list_segments(const KernelPass& pass, const Band& band, std::uint32_t groups_x, std::uint32_t groups_y) {
  SegmentCounts counts;
  gpu::upload(device_, band.segment_counts, std::as_bytes(std::span(&counts, 1)));
  const double ms = gpu::dispatch(device_, pass.pipeline, resources(pass.pipeline, band), {}, groups_x, groups_y);
  gpu::download(device_, band.segment_counts, std::as_writable_bytes(std::span(&counts, 1)));
  return {.ms = ms, .segments_ms = ms, .steps = counts.steps, .listed = counts.listed, .full = counts.full};
}

DeviceRenderer::Traced DeviceRenderer::trace_band(const Kernels& kernels, const Band& band, const Scene& scene, int rows, const Progress& progress) {
  std::uint32_t rays = 0;
  gpu::upload(device_, band.rays, std::as_bytes(std::span(&rays, 1)));
  const std::uint32_t groups_x = std::uint32_t(round_up(scene.width) / kTile), groups_y = std::uint32_t(round_up(rows) / kTile);
  Traced traced;
  for (const KernelPass& pass : kernels) {
    if (pass.pass == Pass::segments) {
      traced += list_segments(pass, band, groups_x, groups_y);
      continue;
    }
    if (pass.pass == Pass::enter) {
      traced.ms += gpu::dispatch(device_, pass.pipeline, resources(pass.pipeline, band), {}, groups_x, groups_y);
      gpu::download(device_, band.rays, std::as_writable_bytes(std::span(&rays, 1)));
      continue;
    }
    const std::uint32_t group = kTraceGroup * (pass.pass == Pass::seek ? rays_per_lane() : 1);
    // Until no ray waits for a brick.
    const bool waits = bricks_ && pass.pass != Pass::traverse;
    do {
      if (waits) bricks_->clear_requests();
      traced.ms += gpu::dispatch(device_, pass.pipeline, resources(pass.pipeline, band), {}, (rays + group - 1) / group);
    } while (waits && bricks_->serve(lattice_eye(scene), progress));
  }
  return traced;
}

DeviceRenderer::Traced DeviceRenderer::trace(const Kernels& kernels, const Scene& scene, Band& band, Frame* frame, const Progress& progress) {
  TraceParameters p = make_parameters(scene);
  Traced traced;
  for (int row = 0; row < scene.height; row += band.rows) {
    const int rows = std::min(band.rows, scene.height - row);
    p.picture = ivec4(scene.width, scene.height, row, rows);
    gpu::upload(device_, parameters_, std::as_bytes(std::span(&p, 1)));
    traced += trace_band(kernels, band, scene, rows, [&](double) { report(progress, double(row) / scene.height); });
    if (frame) read_band(band, row, rows, *frame);
    report(progress, double(row + rows) / scene.height);
  }
  return traced;
}

void DeviceRenderer::read_band(const Band& band, int row, int rows, Frame& frame) {
  const std::size_t first = std::size_t(row) * frame.width, count = std::size_t(rows) * frame.width;
  gpu::download(device_, band.color, std::as_writable_bytes(std::span(frame.color).subspan(4 * first, 4 * count)));
  std::vector<glm::vec4> pixels(count);
  gpu::download(device_, band.hit, std::as_writable_bytes(std::span(pixels)));
  for (std::size_t i = 0; i < count; ++i) {
    for (int a = 0; a < 3; ++a) frame.normal[3 * (first + i) + a] = pixels[i][a];
    frame.depth[first + i] = pixels[i].w;
  }
  if (frame.cost.empty()) return;
  gpu::download(device_, band.cost, std::as_writable_bytes(std::span(pixels)));
  for (std::size_t i = 0; i < count; ++i)
    for (int a = 0; a < 3; ++a) frame.cost[3 * (first + i) + a] = pixels[i][a];
}

void DeviceRenderer::count_costs(Request request, RenderStats& stats, const Progress& progress) {
  request.scene.cost = true;
  RenderStats unused;
  const Kernels& counting = kernels_->kernels(variant(request), unused.compile_ms);
  Band band = make_band(request.scene, true);
  Frame frame = empty_frame(request.scene);
  trace(counting, request.scene, band, &frame, progress);
  const CostSums sums = cost_sums(frame);
  stats.evaluations = sums.evaluations;
  stats.steps = sums.steps;
  stats.intervals = sums.intervals;
}

Frame DeviceRenderer::empty_frame(const Scene& scene) {
  const std::size_t pixels = std::size_t(scene.width) * scene.height;
  Frame frame{scene.width, scene.height, {}, {}, {}, {}};
  frame.color.resize(4 * pixels);
  frame.depth.resize(pixels);
  frame.normal.resize(3 * pixels);
  if (scene.cost) frame.cost.resize(3 * pixels);
  return frame;
}

void DeviceRenderer::add_frame(const Traced& traced, RenderStats& stats) const {
  stats.trace_ms.push_back(traced.ms);
  const std::optional<SegmentPass> pass = skipping_->segment_pass();
  if (!pass) return;
  stats.segments.capacity = pass->capacity;
  stats.segments.ms.push_back(traced.segments_ms);
  stats.segments.steps = traced.steps;
  stats.segments.listed = traced.listed;
  stats.segments.full = traced.full;
}

void DeviceRenderer::describe(const Band& band, RenderStats& stats) const {
  stats.device = gpu::info(device_).name;
  stats.precision = config_.precision;
  stats.storage = format().name();
  stats.device_bytes.clear();
  if (bricks_) {
    bricks_->describe(stats);
  } else {
    stats.device_bytes.emplace_back("coefficients", texels_.bytes());
  }
  skipping_->describe(stats);
  stats.device_bytes.emplace_back("frame", band.color.bytes + band.hit.bytes + band.cost.bytes + band.rays.bytes + band.parked.bytes);
  if (band.segments.bytes > 0) stats.device_bytes.emplace_back("segments", band.segments.bytes + band.segment_counts.bytes);
  stats.void_cells = voids_ ? voids_->count : 0;
  if (void_buffer_.bytes > 0) stats.device_bytes.emplace_back("void cells", void_buffer_.bytes);
  if (transfer_table_.bytes > 0) stats.device_bytes.emplace_back("transfer table", transfer_table_.bytes);
  stats.device_bytes.emplace_back("parameters", parameters_.bytes + isosurfaces_.bytes);
}

glm::dvec3 DeviceRenderer::lattice_eye(const Scene& scene) const {
  const World& world = coefficients_->world;
  return glm::inverse(world.axes) * (scene.camera.eye - world.origin);
}

Frame DeviceRenderer::render(const Request& request, RenderStats& stats, const Progress& progress) {
  check_scene(request.scene);
  check_intersect(request.scene);
  check_bricks(request.scene);
  Request visible = request;
  visible.scene.isosurfaces = visible_surfaces(request.scene);
  if (visible.scene.isosurfaces.empty() && !visible.scene.volume) throw InputError("--opacity: every surface has opacity 0; expected one that can be seen");

  stats = RenderStats{};
  prepare_coefficients(stats, progress);
  const bool skips = request.skip.structure != "none";
  if (skips) {
    prepare_bounds(request, stats, progress);
  } else {
    check_samples(progress);
  }
  visible.skip = complete(visible, stats, progress).config;
  skipping_->prepare(visible.skip, skips ? &*bounds_ : nullptr, seen_numbers(visible.scene), lattice_eye(visible.scene), stats);
  upload_isosurfaces(visible.scene.isosurfaces);
  upload_transfer_table(visible.scene, stats);
  const Kernels& made = kernels_->kernels(variant(visible), stats.compile_ms);

  Band band = make_band(visible.scene, visible.scene.cost || visible.scene.stub_sampling);
  Frame frame = empty_frame(visible.scene);
  if (stats.compile_ms > 0.0) {
    const Stopwatch rest;
    finish_compiling(made, visible.scene, band);
    stats.compile_ms += rest.ms();
  }
  if (request.repeat > 1) trace(made, visible.scene, band, nullptr, {});  // warm-up
  for (int i = 0; i < request.repeat; ++i)
    add_frame(trace(made, visible.scene, band, i == 0 ? &frame : nullptr, i == 0 ? progress : Progress{}), stats);
  describe(band, stats);
  if (request.count_costs) count_costs(visible, stats, progress);
  stats.rays = std::uint64_t(frame.width) * frame.height;
  stats.hits = count_hits(frame);
  if (config_.validation && !gpu::validation_messages(device_).empty())
    throw std::runtime_error("validation: " + gpu::validation_messages(device_).front());
  return frame;
}

}  // namespace quincunx
