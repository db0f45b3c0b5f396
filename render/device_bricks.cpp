#include "render/device_bricks.h"

#include <algorithm>
#include <bit>

#include "lattice/stopwatch.h"

namespace quincunx {

DeviceBricks::DeviceBricks(gpu::Device& device, const BrickLayout& layout, std::shared_ptr<const BrickSource> source, std::uint64_t pool_bytes,
                           std::uint64_t texel_elements)
    : device_(device), pool_(layout, std::move(source), pool_bytes),
      texels_(device, std::uint64_t(pool_.floats()), texel_elements, "brick pool", {.precision = Precision::float32, .storage = layout.storage}),
      requested_(std::size_t(layout.count())) {
  page_table_ = gpu::create_filled(device_, std::as_bytes(pool_.page_table()), gpu::BufferUse::texel, "page table", VK_FORMAT_R32_SINT);
  requests_ = gpu::create_buffer(device_, requested_.size() * sizeof(std::uint32_t), gpu::BufferUse::storage, "requests");
  if (!packed()) return;
  units_.resize(requested_.size(), glm::vec2(0.0f));
  packed_.resize(layout.slot_bytes());
  unit_buffer_ = gpu::create_filled(device_, std::as_bytes(std::span(units_)), gpu::BufferUse::texel, "units of bricks", VK_FORMAT_R32G32_SFLOAT);
}

void DeviceBricks::upload_slot(std::int32_t brick, std::int64_t first, std::span<const float> slot) {
  if (!packed()) return texels_.upload(device_, first, std::as_bytes(slot));
  const NumberRange range = range_of(slot);
  const ValueUnit unit = storage_unit(texels_.format().storage, range.low, range.high);
  pack(texels_.format().storage, unit, slot, packed_);
  units_[std::size_t(brick)] = {float(unit.offset), float(unit.scale)};
  texels_.upload(device_, first, packed_);
}

void DeviceBricks::upload_entries(std::size_t first, std::size_t count) {
  gpu::upload(device_, page_table_, std::as_bytes(pool_.page_table().subspan(first, count)), first * sizeof(std::int32_t));
  if (packed()) gpu::upload(device_, unit_buffer_, std::as_bytes(std::span(units_).subspan(first, count)), first * sizeof(glm::vec2));
}

gpu::Resources DeviceBricks::resources() const {
  gpu::Resources all = texels_.resources();
  all.insert(all.end(), {{"pageTable", page_table_}, {"Requests", requests_}, {"brickUnits", unit_buffer_}});
  return all;
}

void DeviceBricks::set_parameters(TraceParameters& parameters) const {
  const BrickLayout& layout = pool_.layout();
  parameters.strides = ivec4(layout.strides(), 0);
  parameters.pages = ivec4(layout.bricks, std::countr_zero(unsigned(layout.edge)));
}

void DeviceBricks::clear_requests() {
  std::fill(requested_.begin(), requested_.end(), 0u);
  gpu::upload(device_, requests_, std::as_bytes(std::span(requested_)));
}

bool DeviceBricks::serve(const glm::dvec3& eye, const Progress& progress) {
  gpu::download(device_, requests_, std::as_writable_bytes(std::span(requested_)));
  std::vector<std::int32_t> wanted;
  for (std::size_t n = 0; n < requested_.size(); ++n)
    if (requested_[n] != 0) wanted.push_back(std::int32_t(n));
  if (wanted.empty()) return false;
  ++rounds_;
  const Stopwatch watch;
  sort_front_to_back(pool_.layout(), eye, wanted);
  const auto upload = [this](std::int32_t brick, std::int64_t first, std::span<const float> slot) { upload_slot(brick, first, slot); };
  std::vector<std::int32_t> changed;
  try {
    changed = pool_.make_resident(wanted, upload, progress);
  } catch (...) {
    // What was evicted and loaded before counts: the whole table goes to the device.
    upload_entries(0, requested_.size());
    throw;
  }
  if (!changed.empty()) upload_entries(std::size_t(changed.front()), std::size_t(changed.back() - changed.front()) + 1);
  load_ms_ += watch.ms();
  return true;
}

void DeviceBricks::describe(RenderStats& stats) const {
  const BrickPool::Counters& counters = pool_.counters();
  stats.bricks = {.edge = pool_.layout().edge, .count = std::uint64_t(pool_.layout().count()), .slots = std::uint64_t(pool_.slots()),
                  .resident = std::uint64_t(counters.resident), .loads = counters.loads, .evictions = counters.evictions,
                  .loaded_bytes = counters.bytes, .rounds = rounds_, .load_ms = load_ms_};
  stats.device_bytes.emplace_back("brick pool", texels_.bytes());
  stats.device_bytes.emplace_back("page table", page_table_.bytes + requests_.bytes + unit_buffer_.bytes);
}

}  // namespace quincunx
