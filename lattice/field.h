// Analytic test fields: functions of the cube [-1,1]^3 whose value and gradient are known.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "lattice/progress.h"
#include "lattice/volume.h"

namespace quincunx {

/// A smooth function on [-1,1]^3 (defined everywhere).
class Field {
 public:
  virtual ~Field() = default;
  virtual std::string_view name() const = 0;
  virtual double value(const glm::dvec3& x) const = 0;
  virtual glm::dvec3 gradient(const glm::dvec3& x) const = 0;
  /// An isovalue at which the field has a surface worth looking at.
  virtual double isovalue() const = 0;
};

/// The names make_field knows: marschner-lobb, sphere, torus, gyroid, waves, quartic.
const std::vector<std::string_view>& field_names();

/// The field of that name; `seed` chooses the coefficients of `quartic`. Throws InputError naming the choices.
///   marschner-lobb  S. Marschner, R. Lobb, An evaluation of reconstruction filters for volume rendering, 1994
///                   (DOI 10.1109/VISUAL.1994.346331), f_M = 6, alpha = 0.25; isovalue 0.5
///   sphere          0.8^2 - |x|^2; isovalue 0
///   torus           the quartic 4 R^2 (x^2 + y^2) - (|x|^2 + R^2 - r^2)^2, R = 0.6, r = 0.25; isovalue 0
///   gyroid          sin cos + sin cos + sin cos, two periods across the cube; isovalue 0
///   waves           sin(5x + 2y) cos(4y - 3z + 0.3); isovalue 0
///   quartic         a random polynomial of total degree 4, coefficients uniform in [-1,1]
std::unique_ptr<Field> make_field(std::string_view name, unsigned seed = 1);

/// The field sampled on a lattice that fills the cube: the domain's box [0, domain_max] spans [-1,1]^3 along
/// each axis (an axis with domain_max 0 stands at 0). Samples are float32.
/// Throws InputError unless all extents are >= 1.
Volume sample_field(const Field& field, LatticeKind lattice, const Extents& extents, const Progress& progress = {});

}  // namespace quincunx
