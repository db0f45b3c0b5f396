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

/// Whether the same blocks are active in both: levels of the others are nothing to the kernels.
bool same_blocks(const std::optional<Classification>& a, const Classification& b) {
  const auto alike = [](std::uint8_t x, std::uint8_t y) { return (x == Classification::active) == (y == Classification::active); };
  return a && a->block == b.block && std::ranges::equal(a->level, b.level, alike);
}

void check_config(const SkipConfig& config) {
  if (config.max_cluster < 1 || config.max_cluster > 256)
    throw InputError(fmt::format("--max-cluster: found {}, expected 1 to 256", config.max_cluster));
  if (!(config.least_leaf > 0.0 && config.least_leaf <= 1.0))
    throw InputError(fmt::format("--least-leaf: found {}, expected a number above 0, at most 1", config.least_leaf));
  if (config.max_segments < 1 || config.max_segments > 64)
    throw InputError(fmt::format("--max-segments: found {}, expected 1 to 64", config.max_segments));
}

}  // namespace

bool DeviceSkipping::same_kind(const SkipConfig& config) const {
  SkipConfig same = config;
  same.cell_test = config_.cell_test;
  return structure_ && same == config_;
}

void DeviceSkipping::set_ranges(std::span<const ValueRange> ranges, RangeQueryKind query) {
  if (std::ranges::equal(ranges, ranges_) && query == query_) return;
  ranges_.assign(ranges.begin(), ranges.end());
  query_ = query;
  classified_.clear();
  occupancy_.reset();
  built_for_ranges_ = false;
}

const Classification& DeviceSkipping::classified(VolumeBounds& bounds, int block, RenderStats& stats) {
  const auto known = classified_.find(block);
  if (known != classified_.end()) return known->second;
  const BlockBounds& blocks = bounds.blocks(block, stats.bounds_ms);
  const Stopwatch watch;
  const Classification& made = classified_.emplace(block, classify(blocks, bounds.scale(), ranges_, query_)).first->second;
  stats.classify_ms += watch.ms();
  return made;
}

SkipChoice DeviceSkipping::choose(const SkipConfig& wanted, VolumeBounds& bounds, std::span<const ValueRange> ranges, bool volume, RenderStats& stats) {
  set_ranges(ranges, wanted.range_query);
  const bool looks = wanted.structure == "auto";
  const int block = std::max(kChoiceBlock, bounds.finest());
  SkipChoice choice = choose_skip(wanted, looks ? classified(bounds, block, stats) : Classification{}, {.cpu = gpu::info(device_).type == "CPU", .volume = volume});
  choice.config.block = std::max(choice.config.block, wanted.block == 0 ? bounds.finest() : 1);
  return choice;
}

void DeviceSkipping::prepare_structure(const SkipConfig& config, VolumeBounds& bounds, RenderStats& stats) {
  const bool same = same_kind(config);
  if (same && built_for_ranges_) return;
  if (!same) {
    structure_ = make_structure(config);
    buffers_.clear();
    built_.reset();
    blocks_ = nullptr;
    if (structure_->needs() != Needs::nothing) {
      blocks_ = &bounds.blocks(config.block, stats.bounds_ms);
      structure_->prepare(*blocks_);
      stats.bounds_ms += structure_->report().build_ms;
    }
  }
  built_for_ranges_ = true;
  if (structure_->needs() == Needs::nothing) return;

  // Where the outcome is the same, nothing is built.
  const Classification& blocks = classified(bounds, config.block, stats);
  const bool by_blocks = structure_->needs() == Needs::classification;
  const Stopwatch building;
  const Thresholds thresholds(bounds.scale(), ranges_);
  if (by_blocks && same_blocks(built_, blocks)) return structure_->compare(thresholds);
  structure_->build(by_blocks ? blocks : Classification{}, thresholds);
  stats.cluster_ms += structure_->report().cluster_ms;
  stats.build_ms += building.ms() - structure_->report().cluster_ms;
  if (by_blocks) built_ = blocks;
}

void DeviceSkipping::classify_cells(const CellBounds& cells, RenderStats& stats) {
  if (occupancy_) return;
  const Stopwatch watch;
  occupancy_ = occupancy(cells, ranges_, query_);
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
    buffers_.push_back({wanted.name, wanted.version, gpu::create_filled(device_, wanted.bytes, gpu::BufferUse::texel, wanted.name, vulkan_format(wanted.format))});
  }
  if (config_.cell_test && occupancy_ && !occupancy_uploaded_) {
    occupancy_buffer_ = gpu::create_filled(device_, std::as_bytes(std::span(occupancy_->words)), gpu::BufferUse::texel, "occupancy",
                                           VK_FORMAT_R32G32_UINT);
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

void DeviceSkipping::describe(RenderStats& stats) const {
  stats.skip = config_;
  std::uint64_t bytes = 0;
  for (const Uploaded& u : buffers_) bytes += u.buffer.bytes;
  stats.device_bytes.emplace_back("structure", bytes);
  stats.device_bytes.emplace_back("occupancy", config_.cell_test ? occupancy_buffer_.bytes : 0);
  if (config_.cell_test && occupancy_) stats.active_cells = occupancy_->active_cells;
  if (!blocks_) return;
  stats.blocks = blocks_->min.size();
  stats.block_extents = blocks_->blocks;
  stats.active_blocks = classified_.at(config_.block).active_blocks;
  const StructureReport report = structure_->report();
  stats.leaves = structure_->needs() == Needs::bounds ? stats.active_blocks : report.leaves;
  stats.nodes = report.nodes;
  stats.one_child = report.one_child;
  stats.depth = report.depth;
}

void DeviceSkipping::prepare(const SkipConfig& config, VolumeBounds* bounds, std::span<const ValueRange> ranges, const glm::dvec3& eye,
                             RenderStats& stats) {
  if (config.structure != "none") check_config(config);
  set_ranges(ranges, config.range_query);
  if (bounds) {
    prepare_structure(config, *bounds, stats);
  } else if (!same_kind(config)) {
    structure_ = make_structure(config);
    buffers_.clear();
    blocks_ = nullptr;
  }
  config_ = config;
  if (structure_->needs() == Needs::nothing) config_.cell_test = false;
  if (config_.cell_test) classify_cells(*bounds->cells(), stats);
  const Stopwatch arranging;
  structure_->arrange(eye);
  const double arrange_ms = arranging.ms();
  if (upload(stats)) stats.build_ms += arrange_ms;
}

}  // namespace quincunx
