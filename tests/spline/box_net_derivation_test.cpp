// What is derived, derived again.
#include "spline/box_net_derivation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include "spline/bcc7.h"
#include "spline/exact_box_spline.h"
#include "tests/spline/spline_fixtures.h"

namespace quincunx {
namespace {

std::string file_text(const std::string& path) {
  std::ifstream file(std::string(QUINCUNX_SOURCE_DIR "/") + path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Not EXPECT_EQ on the texts: a failure prints the first line that differs, not both files.
void expect_same(const std::string& derived, const std::string& path) {
  const std::string file = file_text(path);
  const auto [a, b] = std::mismatch(derived.begin(), derived.end(), file.begin(), file.end());
  if (a == derived.end() && b == file.end()) return;
  const auto line = 1 + std::count(derived.begin(), a, '\n');
  ADD_FAILURE() << path << " differs from what is derived in line " << line << "; build the target derive_box_splines";
}

class Derivation : public testing::TestWithParam<DerivedSpline> {};

TEST_P(Derivation, MakesTheFilesInTheTreeAgainByteForByte) {
  const DerivedSpline& spline = GetParam();
  const ExactNet net = derive_net(spline);
  expect_same(net_header(spline, net), "spline/" + spline.name + "_net.h");
  expect_same(piece_tables_glsl(spline, net), "shaders/" + spline.name + "_tables.glsl");
}

INSTANTIATE_TEST_SUITE_P(List, Derivation, testing::ValuesIn(derived_splines()), [](const auto& instance) { return instance.param.name; });

RationalPoint rational(const glm::dvec3& x) { return {mpq_class(x.x), mpq_class(x.y), mpq_class(x.z)}; }

TEST(ExactBoxSpline, IsTheTrilinearHatForTheThreeAxesTwice) {
  // (1 - |x|)(1 - |y|)(1 - |z|) by definition.
  ExactBoxSpline hat({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  EXPECT_EQ(hat.value({mpq_class(1, 4), mpq_class(-1, 2), mpq_class(1, 8)}), mpq_class(21, 64));
  EXPECT_EQ(hat.value({mpq_class(5, 4), mpq_class(-1, 2), mpq_class(1, 8)}), 0);
}

TEST(Bcc7, AgreesWithTheExactRecursionOnAVolume) {
  const Bcc7 spline;
  const Extents extents(3);
  const auto c =
      spline.coefficients(random_volume(LatticeKind::bcc, extents, 1), Spline::Prefilter::automatic);
  ExactBoxSpline exact(bcc7_directions());
  Random random(2);
  for (int n = 0; n < 6; ++n) {
    const glm::dvec3 u = random.point(glm::dvec3(0.0), glm::dvec3(5.0));
    mpq_class value;
    RationalPoint gradient;
    for_lattice_points(LatticeKind::bcc, u, 3.0, [&](int coset, const glm::i64vec3& index, const glm::dvec3& j) {
      const mpq_class coefficient(
          c.data[c.number(coset, glm::clamp(index, glm::i64vec3(0), extents - std::int64_t(1)))]);
      const RationalPoint x = rational(u - j);  // exact: u has 32 bits after the point
      value += 4 * coefficient * exact.value(x);
      const RationalPoint slope = exact.gradient(x);
      for (int a = 0; a < 3; ++a) gradient[a] += 4 * coefficient * slope[a];
    });
    const Jet jet = spline.evaluate(c, u);
    EXPECT_NEAR(jet.value, value.get_d(), 1e-14);
    for (int a = 0; a < 3; ++a) EXPECT_NEAR(jet.gradient[a], gradient[a].get_d(), 1e-14);
  }
}

}  // namespace
}  // namespace quincunx
