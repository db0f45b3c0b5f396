#include "lattice/sample_source.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <mutex>

#include "lattice/shared_progress.h"

namespace quincunx {
namespace {

constexpr std::int64_t kBoxSamples = 1 << 20;  // of each coset, about, that sample_range reads at a time

Volume without_samples(const Volume& volume) {
  Volume header{volume.lattice, volume.extents, volume.world, {}, volume.notes};
  std::visit([&](const auto& samples) { header.samples = std::decay_t<decltype(samples)>{}; }, volume.samples);
  return header;
}

/// The number in a volume of `extents` of sample `number` of the box at `low`.
std::size_t number_in_whole(std::size_t number, const glm::i64vec3& low, const Extents& box, const Extents& extents) {
  const auto n = std::int64_t(number);
  const std::int64_t coset = n / (box.x * box.y * box.z);
  const glm::i64vec3 i = low + glm::i64vec3(n % box.x, n / box.x % box.y, n / (box.x * box.y) % box.z);
  return std::size_t(((coset * extents.z + i.z) * extents.y + i.y) * extents.x + i.x);
}

/// The range of both parts, one of which may have no finite sample.
SampleRange joined(const SampleRange& a, std::size_t samples_a, const SampleRange& b, std::size_t samples_b) {
  const bool any_a = a.not_finite < samples_a, any_b = b.not_finite < samples_b;
  SampleRange range = any_a ? a : b;
  if (any_a && any_b) range.min = std::min(a.min, b.min), range.max = std::max(a.max, b.max);
  range.not_finite = a.not_finite + b.not_finite;
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  range.first_not_finite = std::min(a.not_finite > 0 ? a.first_not_finite : none, b.not_finite > 0 ? b.first_not_finite : none);
  if (range.not_finite == 0) range.first_not_finite = 0;
  return range;
}

}  // namespace

Volume empty_box(const Volume& header, const glm::i64vec3& low, const glm::i64vec3& high) {
  assert(glm::all(glm::greaterThanEqual(low, glm::i64vec3(0))) && glm::all(glm::lessThan(low, high)) &&
         glm::all(glm::lessThanEqual(high, header.extents)));
  Volume box;
  box.lattice = header.lattice;
  box.extents = high - low;
  box.world.axes = header.world.axes;
  box.world.origin = header.world.to_world(glm::dvec3(std::int64_t(lattice_step(header.lattice)) * low));
  const std::size_t count = box.sample_count();
  std::visit([&](const auto& samples) { box.samples = std::decay_t<decltype(samples)>(count); }, header.samples);
  return box;
}

VolumeSource::VolumeSource(const Volume& volume) : volume_(volume), header_(without_samples(volume)) {}

Volume VolumeSource::read_box(const glm::i64vec3& low, const glm::i64vec3& high) const {
  Volume box = empty_box(header_, low, high);
  std::visit(
      [&](auto& to) {
        const auto& from = std::get<std::decay_t<decltype(to)>>(volume_.samples);
        std::size_t row = 0;
        const Extents& n = volume_.extents;
        for (std::int64_t coset = 0; coset < coset_count(box.lattice); ++coset)
          for (std::int64_t k = low.z; k < high.z; ++k)
            for (std::int64_t j = low.y; j < high.y; ++j, row += std::size_t(box.extents.x))
              std::copy_n(from.data() + ((coset * n.z + k) * n.y + j) * n.x + low.x, box.extents.x, to.data() + row);
      },
      box.samples);
  return box;
}

SampleRange sample_range(const SampleSource& source, const Progress& progress) {
  const Extents& n = source.header().extents;
  const std::int64_t rows = std::clamp<std::int64_t>(kBoxSamples / n.x, 1, n.y);
  const std::int64_t planes = std::clamp<std::int64_t>(kBoxSamples / (n.x * rows), 1, n.z);
  const std::int64_t boxes_y = (n.y + rows - 1) / rows, boxes_z = (n.z + planes - 1) / planes;

  SampleRange total;
  std::size_t samples = 0;
  std::mutex mutex;
  SharedProgress shared(progress, boxes_y * boxes_z);
  tbb::parallel_for(std::int64_t(0), boxes_y * boxes_z, [&](std::int64_t box) {
    const glm::i64vec3 low(0, box % boxes_y * rows, box / boxes_y * planes);
    const glm::i64vec3 high(n.x, std::min(low.y + rows, n.y), std::min(low.z + planes, n.z));
    const Volume part = source.read_box(low, high);
    // Isolated: a thread that waits here must not begin another box, whose memory would come on top.
    SampleRange range = tbb::this_task_arena::isolate([&] { return sample_range(part); });
    if (range.not_finite > 0) range.first_not_finite = number_in_whole(range.first_not_finite, low, part.extents, n);
    {
      const std::lock_guard lock(mutex);
      total = joined(total, samples, range, part.sample_count());
      samples += part.sample_count();
    }
    shared.add(1);
  });
  report(progress, 1.0);
  return total;
}

}  // namespace quincunx
