// The double-precision reference of a volume: its pictures, and how well a hit satisfies the surface's equation.
#pragma once

#include <memory>
#include <optional>

#include "accel/bounds.h"
#include "lattice/progress.h"
#include "render/ray.h"
#include "render/reference.h"

namespace quincunx {

class Truth {
 public:
  /// Of the bcc7 spline of a BCC volume, with its prefilter. Throws InputError for samples that are not finite.
  explicit Truth(const Volume& volume, const Progress& progress = {});

  /// The picture of `scene` with first roots (Intersect::exact, analytic normals), whatever the scene asks for.
  Frame frame(Scene scene, const Progress& progress = {}) const;

  /// The rays of a scene's pixels. Refers to the Truth.
  class Rays {
   public:
    Rays(const Truth& truth, const Scene& scene);
    /// The part of pixel (i,j)'s ray inside the domain; none where it misses it.
    std::optional<LatticeRay> ray(int i, int j) const;
    /// |f - isovalue| / |grad f| at the distance `depth` (world) along `ray`: how far, in cells and to first order, the
    /// surface is from there. 0 on the surface, infinite elsewhere where the gradient is 0.
    double residual(const LatticeRay& ray, double depth, double isovalue) const;

   private:
    const Truth& truth_;
    int width_, height_;
    CameraFrame camera_;
    RaySpace space_;
  };
  Rays rays(const Scene& scene) const { return Rays(*this, scene); }

 private:
  std::unique_ptr<Spline> spline_;
  Coefficients<double> coefficients_;
  CellBounds cells_;
};

}  // namespace quincunx
