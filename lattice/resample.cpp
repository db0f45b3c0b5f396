#include "lattice/resample.h"

#include <fmt/format.h>

#include <type_traits>

#include "lattice/error.h"

namespace quincunx {
namespace {

/// Appends to `to` every second sample per axis of the grid `from` of `size`, beginning at (first, first, first):
/// `extents` of them.
template <class T>
void append_every_second(const std::vector<T>& from, const Extents& size, int first, const Extents& extents,
                         std::vector<T>& to) {
  for (std::int64_t k = 0; k < extents.z; ++k) {
    for (std::int64_t j = 0; j < extents.y; ++j) {
      const T* row = from.data() + ((2 * k + first) * size.y + 2 * j + first) * size.x + first;
      for (std::int64_t i = 0; i < extents.x; ++i) to.push_back(row[2 * i]);
    }
  }
}

}  // namespace

Volume bcc_subset(const Volume& cartesian, std::string_view what) {
  if (cartesian.lattice != LatticeKind::cartesian) {
    throw InputError(
        fmt::format("{}: lattice {}, expected cartesian to take a BCC subset of", what, lattice_name(cartesian.lattice)));
  }
  check_volume(cartesian, what);
  const Extents& size = cartesian.extents;
  if (size.x < 2 || size.y < 2 || size.z < 2) {
    throw InputError(
        fmt::format("{}: {} x {} x {} samples, expected at least 2 on every axis to take a BCC subset of", what,
                    size.x, size.y, size.z));
  }

  // A BCC point u stands at the Cartesian index u, so the world stays as it is.
  Volume bcc;
  bcc.lattice = LatticeKind::bcc;
  bcc.extents = size / std::int64_t(2);
  bcc.world = cartesian.world;
  bcc.notes = cartesian.notes;
  bcc.samples = std::visit(
      [&](const auto& from) -> Volume::Samples {
        std::remove_cvref_t<decltype(from)> to;
        to.reserve(bcc.sample_count());
        for (const int coset : {0, 1}) append_every_second(from, size, coset, bcc.extents, to);
        return to;
      },
      cartesian.samples);
  return bcc;
}

Volume cartesian_subset(const Volume& bcc) {
  if (bcc.lattice != LatticeKind::bcc) {
    throw InputError(
        fmt::format("volume: lattice {}, expected bcc to take the even coset of", lattice_name(bcc.lattice)));
  }
  check_volume(bcc, "volume");

  // Index (i,j,k) of the even coset stands at u = (2i,2j,2k): the voxel step is two lattice coordinates.
  Volume even;
  even.lattice = LatticeKind::cartesian;
  even.extents = bcc.extents;
  even.world = {bcc.world.origin, 2.0 * bcc.world.axes};
  even.notes = bcc.notes;
  even.samples = std::visit(
      [&](const auto& from) -> Volume::Samples {
        return std::remove_cvref_t<decltype(from)>(from.begin(), from.begin() + std::ptrdiff_t(even.sample_count()));
      },
      bcc.samples);
  return even;
}

}  // namespace quincunx
