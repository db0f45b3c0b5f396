#include "accel/hybrid.h"

#include "lattice/stopwatch.h"

namespace quincunx {

std::string_view Hybrid::shader() const { return config_.grid == HybridGrid::mm ? "skip_hybrid_mm.glsl" : "skip_hybrid_pc.glsl"; }

void Hybrid::prepare(const BlockBounds& blocks) {
  if (config_.grid == HybridGrid::pc) return;
  const Stopwatch watch;
  bounds_.resize(blocks.min.size());
  for (std::size_t n = 0; n < bounds_.size(); ++n) bounds_[n] = {blocks.min[n], blocks.max[n]};
  ++grid_version_;
  report_ = {.build_ms = prepare_ms_ = watch.ms()};
}

void Hybrid::build(const Classification& blocks, const Thresholds& thresholds) {
  const Stopwatch watch;
  list_.build(blocks, config_.least_share);
  ++list_version_;
  if (config_.grid == HybridGrid::pc) {
    level_ = blocks.level;
    ++grid_version_;
  }
  compare(thresholds);
  report_ = list_.report();
  report_.leaves = blocks.active_blocks;
  report_.build_ms = prepare_ms_ + watch.ms();
}

void Hybrid::compare(const Thresholds& thresholds) {
  if (config_.grid == HybridGrid::pc) return;
  windows_ = kernel_windows(thresholds);
  ++windows_version_;
}

void Hybrid::arrange(const glm::dvec3& eye) {
  if (list_.arrange(eye)) ++list_version_;
}

std::vector<StructureBuffer> Hybrid::buffers() const {
  const StructureBuffer boxes = buffer_of(list_.boxes(), list_version_);
  if (config_.grid == HybridGrid::pc) return {boxes, {"hybridLevel", TexelFormat::r8, std::as_bytes(std::span(level_)), grid_version_}};
  return {boxes,
          {"hybridBounds", TexelFormat::rg16, std::as_bytes(std::span(bounds_)), grid_version_},
          {"windows", TexelFormat::rg32, std::as_bytes(std::span(windows_)), windows_version_}};
}

glm::ivec4 Hybrid::parameters() const { return {int(list_.boxes().leaves), 0, int(windows_.size()), 0}; }

}  // namespace quincunx
