#include "spline/convolution.h"

#include <string>

#include "lattice/error.h"

namespace quincunx {

void check_samples(const Volume& volume, LatticeKind lattice, std::string_view spline) {
  const std::string who = "spline " + std::string(spline) + ": ";
  if (volume.lattice != lattice)
    throw InputError(who + "found a volume on the " + std::string(lattice_name(volume.lattice)) + " lattice, expected " +
                     std::string(lattice_name(lattice)));
  check_volume(volume, "spline " + std::string(spline));
  check_finite(sample_range(volume), volume, "spline " + std::string(spline));
}

void refuse_overflow(std::string_view spline, std::string_view type) {
  throw InputError("spline " + std::string(spline) + ": found samples so large that coefficients overflow " +
                   std::string(type) + "; expected smaller ones");
}

}  // namespace quincunx
