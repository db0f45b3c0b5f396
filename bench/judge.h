// Whether a picture's first hits are right, as far as arithmetic can decide: docs/stability.md derives the bounds.
#pragma once

#include <cstdint>
#include <optional>

#include "accel/bounds.h"
#include "accel/void_cells.h"
#include "render/ray.h"
#include "render/scene.h"
#include "render/tracer.h"
#include "spline/spline.h"

namespace quincunx {

/// What is wrong with a picture of one isosurface. Lengths are in cells of lattice coordinates, angles in degrees.
struct Verdict {
  std::uint64_t rays = 0;
  std::uint64_t expected = 0;    ///< hits of the reference
  std::uint64_t hits = 0;        ///< of the picture
  std::uint64_t holes = 0;       ///< no hit where there certainly is one
  std::uint64_t wrong = 0;       ///< a hit where there certainly is none, or behind one that certainly is; holes not among them
  std::uint64_t undecided = 0;   ///< another outcome than the reference's, which rounding excuses
  std::uint64_t not_finite = 0;  ///< pixels with a NaN, or with an infinite number that is no depth
  double depth = 0.0;            ///< the largest difference from the reference's hit on the same sheet, where the surface is not grazed
  double residual = 0.0;         ///< the largest |f - isovalue| at a hit, in parts of what is allowed there
  double normal = 0.0;           ///< the largest angle to the reference's gradient at the picture's own hit, where it is decided
  double normal_part = 0.0;      ///< in parts of what is allowed there

  /// No hole, nothing wrong, all finite, no hit off its surface and no normal off its gradient by more than is allowed.
  bool passed() const { return holes == 0 && wrong == 0 && not_finite == 0 && residual <= 1.0 && normal_part <= 1.0; }
  Verdict& operator+=(const Verdict& other);
};

/// The judge of pictures of one scene, by the double-precision spline.
class Judge {
 public:
  struct Config {
    double epsilon = 0x1p-24;  ///< half a unit in the last place, relative, of the arithmetic that is judged
    double offset = 0.0;       ///< that coefficients are less before they are rounded (ValueUnit)
    double shift = 0.0;        ///< by which kernels move isovalues (value_rounding)
    glm::i64vec3 cells{0};     ///< of the volume that is rendered, where the one that is judged by is a part of it
  };

  /// Keeps references. `scene` has one isosurface. `cells` may be null, or the bounds of this spline, which change nothing but the time. `voids`:
  /// cells in which nothing is seen; null: there are none. Where there are some, no other outcome than the reference's is excused.
  Judge(const Spline& spline, const Coefficients<double>& coefficients, const Scene& scene, const CellBounds* cells, const VoidCells* voids = nullptr);

  /// Judges `frame`, a picture of the scene by any way to intersect, in parallel.
  Verdict judge(const Frame& frame, const Config& config) const;

 private:
  struct Place;
  struct Ray {
    LatticeRay lattice;
    glm::dvec3 direction;            ///< unit, world
    std::optional<double> expected;  ///< s of the reference's first hit
  };

  Verdict judge_pixel(const Frame& frame, std::size_t pixel, const std::optional<Ray>& ray, const Config& config) const;
  void judge_hit(const Frame& frame, std::size_t pixel, const Ray& ray, const Place& hit, Verdict& verdict) const;
  /// What is known of the spline at s along a ray; `told`: s is made of a picture's depth, a float.
  Place place(const Ray& ray, double s, bool told, const Config& config) const;
  /// How far a point that is computed may be from the one that is meant, cells.
  double displacement(const Config& config) const;
  Jet jet(const LatticeRay& ray, double s, const glm::dvec3& aside = glm::dvec3(0.0)) const;
  /// Where the ray has certainly crossed the isovalue first: gone from below isovalue - band to above isovalue + band, or back.
  std::optional<double> decided(const Ray& ray, double band) const;

  const Spline& spline_;
  const Coefficients<double>& coefficients_;
  const VoidCells* voids_;
  double isovalue_, rounding_;
  int width_, height_;
  glm::dmat3 normals_;  ///< gradients of lattice coordinates to those of the world
  glm::dvec3 far_;
  std::vector<std::optional<Ray>> rays_;  ///< of every pixel
};

/// The largest |coefficient - offset| that reaches the cell of u or one of its neighbours.
double local_magnitude(const Coefficients<double>& c, const glm::dvec3& u, double offset);

}  // namespace quincunx
