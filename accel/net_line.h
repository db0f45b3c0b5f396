// The Bernstein-Bezier net of the bcc7 spline along lines of the quarter grid parallel to x.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "spline/coefficients.h"

namespace quincunx {

/// The range of the net over the cells of one row: cell 2i + p of the row is number p * pitch + i, so that
/// neighbours in memory are alike and are computed together.
struct RowRange {
  std::int64_t pitch = 0;
  std::vector<float> min, max;
};

/// The net of a volume's bcc7 spline. Where the quarter-grid point (x,y,z)/4 lies relative to the samples repeats with
/// period 8 along each axis: x = 8i + a. All i of a residue a take the same taps from the rows of samples about the
/// line, which makes the inner loops run over contiguous samples; rows whose weights agree are added first.
class NetLines {
 public:
  /// What the inner loops may use: all that the processor has, or what every one has. The results are the same.
  enum class Instructions { best, portable };

  /// Keeps a reference to `c`: bcc, apron >= 1.
  explicit NetLines(const Coefficients<float>& c, Instructions instructions = Instructions::best);

  /// Room for one thread's intermediate rows.
  struct Workspace {
    std::vector<float> samples, net;
  };
  Workspace workspace() const;

  /// An empty range (min > max) for a row of cells.
  RowRange empty_range() const;

  /// Widens the ranges of `count` rows of cells by the net on the line (y,z), quarter units, 0 <= y <= 4 domain_max.y,
  /// likewise z: each cell by the points of its closed edge, x = 4X .. 4X+4.
  /// Each net value is within 32 * 2^-24 of the largest |coefficient| that it is a mean of (at most 22 taps).
  void widen(std::int64_t y, std::int64_t z, Workspace& work, RowRange* const* rows, int count) const;

  /// weight * Workspace::samples[offset + i], a term of net value 8i + a.
  struct Tap {
    std::int32_t offset;
    float weight;
  };

 private:
  /// What lines of one residue of (y,z) modulo 8 are made of.
  struct Recipe {
    std::vector<std::int64_t> rows;  ///< relative to the sample (0; 0, y/8, z/8)
    std::vector<int> group_end{0};   ///< group g sums rows [group_end[g], group_end[g+1])
    std::vector<Tap> taps;           ///< by residue of x
    int tap_end[9] = {};             ///< residue a takes taps [tap_end[a], tap_end[a+1])
  };
  Recipe make_recipe(int y, int z) const;

  const Coefficients<float>& c_;
  Instructions instructions_;
  std::int64_t pitch_, sample_pitch_;
  std::vector<Recipe> recipes_;  ///< number 8 * (z mod 8) + y mod 8
};

}  // namespace quincunx
