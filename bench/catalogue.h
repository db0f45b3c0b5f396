// Volumes and views that arithmetic may get wrong: the catalogue of `quincunx stability`.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "lattice/not_finite.h"
#include "lattice/volume.h"
#include "render/camera.h"

namespace quincunx {

/// A field, how it is sampled, and from where its isosurface is looked at.
struct StabilityCase {
  std::string group, name;
  std::function<double(const glm::dvec3&)> field;  ///< of lattice coordinates
  double isovalue = 0.0;
  glm::i64vec3 cells{31};  ///< the domain is the box [0, cells] of lattice coordinates; odd, or 0 for one Cartesian sample
  World world;
  SampleType type = SampleType::float32;
  NanPolicy nan;  ///< refuse: samples are finite, or the case is that they are refused
  std::vector<Camera> cameras;  ///< world; none: two orbit views of the whole volume
  int size = 48;                ///< pixels each way

  /// The field's samples on either lattice: half as many an axis and coset on the BCC lattice. Rounded to `type`, to its nearest value.
  Volume sampled(LatticeKind lattice) const;
  /// `cameras`, or the orbit views.
  std::vector<Camera> views(LatticeKind lattice) const;
};

/// The groups, in the order of the catalogue.
const std::vector<std::string_view>& stability_groups();

/// The cases of a group. Throws InputError naming the choices.
std::vector<StabilityCase> stability_cases(std::string_view group);

}  // namespace quincunx
