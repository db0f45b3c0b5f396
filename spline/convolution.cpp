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
  const SampleRange range = sample_range(volume);
  if (range.not_finite == 0) return;
  const auto n = std::int64_t(range.first_not_finite);
  const Extents& e = volume.extents;
  const std::string coset =
      coset_count(lattice) == 1 ? "" : "coset " + std::to_string(n / (e.x * e.y * e.z)) + ", ";
  throw InputError(who + "found " + std::to_string(range.not_finite) + " NaN or infinite of " +
                   std::to_string(volume.sample_count()) + " samples, the first at " + coset + "index (" +
                   std::to_string(n % e.x) + ", " + std::to_string(n / e.x % e.y) + ", " +
                   std::to_string(n / (e.x * e.y) % e.z) + "); expected finite samples");
}

void refuse_overflow(std::string_view spline, std::string_view type) {
  throw InputError("spline " + std::string(spline) + ": found samples so large that coefficients overflow " +
                   std::string(type) + "; expected smaller ones");
}

}  // namespace quincunx
