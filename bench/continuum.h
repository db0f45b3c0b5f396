// What volumes are samples of: the truth that a reconstruction is measured against.
#pragma once

#include <functional>
#include <memory>

#include "lattice/field.h"
#include "lattice/progress.h"
#include "render/scene.h"
#include "spline/spline.h"

namespace quincunx {

/// A function on a box of the world.
class Continuum {
 public:
  virtual ~Continuum() = default;
  /// Value, and gradient per world unit, at x inside the box.
  virtual Jet at(const glm::dvec3& x) const = 0;
  /// The first hits of a scene's one isosurface inside the box, lit as the reference caster does.
  virtual Frame frame(const Scene& scene, const Progress& progress = {}) const = 0;
};

/// An analytic field on [-1,1]^3. Along a ray it is looked at every `step` (world units, at most); between two places a root is found where the
/// value changes sides, and a pair of roots where the slopes at the two ends show that it turns round between them and
/// the turning point is on the other side. Keeps a reference.
std::unique_ptr<Continuum> field_continuum(const Field& field, double step);

/// The spline of a volume, in double precision, with its own first roots. Keeps no reference.
std::unique_ptr<Continuum> spline_continuum(const Volume& volume, std::string_view spline, Spline::Prefilter prefilter, const Progress& progress = {});

}  // namespace quincunx
