// The double-precision caster on the CPU: the truth that the kernels are compared with, and `--device cpu`.
#pragma once

#include "accel/void_cells.h"
#include "lattice/progress.h"
#include "render/scene.h"
#include "spline/spline.h"

namespace quincunx {

/// Renders `scene` in double precision, in parallel, cell by cell along each ray.
///
/// Intersect::exact isolates the first root of each polynomial piece by the signs of its Bernstein coefficients, splitting
/// (de Casteljau) until decided, and of pieces that are no polynomials by steps that their curvature bounds (certified_root.h); Intersect::march samples every `step` cells from the entry into the domain and refines a
/// change of sign. Semi-transparent surfaces are composited front to back. A hit is as in the README: the first root of
/// f - isovalue inside the domain, f equal to the isovalue counting as above it.
///
/// `cells` may be null (nothing is skipped) or the bounds of the same spline, which then decide which cells
/// are looked at and change nothing in the picture. Nothing is seen in the cells of `voids`; null: there are none.
Frame render_reference(const Spline& spline, const Coefficients<double>& coefficients, const Scene& scene,
                       const CellBounds* cells, const Progress& progress = {}, const VoidCells* voids = nullptr);

}  // namespace quincunx
