// What fills the slots of a brick pool.
#pragma once

#include <span>

#include "accel/bricks.h"
#include "spline/box_coefficients.h"

namespace quincunx {

/// Gives the coefficients of any brick of one volume. May be asked by several threads at once.
class BrickSource {
 public:
  virtual ~BrickSource() = default;
  /// Writes the slot of `brick`, layout.slot_floats() numbers as BrickLayout says. Throws InputError where samples cannot be read.
  virtual void fill(const glm::ivec3& brick, std::span<float> slot) const = 0;
};

/// Bricks of coefficients in memory. Keeps a reference to them.
class CoefficientBricks final : public BrickSource {
 public:
  CoefficientBricks(const BrickLayout& layout, const Coefficients<float>& coefficients)
      : layout_(layout), coefficients_(coefficients) {}
  void fill(const glm::ivec3& brick, std::span<float> slot) const override;

 private:
  BrickLayout layout_;
  const Coefficients<float>& coefficients_;
};

/// Bricks whose samples are read and prefiltered each time, to the same coefficients in `unit`, bit for bit. Keeps references to `source` and
/// `spline`. The samples are supposed to be finite (sample_range tells).
class SampleBricks final : public BrickSource {
 public:
  SampleBricks(const BrickLayout& layout, const SampleSource& source, const Spline& spline, Spline::Prefilter prefilter, const ValueUnit& unit = {})
      : layout_(layout), source_(source), spline_(spline), prefilter_(prefilter), unit_(unit) {}
  void fill(const glm::ivec3& brick, std::span<float> slot) const override;

 private:
  BrickLayout layout_;
  const SampleSource& source_;
  const Spline& spline_;
  Spline::Prefilter prefilter_;
  ValueUnit unit_;
};

}  // namespace quincunx
