// The kernels' root finder on polynomials along a line whose roots are known.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lattice/progress.h"

namespace quincunx {

struct RootsPlan {
  std::vector<int> degrees;         ///< of splines along a ray
  std::string device;
  std::uint64_t count = 1000000;    ///< polynomials of each kind and degree
  std::uint32_t seed = 1;
};

/// Polynomials of one degree and kind.
struct RootsLine {
  int degree = 0;
  std::string kind;
  std::uint64_t count = 0;
  std::uint64_t missed = 0;      ///< no root, or one behind a certain one
  std::uint64_t wrong = 0;       ///< a root where the value is not 0 within rounding
  std::uint64_t undecided = 0;   ///< no certain root, and none found, though the polynomial in double has one; or the other way round
  double residual = 0.0;         ///< the largest |p| at a root found, in parts of what is allowed (docs/stability.md)
  double off = 0.0;              ///< the largest distance, in [0,1], from the first root in double, where that is simple and certain
  bool passed() const { return missed == 0 && wrong == 0 && residual <= 1.0; }
};

/// Kinds: roots spread over a line (some of them in the piece); pairs and triples of roots 1e-6 to 0.1 apart; all of them in one cluster.
/// Every polynomial is the product of its linear factors, rounded to floats once: the rounded one is what is asked for and judged.
std::vector<RootsLine> measure_roots(const RootsPlan& plan, std::string& device, const Progress& progress = {});

}  // namespace quincunx
