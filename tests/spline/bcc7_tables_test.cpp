// shaders/bcc7_tables.glsl compiled as C++, in double and in float, against the Bernstein form.
#include <gtest/gtest.h>

#include <array>

#include "spline/bcc7.h"
#include "tests/spline/spline_fixtures.h"

#define BCC7_FLOAT Number
#define COEFFICIENT(number) Number(data[number])
#include "shaders/bcc7_tables.glsl"

namespace quincunx {
namespace {

struct Tables {
  Jet jet;                          // at a
  std::array<double, 5> bernstein;  // along a..b
};

/// What a kernel computes at `a` and along the segment a..b of the tetrahedron, in `Number`s.
template <class Number>
Tables tables(const Coefficients<double>& c, const Tetrahedron& t, const glm::dvec3& a, const glm::dvec3& b) {
  const double* data = c.data.data();
  const int strides[3] = {1, int(c.stride_y()), int(c.stride_z())};
  int h[3];
  for (int i = 0; i < 3; ++i) h[i] = t.sign[t.axis[i]] * strides[t.axis[i]];
  const int even = int(c.number(0, t.vertex(0) / 2)), odd = int(c.number(1, (t.vertex(3) - 1) / 2));
  BCC7_FETCH(even, odd, h[0], h[1], h[2])
  BCC7_MONOMIALS

  const glm::dvec3 start = t.frame(a), step = t.frame(b) - start;
  const Number x = Number(start.x), y = Number(start.y), z = Number(start.z);
  const Number dx = Number(step.x), dy = Number(step.y), dz = Number(step.z);
  Number p0, p1, p2, p3, p4;
  BCC7_RESTRICT(p0, p1, p2, p3, p4, x, y, z, dx, dy, dz)
  Tables r;
  r.jet.value = BCC7_VALUE(x, y, z) / BCC7_SCALE;
  r.jet.gradient = t.gradient_from_frame(glm::dvec3(BCC7_DX(x, y, z), BCC7_DY(x, y, z), BCC7_DZ(x, y, z)) / BCC7_SCALE);
  r.bernstein = {p0 / BCC7_SCALE, p1 / BCC7_SCALE, p2 / BCC7_SCALE, p3 / BCC7_SCALE, p4 / BCC7_SCALE};
  return r;
}

/// Largest differences from the Bernstein form over random segments in random tetrahedra, samples in [-1,1].
template <class Number>
Tables largest_differences() {
  const Bcc7 spline;
  const Extents extents(3, 4, 5);
  const auto c = spline.coefficients(random_volume(LatticeKind::bcc, extents, 1), Spline::Prefilter::none);
  Tables largest{};
  Random random(2);
  for (int n = 0; n < 5000; ++n) {
    const glm::dvec3 a = random.point(glm::dvec3(0.0), glm::dvec3(domain_max(LatticeKind::bcc, extents)));
    const glm::ivec3 cell(glm::floor(a));
    const Tetrahedron t = locate(cell, a);
    // b = some mean of the vertices.
    glm::dvec3 b(0.0);
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) {
      const double weight = random.between(0.0, 1.0);
      b += weight * glm::dvec3(t.vertex(i));
      sum += weight;
    }
    b /= sum;
    const Tables got = tables<Number>(c, t, a, b);
    const Jet jet = spline.evaluate(c, a);
    std::array<double, 5> bernstein;
    spline.restrict_to_segment(c, cell, a, b, bernstein);
    largest.jet.value = std::max(largest.jet.value, std::abs(got.jet.value - jet.value));
    largest.jet.gradient = glm::max(largest.jet.gradient, glm::abs(got.jet.gradient - jet.gradient));
    for (int m = 0; m < 5; ++m)
      largest.bernstein[m] = std::max(largest.bernstein[m], std::abs(got.bernstein[m] - bernstein[m]));
  }
  return largest;
}

TEST(Bcc7Tables, AreTheSplineInEveryTetrahedron) {
  const Tables d = largest_differences<double>();
  EXPECT_LT(d.jet.value, 1e-15);
  for (int a = 0; a < 3; ++a) EXPECT_LT(d.jet.gradient[a], 5e-15);
  for (const double difference : d.bernstein) EXPECT_LT(difference, 2e-15);
}

TEST(Bcc7Tables, LoseFewBitsInFloats) {
  // 5 units in the last place of the samples' range for values, 25 for derivatives.
  const Tables d = largest_differences<float>();
  EXPECT_LT(d.jet.value, 5 * 0x1p-24);
  for (int a = 0; a < 3; ++a) EXPECT_LT(d.jet.gradient[a], 25 * 0x1p-24);
  for (const double difference : d.bernstein) EXPECT_LT(difference, 5 * 0x1p-24);
}

}  // namespace
}  // namespace quincunx
