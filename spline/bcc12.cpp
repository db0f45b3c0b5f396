#include "spline/bcc12.h"

#include <algorithm>
#include <cassert>

#include "spline/tricubic.h"

namespace quincunx {
namespace {

using Piece = TensorPiece<CubicBasis>;

/// The cube between 8 samples of a coset that holds `cell`: where it begins, and its samples.
struct CosetPiece {
  glm::dvec3 begin;  ///< lattice coordinates
  Piece piece;

  CosetPiece(const Coefficients<double>& c, int coset, const glm::ivec3& cell) : CosetPiece(c, coset, (cell - coset) >> 1, 0) {
    assert(c.lattice == LatticeKind::bcc && c.apron >= 2);
  }
  glm::dvec3 own(const glm::dvec3& u) const { return 0.5 * (u - begin); }

 private:
  CosetPiece(const Coefficients<double>& c, int coset, const glm::ivec3& index, int)
      : begin(2 * index + coset), piece(c, coset, glm::i64vec3(index) - std::int64_t(1)) {}
};

const AxisMask& mask_of(const Spline::Filter& filter) {
  return filter.kind == Spline::Prefilter::none ? kIdentityAxisMask : kCubicAxisMask;
}

}  // namespace

Jet Bcc12::generator(const glm::dvec3& x) const {
  const Jet jet = tensor_generator<CubicBasis>(0.5 * x);
  return {0.5 * jet.value, 0.25 * jet.gradient};
}

Jet Bcc12::evaluate(const Coefficients<double>& c, const glm::dvec3& u) const {
  const glm::i64vec3 last = domain_max(LatticeKind::bcc, c.extents);
  assert(glm::all(glm::greaterThanEqual(u, glm::dvec3(0.0))) && glm::all(glm::lessThanEqual(u, glm::dvec3(last))));
  const glm::ivec3 cell = cell_of(u, last);
  Jet sum;
  for (int coset = 0; coset < 2; ++coset) {
    const CosetPiece p(c, coset, cell);
    const Jet jet = p.piece.jet(p.own(u));
    sum.value += 0.5 * jet.value;
    sum.gradient += 0.25 * jet.gradient;
  }
  return sum;
}

void Bcc12::restrict_to_segment(const Coefficients<double>& c, const glm::ivec3& cell, const glm::dvec3& a, const glm::dvec3& b,
                                std::span<double> bernstein) const {
  assert(bernstein.size() == 10);
  Piece::Segment sum{};
  for (int coset = 0; coset < 2; ++coset) {
    const CosetPiece p(c, coset, cell);
    p.piece.add_segment(p.own(a), p.own(b), sum);
  }
  for (int m = 0; m < 10; ++m) bernstein[std::size_t(m)] = 0.5 * sum[std::size_t(m)] / detail::binomial(9, m);
}

Coefficients<double> Bcc12::coefficients(const Volume& volume, Prefilter prefilter, const Progress& progress) const {
  return axis_coefficients<double>(volume, LatticeKind::bcc, mask_of(filter(prefilter)), apron(), name(), {}, progress);
}

Coefficients<float> Bcc12::coefficients_float(const Volume& volume, Prefilter prefilter, const ValueUnit& unit, const Progress& progress) const {
  return axis_coefficients<float>(volume, LatticeKind::bcc, mask_of(filter(prefilter)), apron(), name(), unit, progress);
}

}  // namespace quincunx
