// How far the coefficients of bricks are off once each brick is stored in a unit of its own.
#pragma once

#include <mutex>
#include <vector>

#include "accel/bricks.h"

namespace quincunx {

/// The errors follow from the range of each slot's coefficients (storage_error), which parts of the volume tell one after another, in any order.
class BrickErrors {
 public:
  /// Of bricks of this layout, in its storage.
  explicit BrickErrors(const BrickLayout& layout);

  /// Takes note of the coefficients with index `first` and more, as many as `part` has with its apron. Called by several threads.
  void add(const Coefficients<float>& part, const glm::i64vec3& first);
  /// Once all coefficients of all slots were added: of each brick, by number, the largest error of it and its 26 neighbours. What two bricks decode of a
  /// point of their common face differs by that of both, so whoever bounds the values of cells at a face needs that of the neighbour too.
  std::vector<double> errors() const;

 private:
  BrickLayout layout_;
  std::vector<NumberRange> ranges_;  ///< by brick
  std::mutex mutex_;
};

}  // namespace quincunx
