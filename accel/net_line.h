// The Bernstein-Bezier net of a box spline of the BCC lattice along lines of its grid parallel to x.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "spline/box_net.h"
#include "spline/coefficients.h"

namespace quincunx {

/// The range of the net over the cells of one row: cell 2i + p of the row is number p * pitch + i, so that
/// neighbours in memory are alike and are computed together.
struct RowRange {
  std::int64_t pitch = 0;
  std::vector<float> min, max;
};

/// The net of a volume's spline of degree n. Where the grid point (x,y,z)/n lies relative to the samples repeats with
/// period 2n along each axis: x = 2n i + a. All i of a residue a take the same taps from the rows of samples about the
/// line, which makes the inner loops run over contiguous samples; rows whose weights agree are added first.
class NetLines {
 public:
  /// What the inner loops may use: all that the processor has, or what every one has. The results are the same.
  enum class Instructions { best, portable };

  /// Keeps a reference to `c`: bcc, apron at least that of the spline with this net. The degree is one of 1, 4, 5.
  NetLines(const Coefficients<float>& c, const NetView& net, Instructions instructions = Instructions::best);

  /// Room for one thread's intermediate rows.
  struct Workspace {
    std::vector<float> samples, net;
  };
  Workspace workspace() const;

  /// An empty range (min > max) for a row of cells.
  RowRange empty_range() const;

  /// Widens the ranges of `count` rows of cells by the net on the line (y,z), n-ths, 0 <= y <= n domain_max.y,
  /// likewise z: each cell by the points of its closed edge, x = nX .. nX+n.
  /// Each net value is within 32 * 2^-24 of the largest |coefficient| that it is a mean of (at most 23 taps of sums of at most 4).
  void widen(std::int64_t y, std::int64_t z, Workspace& work, RowRange* const* rows, int count) const;

  /// weight * Workspace::samples[offset + i], a term of net value 2n i + a.
  struct Tap {
    std::int32_t offset;
    float weight;
  };

 private:
  /// What lines of one residue of (y,z) modulo 2n are made of.
  struct Recipe {
    std::vector<std::int64_t> rows;  ///< relative to the sample (0; 0, y/2n, z/2n)
    std::vector<int> group_end{0};   ///< group g sums rows [group_end[g], group_end[g+1])
    std::vector<Tap> taps;           ///< by residue of x
    std::vector<int> tap_end{0};     ///< residue a takes taps [tap_end[a], tap_end[a+1])
  };
  Recipe make_recipe(int y, int z) const;

  /// Places of samples of a coset along one axis, index units, whose net reaches residue r.
  std::vector<int> reaching(int coset, int r) const;

  const Coefficients<float>& c_;
  NetView net_;
  Instructions instructions_;
  int period_, before_ = 0;  ///< 2n; samples that a line takes before its first and after its last
  std::int64_t pitch_, sample_pitch_;
  std::vector<Recipe> recipes_;  ///< number 2n (z mod 2n) + y mod 2n
};

}  // namespace quincunx
