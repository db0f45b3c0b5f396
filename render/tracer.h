// Where one ray crosses isosurfaces, in double precision.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "accel/classification.h"
#include "accel/void_cells.h"
#include "render/ray.h"
#include "render/scene.h"
#include "render/void_stretches.h"
#include "spline/spline.h"

namespace quincunx {

/// A place where a ray passes through an isosurface, in either direction.
struct Crossing {
  double s = 0.0;   ///< along the ray, cells (see LatticeRay)
  int surface = 0;  ///< index into the tracer's isovalues
};

/// What a ray cost.
struct RayCost {
  std::uint32_t evaluations = 0;  ///< polynomial pieces restricted to the ray (exact), values of the spline (march, pieces that are no polynomials)
  std::uint32_t steps = 0;        ///< cells visited (exact), samples visited (march), looked at or skipped
  std::uint32_t intervals = 0;    ///< runs of them that were looked at
};

/// By how much rounding may move a value that the spline computes of these coefficients in double precision. Casters that do take all isovalues
/// to be lower by it, so that what equals one (a plateau, a tangent) counts as above it, as it has to.
double value_rounding(const Coefficients<double>& coefficients);

/// Finds the crossings of rays with isosurfaces of one spline. Safe to use from many threads, a workspace each.
class Tracer {
 public:
  struct Config {
    Intersect intersect = Intersect::exact;
    double step = 0.25;  ///< of Intersect::march, in cells
  };
  /// Memory that one thread reuses from ray to ray.
  struct Workspace {
    std::vector<double> knots, roots;
    std::vector<Crossing> crossings;
    VoidStretches voids;
  };
  /// Told of each crossing in ray order; false stops the ray.
  using Visitor = std::function<bool(const Crossing&)>;

  /// Keeps references to `spline` and `coefficients`. `isovalues` ascend. `cells` may be null: nothing is skipped; else the
  /// bounds of this spline, which change no crossing. `voids`, kept by reference, may be null too: no cell is void.
  Tracer(const Spline& spline, const Coefficients<double>& coefficients, std::span<const double> isovalues,
         const CellBounds* cells, const Config& config, const VoidCells* voids = nullptr);

  /// The crossings of one ray, clipped to the domain. A ray that starts above an isovalue does not cross it there; nor does one that leaves
  /// a void cell above it. Nothing is crossed inside void cells, and by marching not between two samples with one between them.
  void trace(const LatticeRay& ray, Workspace& work, RayCost& cost, const Visitor& visit) const;

  /// The place u(s) in the closed domain, free of rounding to its outside.
  glm::dvec3 place(const LatticeRay& ray, double s) const;

 private:
  struct Sample;

  /// Level: the number of isovalues at or below a value.
  int level_of(double value) const;
  /// The level that the bounds promise all over a cell, or kLook where an isovalue is touched or nothing is known.
  int promised_level(const glm::ivec3& cell) const;
  void trace_exact(const LatticeRay& ray, Workspace& work, RayCost& cost, const Visitor& visit) const;
  bool cross_cell(const LatticeRay& ray, const CellWalk& walk, int& level, Workspace& work, RayCost& cost,
                  const Visitor& visit) const;
  bool cross_smooth_cell(const LatticeRay& ray, const CellWalk& walk, int& level, Workspace& work, RayCost& cost,
                         const Visitor& visit) const;
  void find_crossings(std::span<const double> bernstein, double begin, double end, int& level, Workspace& work) const;
  void trace_march(const LatticeRay& ray, Workspace& work, RayCost& cost, const Visitor& visit) const;
  Sample sample(const LatticeRay& ray, double s, bool& looking, RayCost& cost) const;
  double value(const LatticeRay& ray, double s, RayCost& cost) const;
  double refine(const LatticeRay& ray, const Sample& from, const Sample& to, double isovalue, RayCost& cost) const;

  const Spline& spline_;
  const Coefficients<double>& coefficients_;
  Config config_;
  glm::dvec3 far_;
  glm::ivec3 cells_;
  std::vector<double> isovalues_;
  double rounding_;  ///< of values; isovalues_ are lower by it
  const VoidCells* voids_;
  Classification levels_;  ///< of single cells; empty where nothing is skipped
};

}  // namespace quincunx
