// The plug-in point of reconstruction splines, and the one list of them.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "lattice/progress.h"
#include "lattice/volume.h"
#include "spline/coefficients.h"

namespace quincunx {

/// Value and gradient at a point; the gradient is per lattice coordinate.
struct Jet {
  double value = 0.0;
  glm::dvec3 gradient{0.0};
};

/// A spline s(u) = sum_j c_j M(u - j) over a lattice's points j, piecewise polynomial (or smooth: polynomial()), in lattice coordinates u.
/// Its double-precision functions here are the reference that every kernel is compared with.
class Spline {
 public:
  /// What makes coefficients of samples: the one of full approximation order (automatic); nothing, the samples are the coefficients
  /// (none); quasi-interpolation by a mask of few samples (fir); interpolation of the samples, whose mask has no end (iir).
  enum class Prefilter { automatic, none, fir, iir };
  struct Filter {
    Prefilter kind;
    /// A coefficient depends on the samples whose indices, in either coset, differ from its own by at most this along each axis.
    int reach;
    /// The sum of its |weights|: how far from the middle of the samples' range coefficients may be, in halves of it.
    double gain;
    /// Approximation order of the values: the error of a smooth function's samples falls with this power of the spacing.
    int order;
  };

  virtual ~Spline() = default;

  virtual std::string_view name() const = 0;
  virtual LatticeKind lattice() const = 0;
  /// Whether pieces are polynomials, which degree(), split() and restrict_to_segment() tell. Where not, these are not called: each cell is one
  /// smooth piece, which evaluate_piece() and curvature() tell.
  virtual bool polynomial() const { return true; }
  /// Total degree of a polynomial piece, and so its degree along a ray.
  virtual int degree() const = 0;
  /// Samples of border that the stencil reaches beyond the domain, per side of each coset. Coefficients may have more:
  /// those of a Cartesian volume with an axis of one sample have one more, for that axis's one cell (cell_count).
  virtual int apron() const = 0;
  /// The prefilters that it has: the one of Prefilter::automatic, of full order, first; `none` last.
  virtual std::span<const Filter> filters() const = 0;
  /// The one of that kind; throws InputError (--prefilter) naming those it has.
  const Filter& filter(Prefilter wanted) const;
  /// The GLSL twin, a file of shaders/.
  virtual std::string_view shader() const = 0;

  /// The generator M(x) and its gradient, x in lattice coordinates from its centre. M has unit sum over the lattice.
  virtual Jet generator(const glm::dvec3& x) const = 0;

  /// s and its gradient at u, which is inside the domain (asserted).
  virtual Jet evaluate(const Coefficients<double>& c, const glm::dvec3& u) const = 0;

  /// The same of the smooth piece of `cell` at u in the closed cell, from either side of its faces.
  virtual Jet evaluate_piece(const Coefficients<double>& c, const glm::ivec3& cell, const glm::dvec3& u) const;
  /// At least as large as |second derivative of s(u + t d) by t| all over the smooth piece of `cell`.
  virtual double curvature(const Coefficients<double>& c, const glm::ivec3& cell, const glm::dvec3& d) const;

  /// Appends to `t` the parameters strictly between t0 and t1 at which o + t d crosses a knot plane inside the
  /// cell (unit cube) `cell`, ascending. Between two of them the spline is one polynomial along the ray.
  virtual void split(const glm::ivec3& cell, const glm::dvec3& o, const glm::dvec3& d, double t0, double t1,
                     std::vector<double>& t) const = 0;

  /// Bernstein coefficients (degree+1 of them) of s on the segment a..b, which lies in one polynomial piece of the
  /// cell `cell`; the piece is that of the segment's middle. s at a is bernstein.front(), at b bernstein.back().
  virtual void restrict_to_segment(const Coefficients<double>& c, const glm::ivec3& cell, const glm::dvec3& a,
                                   const glm::dvec3& b, std::span<double> bernstein) const = 0;

  /// What the prefilter makes of the samples. Computed in double, each coefficient by the same operations wherever it stands: those of a box cut
  /// out of the volume, wider by the filter's reach, are the volume's to the last bit. Throws InputError for a prefilter that the spline does
  /// not have and on NaN or infinite samples (count and first place).
  virtual Coefficients<double> coefficients(const Volume& volume, Prefilter prefilter,
                                            const Progress& progress = {}) const = 0;
  /// The same in `unit`, each rounded to float once.
  virtual Coefficients<float> coefficients_float(const Volume& volume, Prefilter prefilter, const ValueUnit& unit = {},
                                                 const Progress& progress = {}) const = 0;
};

/// As --prefilter names them.
std::string_view prefilter_name(Spline::Prefilter prefilter);

/// The names make_spline knows.
const std::vector<std::string_view>& spline_names();

/// Those of them whose pieces are polynomials.
const std::vector<std::string_view>& polynomial_spline_names();

/// The one to take where nothing is asked for.
std::string_view default_spline(LatticeKind lattice);

/// The spline of that name; throws InputError naming the choices.
std::unique_ptr<Spline> make_spline(std::string_view name);

/// The same for a volume on `lattice`, empty: its default_spline. Throws InputError (--spline) for one of the other lattice.
std::unique_ptr<Spline> make_spline(std::string_view name, LatticeKind lattice);

}  // namespace quincunx
