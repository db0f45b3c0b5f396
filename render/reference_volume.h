// Direct volume rendering in double precision: the truth that shaders/volume.glsl is compared with.
#pragma once

#include <optional>

#include "render/ray.h"
#include "render/shading.h"
#include "render/scene.h"
#include "render/tracer.h"
#include "render/void_stretches.h"
#include "spline/spline.h"

namespace quincunx {

/// The volume along rays, cut into the same stretches as the kernels'. Transfer functions are evaluated as they are, without a table; a
/// pre-integrated stretch by many parts of a value that goes linearly.
class ReferenceVolume {
 public:
  /// All are kept by reference. `ambient` as in Scene. `voids` may be null: no cell is void.
  ReferenceVolume(const Spline& spline, const Coefficients<double>& coefficients, const DirectVolume& volume, double ambient,
                  const VoidCells* voids = nullptr);

  /// How far one ray has come.
  struct March {
    double shift = 0.0;           ///< by which part of a stretch the first one begins before the ray
    double k = 0.0, reached = 0.0;
    std::optional<double> half;   ///< s where half of what is behind was hidden first
    VoidStretches voids;
  };
  /// Of the ray of pixel (i,j), which passes no void cells, or some.
  March begin(int i, int j) const;
  March begin(int i, int j, const LatticeRay& ray) const;

  /// Adds what is before s = `end` (cells from the ray's entry) to `seen`. `direction`: of the ray, unit, world.
  void integrate(const LatticeRay& ray, const glm::dvec3& direction, double end, March& march, Composite& seen, RayCost& cost) const;

  /// Nothing more is to be seen behind.
  bool opaque(const Composite& seen) const { return seen.transmittance <= volume_.termination; }

 private:
  struct Stretch {
    glm::dvec3 color{0.0};  ///< premultiplied
    double opacity = 0.0;
  };
  /// What a stretch of `length` (world) of one value adds.
  Stretch classified(double value, double length) const;
  Stretch pre_integrated(double front, double back, double length) const;
  /// From s = first to last. A place in a void cell has no opacity, nor, seen by its two ends, has a stretch that touches one.
  Stretch stretch(const LatticeRay& ray, const glm::dvec3& direction, double first, double last, const VoidStretches& voids, RayCost& cost) const;
  Stretch sampled(const LatticeRay& ray, const glm::dvec3& direction, double s, double length, const VoidStretches& voids, RayCost& cost,
                  double* change = nullptr) const;
  /// A part of a stretch's length, or of its extinction.
  static Stretch share(const Stretch& stretch, double part);
  /// Light and modulation by a gradient (lattice).
  Stretch lit(Stretch stretch, const glm::dvec3& gradient, const glm::dvec3& direction) const;
  glm::dvec3 place(const LatticeRay& ray, double s) const;

  const Spline& spline_;
  const Coefficients<double>& coefficients_;
  const DirectVolume& volume_;
  const VoidCells* voids_;
  double ambient_, unit_, length_;  ///< world: of an opacity, of a stretch
};

}  // namespace quincunx
