#include "accel/classification.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <functional>

#include "accel/range_query.h"

namespace quincunx {

Classification classify(const BlockBounds& bounds, const ValueScale& scale, std::span<const ValueRange> ranges, RangeQueryKind query) {
  const Thresholds thresholds(scale, ranges);
  Classification c;
  c.block = bounds.block;
  c.blocks = bounds.blocks;
  c.level.resize(bounds.min.size());
  using Blocks = tbb::blocked_range<std::size_t>;
  c.active_blocks = with_range_test(query, thresholds, [&](const auto& touches) {
    return tbb::parallel_reduce(
        Blocks(0, c.level.size(), 1 << 14), std::size_t(0),
        [&](const Blocks& range, std::size_t active) {
          for (std::size_t n = range.begin(); n != range.end(); ++n) {
            const bool is_active = touches(bounds.min[n], bounds.max[n]);
            c.level[n] = is_active ? Classification::active : thresholds.below(bounds.min[n]);
            active += is_active;
          }
          return active;
        },
        std::plus<>());
  });
  return c;
}

}  // namespace quincunx
