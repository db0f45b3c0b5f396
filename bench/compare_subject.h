// The volumes that `quincunx compare` compares on, and what they are samples of.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/continuum.h"
#include "lattice/field.h"
#include "lattice/volume.h"

namespace quincunx {

/// How many samples the BCC volume has beside a Cartesian one.
///   equal   as many: a spacing of h / 4^(1/3), h the Cartesian one
///   sparse  1/sqrt(2) as many, 29.3 % fewer, which hold the same spherical band limit: a spacing of h / sqrt(2)
enum class Density { equal, sparse };

/// As --densities names it.
const char* density_name(Density density);
/// The world step of one lattice coordinate of that BCC lattice (World), in Cartesian steps.
double bcc_step(Density density);

struct CompareVolume {
  std::string name;  ///< "cartesian", "bcc", "bcc sparse"
  Volume volume;
};

struct CompareSubject {
  std::string name;  ///< of the field or the file
  std::vector<CompareVolume> volumes;
  std::unique_ptr<Field> field;      ///< that `truth` refers to
  std::unique_ptr<Continuum> truth;  ///< null: not known
  double isovalue = 0.0;
  double cell = 0.0;  ///< world length in which depths are told: the Cartesian step, or that of the only volume
  std::string made;     ///< how the volumes were made, a clause; empty where they are as they were
  double border = 0.0;  ///< cells from the faces of the domain within which reconstructions are not compared with the truth

  /// Whether x (world) is inside every volume's domain, farther than the border from its faces.
  bool inside(const glm::dvec3& x) const;
};

/// A field sampled on [-1,1]^3: `samples` Cartesian ones along each axis, and as many or fewer BCC ones; the nearest number of them whose
/// domain is the cube too. Throws InputError unless 8 <= samples <= 1024.
CompareSubject field_subject(std::unique_ptr<Field> field, int samples, const std::vector<Density>& densities, const Progress& progress = {});

/// A Cartesian volume as the truth (its tricubic spline that takes the samples), and what is left of it on coarser lattices: a Cartesian one whose steps
/// are about `reduce` times as long, and BCC ones of as many samples or fewer; each made of the spline of the low-passed volume, the cut-off being what a
/// Cartesian lattice of as many samples holds. Throws InputError unless `volume` is Cartesian, of 16 samples along each axis of the coarser lattice at least.
CompareSubject reduced_subject(std::string name, const Volume& volume, double isovalue, double reduce, const std::vector<Density>& densities, const Progress& progress = {});

/// A volume as it is, with no truth but its own splines.
CompareSubject volume_subject(std::string name, Volume volume, double isovalue);

}  // namespace quincunx
