// What is known of a volume's values: bounds of its cells, and of blocks of every size that was asked for.
#pragma once

#include <map>
#include <optional>

#include "accel/bounds.h"
#include "accel/classification.h"

namespace quincunx {

class VolumeBounds {
 public:
  /// Of every cell.
  explicit VolumeBounds(CellBounds cells);
  /// Of blocks alone, on `scale`: for volumes too large for bounds of every cell.
  VolumeBounds(const ValueScale& scale, BlockBounds finest);

  const ValueScale& scale() const { return scale_; }
  /// Null where only blocks are known.
  const CellBounds* cells() const { return cells_ ? &*cells_ : nullptr; }
  /// The least edge of a block whose bounds can be told: 1 where cells are known.
  int finest() const { return finest_; }
  /// The bounds of blocks of that edge in cells, made at the first call for it: adds the milliseconds that took to `made_ms`. Throws InputError naming --block where `block` is no power
  /// of two from finest() to 256.
  const BlockBounds& blocks(int block, double& made_ms);

 private:
  ValueScale scale_;
  std::optional<CellBounds> cells_;
  int finest_ = 1;
  std::map<int, BlockBounds> blocks_;
};

}  // namespace quincunx
