#include "render/device_skipping.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "lattice/error.h"
#include "lattice/stopwatch.h"

namespace quincunx {
namespace {

VkFormat vulkan_format(TexelFormat format) {
  switch (format) {
    case TexelFormat::r8: return VK_FORMAT_R8_UINT;
    case TexelFormat::rg16: return VK_FORMAT_R16G16_UINT;
    case TexelFormat::rg32: return VK_FORMAT_R32G32_UINT;
    case TexelFormat::rgba32: return VK_FORMAT_R32G32B32A32_UINT;
  }
  return VK_FORMAT_UNDEFINED;
}

gpu::Buffer upload_texels(gpu::Device& device, std::span<const std::byte> bytes, const std::string& name, VkFormat format) {
  gpu::Buffer buffer = gpu::create_buffer(device, bytes.size(), gpu::BufferUse::texel, name, format);
  gpu::upload(device, buffer, bytes);
  return buffer;
}

/// Whether the same blocks are active in both: levels of the others are nothing to the kernels.
bool same_blocks(const std::optional<Classification>& a, const Classification& b) {
  const auto alike = [](std::uint8_t x, std::uint8_t y) { return (x == Classification::active) == (y == Classification::active); };
  return a && a->block == b.block && std::ranges::equal(a->level, b.level, alike);
}

void check_config(const SkipConfig& config) {
  if (config.block < 1 || config.block > 256 || !std::has_single_bit(unsigned(config.block)))
    throw InputError(fmt::format("--block: found {}, expected a power of two from 1 to 256", config.block));
  if (config.max_cluster < 1 || config.max_cluster > 256)
    throw InputError(fmt::format("--max-cluster: found {}, expected 1 to 256", config.max_cluster));
}

}  // namespace

bool DeviceSkipping::same_kind(const SkipConfig& config) const {
  SkipConfig same = config;
  same.cell_test = config_.cell_test;
  return structure_ && same == config_;
}

void DeviceSkipping::prepare_structure(const SkipConfig& config, const CellBounds* cells, std::span<const double> isovalues,
                                       RenderStats& stats) {
  const bool same = same_kind(config);
  if (same && std::ranges::equal(isovalues, isovalues_)) return;
  if (!same) {
    structure_ = make_structure(config);
    buffers_.clear();
    classification_.reset();
  }
  isovalues_.assign(isovalues.begin(), isovalues.end());
  if (structure_->needs() == Needs::nothing) return;

  if (!blocks_ || blocks_->block != config.block) {
    const Stopwatch watch;
    blocks_ = block_bounds(*cells, config.block);
    stats.bounds_ms += watch.ms();
  }
  if (!same) {
    structure_->prepare(*blocks_);
    stats.bounds_ms += structure_->report().build_ms;
  }
  const Stopwatch watch;
  const Thresholds thresholds(*cells, isovalues);
  Classification classified;
  if (structure_->needs() == Needs::classification) classified = classify(*blocks_, *cells, isovalues);
  stats.classify_ms += watch.ms();
  if (structure_->needs() == Needs::classification && same_blocks(classification_, classified)) return;
  const Stopwatch building;
  structure_->build(classified, thresholds);
  stats.cluster_ms += structure_->report().cluster_ms;
  stats.build_ms += building.ms() - structure_->report().cluster_ms;
  if (structure_->needs() == Needs::classification) classification_ = std::move(classified);
}

void DeviceSkipping::classify_cells(const CellBounds& cells, std::span<const double> isovalues, RenderStats& stats) {
  if (occupancy_ && std::ranges::equal(isovalues, cell_isovalues_)) return;
  const Stopwatch watch;
  occupancy_ = occupancy(cells, isovalues);
  cell_isovalues_.assign(isovalues.begin(), isovalues.end());
  occupancy_uploaded_ = false;
  stats.classify_ms += watch.ms();
}

bool DeviceSkipping::upload(RenderStats& stats) {
  const Stopwatch watch;
  bool any = false;
  for (const StructureBuffer& wanted : structure_->buffers()) {
    const auto old = std::find_if(buffers_.begin(), buffers_.end(), [&](const Uploaded& u) { return u.name == wanted.name; });
    if (old != buffers_.end() && old->version == wanted.version) continue;
    if (old != buffers_.end()) buffers_.erase(old);
    any = true;
    buffers_.push_back({wanted.name, wanted.version, upload_texels(device_, wanted.bytes, wanted.name, vulkan_format(wanted.format))});
  }
  if (config_.cell_test && occupancy_ && !occupancy_uploaded_) {
    occupancy_buffer_ = upload_texels(device_, std::as_bytes(std::span(occupancy_->words)), "occupancy", VK_FORMAT_R32G32_UINT);
    occupancy_uploaded_ = any = true;
  }
  if (any) stats.upload_ms += watch.ms();
  return any;
}

gpu::Resources DeviceSkipping::resources() const {
  gpu::Resources all;
  for (const Uploaded& u : buffers_) all.emplace_back(u.name, u.buffer);
  if (config_.cell_test) all.emplace_back("occupancy", occupancy_buffer_);
  return all;
}

void DeviceSkipping::set_parameters(TraceParameters& parameters) const {
  if (blocks_) parameters.blocks = ivec4(glm::ivec3(blocks_->blocks), std::countr_zero(unsigned(blocks_->block)));
  if (occupancy_) parameters.bricks = ivec4(glm::ivec3(occupancy_->bricks), 0);
  parameters.structure = structure_->parameters();
}

void DeviceSkipping::describe(const CellBounds* cells, std::span<const double> isovalues, RenderStats& stats) const {
  stats.skip = config_;
  std::uint64_t bytes = 0;
  for (const Uploaded& u : buffers_) bytes += u.buffer.bytes;
  stats.device_bytes.emplace_back("structure", bytes);
  stats.device_bytes.emplace_back("occupancy", config_.cell_test ? occupancy_buffer_.bytes : 0);
  if (config_.cell_test && occupancy_) stats.active_cells = occupancy_->active_cells;
  if (structure_->needs() == Needs::nothing) return;
  stats.blocks = blocks_->min.size();
  stats.block_extents = blocks_->blocks;
  // A structure that decides in the kernel has no classification: it is made here for the count.
  stats.active_blocks = (classification_ ? *classification_ : classify(*blocks_, *cells, isovalues)).active_blocks;
  const StructureReport report = structure_->report();
  stats.leaves = structure_->needs() == Needs::bounds ? stats.active_blocks : report.leaves;
  stats.nodes = report.nodes;
  stats.depth = report.depth;
}

void DeviceSkipping::prepare(const SkipConfig& config, const CellBounds* cells, std::span<const double> isovalues,
                             const glm::dvec3& eye, RenderStats& stats) {
  if (config.structure != "none") check_config(config);
  prepare_structure(config, cells, isovalues, stats);
  config_ = config;
  if (structure_->needs() == Needs::nothing) config_.cell_test = false;
  if (config_.cell_test) classify_cells(*cells, isovalues, stats);
  const Stopwatch arranging;
  structure_->arrange(eye);
  const double arrange_ms = arranging.ms();
  if (upload(stats)) stats.build_ms += arrange_ms;
}

}  // namespace quincunx
