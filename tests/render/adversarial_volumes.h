// Volumes that a careless bound or walk gets wrong.
#pragma once

#include <string>
#include <vector>

#include "tests/render/volumes.h"

namespace quincunx {

struct AdversarialVolume {
  std::string name;
  Volume volume;
  double isovalue;
};

/// Twenty of them; seeds are fixed.
inline std::vector<AdversarialVolume> adversarial_volumes() {
  using Vec = glm::dvec3;
  const auto parity = [](const Vec& u) { return int(u.x + u.y + u.z) / 2 & 1 ? 1.0 : 0.0; };
  const auto spike = [](const Vec& u) { return u == Vec(8, 10, 6) ? 1e6 : 1.0; };
  const auto sheet = [](const Vec& u) { return std::exp(-0.5 * std::pow(u.x + u.y - u.z - 10.0, 2.0)); };
  const auto ramp = [](const Vec& u) { return u.x - 8.0; };  // a knot plane is the surface
  const auto step = [](const Vec& u) { return u.z < 9.0 ? 0.0 : 1.0; };
  const auto corners = [](const Vec& u) {  // one voxel in each corner of 15 x 15 x 15 cells
    const auto end = [](double x) { return x <= 1.0 || x >= 14.0; };
    return end(u.x) && end(u.y) && end(u.z) ? 1.0 : 0.0;
  };
  const auto shell = [](const Vec& u) { return std::abs(glm::length(u - Vec(10.5)) - 8.0) < 0.8 ? 1.0 : 0.0; };
  const auto strand = [](const Vec& u) { return std::hypot(u.x - 12.0 - 6.0 * std::sin(0.3 * u.z), u.y - 12.0) < 1.5 ? 1.0 : 0.0; };
  const auto blobs = [](const Vec& u) { return std::sin(0.7 * u.x) * std::sin(0.6 * u.y) * std::sin(0.5 * u.z); };
  const World skewed{.origin = {3.0, -7.0, 11.0}, .axes = glm::dmat3(1.0, 0.2, 0.0, -0.3, 0.8, 0.1, 0.0, 0.4, -1.3)};

  std::vector<AdversarialVolume> all;
  all.push_back({"noise", random_volume({11, 9, 13}, 3), 0.5});
  all.push_back({"noise, rarely above", random_volume({12, 10, 9}, 5), 0.97});
  all.push_back({"checkerboard", bcc_volume({8, 8, 8}, parity), 0.5});
  all.push_back({"single voxel", bcc_volume({9, 9, 9}, spike), 2.0});
  all.push_back({"single voxel, seen near its top", bcc_volume({9, 9, 9}, spike), 3.7e5});
  all.push_back({"thin diagonal sheet", bcc_volume({10, 10, 10}, sheet), 0.6});
  all.push_back({"ramp through lattice points", bcc_volume({9, 9, 9}, ramp), 0.0});
  all.push_back({"step", bcc_volume({9, 9, 9}, step), 0.5});
  all.push_back({"full, empty of surfaces", bcc_volume({5, 5, 5}, [](const Vec&) { return 1.0; }), 0.5});
  all.push_back({"constant at the isovalue", bcc_volume({5, 5, 5}, [](const Vec&) { return 0.5; }), 0.5});
  all.push_back({"empty", bcc_volume({5, 5, 5}, [](const Vec&) { return 0.0; }), 0.5});
  all.push_back({"one voxel in each corner", bcc_volume({8, 8, 8}, corners), 0.4});
  all.push_back({"thin shell", bcc_volume({11, 11, 11}, shell), 0.5});
  all.push_back({"strand", bcc_volume({12, 12, 20}, strand), 0.5});
  all.push_back({"blobs", bcc_volume({14, 13, 12}, blobs), 0.3});
  all.push_back({"blobs in a skewed, left-handed world", bcc_volume({9, 10, 11}, blobs, skewed), 0.2});
  all.push_back({"one by one by many", random_volume({1, 1, 40}, 4), 0.5});
  all.push_back({"many by one by two", random_volume({37, 1, 2}, 8), 0.6});
  all.push_back({"one sample a coset", random_volume({1, 1, 1}, 6), 0.5});
  all.push_back({"two of each, all prime sizes", random_volume({2, 3, 5}, 7), 0.45});
  return all;
}

}  // namespace quincunx
