#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <charconv>
#include <cmath>
#include <random>

#include "io/volume_file.h"
#include "program.h"
#include "spline/spline.h"

namespace quincunx::test {
namespace {

using testing::HasSubstr;
using Row = std::array<double, 7>;  ///< x,y,z,value,gx,gy,gz

/// The rows of what eval printed, whose header is checked.
std::vector<Row> rows(const std::string& out) {
  std::vector<Row> result;
  const std::vector<std::string> text = lines(out);
  EXPECT_THAT(text, testing::Contains("x,y,z,value,gx,gy,gz").Times(1));
  for (std::size_t n = 1; n < text.size(); ++n) {
    Row row{};
    const char *at = text[n].data(), *end = at + text[n].size();
    for (double& number : row) {
      const auto parsed = std::from_chars(at, end, number);
      EXPECT_EQ(parsed.ec, std::errc()) << text[n];
      at = parsed.ptr == end ? end : parsed.ptr + 1;
    }
    EXPECT_EQ(at, end) << text[n];
    result.push_back(row);
  }
  return result;
}

std::string csv(const std::vector<glm::dvec3>& points) {
  std::string text = "x,y,z\n";
  for (const glm::dvec3& x : points) text += fmt::format("{:.17g},{:.17g},{:.17g}\n", x.x, x.y, x.z);
  return text;
}

/// Sheared and anisotropic: nothing about the axes is orthogonal.
World sheared_world() {
  return {.origin = {-3.0, 5.0, 11.0}, .axes = glm::dmat3(0.5, 0.1, 0, -0.2, 0.7, 0.1, 0.3, 0, 1.3)};
}

Volume random_volume() {
  std::mt19937 random(3);
  return make_volume(LatticeKind::bcc, {5, 6, 4}, sheared_world(),
                     [&](const glm::dvec3&) { return double(random() % 1000); });
}

/// `count` points of the world whose lattice coordinates lie between low and high.
std::vector<glm::dvec3> random_points(const World& world, const glm::dvec3& low, const glm::dvec3& high, int count) {
  std::mt19937 random(4);
  std::vector<glm::dvec3> points;
  for (int n = 0; n < count; ++n) {
    glm::dvec3 u;
    for (int a = 0; a < 3; ++a) u[a] = low[a] + (high[a] - low[a]) * (double(random()) / 4294967295.0);
    points.push_back(world.to_world(u));
  }
  return points;
}

TEST(Eval, AgreesWithTheSplineValueAndGradientInTheWorld) {
  const TemporaryFolder folder;
  const Volume volume = random_volume();
  write_volume(volume, folder / "v.nrrd");
  // More points than are read at a time, so that the seam between two such parts is crossed.
  const auto points = random_points(volume.world, glm::dvec3(0.001), glm::dvec3(8.999, 10.999, 6.999), 9000);
  write_file(folder / "p.csv", csv(points));
  const Outcome outcome = run({"eval", folder / "v.nrrd", "--points", folder / "p.csv"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto found = rows(outcome.out);
  ASSERT_EQ(found.size(), points.size());

  const auto spline = make_spline("bcc7");
  const auto coefficients = spline->coefficients(volume, Spline::Prefilter::automatic);
  for (std::size_t n = 0; n < points.size(); ++n) {
    ASSERT_EQ(glm::dvec3(found[n][0], found[n][1], found[n][2]), points[n]);
    const Jet jet = spline->evaluate(coefficients, volume.world.to_lattice(points[n]));
    const glm::dvec3 gradient = volume.world.gradient_to_world(jet.gradient);
    ASSERT_NEAR(found[n][3], jet.value, 1e-9);
    for (int a = 0; a < 3; ++a) ASSERT_NEAR(found[n][std::size_t(4 + a)], gradient[a], 1e-8);
  }
}

TEST(Eval, ReproducesALinearFieldAwayFromTheBorder) {
  const TemporaryFolder folder;
  const glm::dvec3 slope(2.0, -3.0, 0.5);
  // Steps that are powers of two: the samples are exact in 32-bit floats.
  const World world{.origin = {1.0, 2.0, 4.0}, .axes = glm::dmat3(0.5, 0, 0, 0, 0.25, 0, 0, 0, 2)};
  const Volume volume =
      make_volume(LatticeKind::bcc, {8, 8, 8}, world, [&](const glm::dvec3& x) { return 1.0 + glm::dot(slope, x); });
  write_volume(volume, folder / "v.nrrd");
  const auto points = random_points(world, glm::dvec3(5.0), glm::dvec3(10.0), 200);
  write_file(folder / "p.csv", csv(points));
  for (const char* prefilter : {"--precision=double", "--prefilter=none"}) {
    const auto found = rows(run({"eval", folder / "v.nrrd", "--points", folder / "p.csv", prefilter}).out);
    ASSERT_EQ(found.size(), points.size());
    for (std::size_t n = 0; n < points.size(); ++n) {
      ASSERT_NEAR(found[n][3], 1.0 + glm::dot(slope, points[n]), 1e-12);
      for (int a = 0; a < 3; ++a) ASSERT_NEAR(found[n][std::size_t(4 + a)], slope[a], 1e-11);
    }
  }
}

TEST(Eval, GivesNanOutsideTheDomainAndNumbersOnItsCorners) {
  const TemporaryFolder folder;
  const Volume volume = random_volume();
  write_volume(volume, folder / "v.nrrd");
  const glm::dvec3 far(domain_max(volume.lattice, volume.extents));
  std::vector<glm::dvec3> points;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 u = far * glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2);
    points.push_back(volume.world.to_world(u));
    points.push_back(volume.world.to_world(u + 1e-6 * (u - 0.5 * far)));
  }
  write_file(folder / "p.csv", csv(points));
  const auto found = rows(run({"eval", folder / "v.nrrd", "--points", folder / "p.csv"}).out);
  ASSERT_EQ(found.size(), 16u);
  for (std::size_t n = 0; n < found.size(); ++n) {
    for (std::size_t column = 3; column < 7; ++column) EXPECT_EQ(std::isnan(found[n][column]), n % 2 == 1) << n;
  }
}

TEST(Eval, InFloatIsNearTheDoubleAndNotTheSame) {
  const TemporaryFolder folder;
  const Volume volume = random_volume();
  write_volume(volume, folder / "v.nrrd");
  write_file(folder / "p.csv", csv(random_points(volume.world, glm::dvec3(0.0), glm::dvec3(9, 11, 7), 300)));
  const Arguments arguments{"eval", folder / "v.nrrd", "--points", folder / "p.csv", "--precision"};
  const auto with = [&](const char* precision) {
    Arguments all = arguments;
    all.push_back(precision);
    return rows(run(all).out);
  };
  const auto exact = with("double"), single = with("float");
  ASSERT_EQ(exact.size(), single.size());
  double largest = 0.0;
  for (std::size_t n = 0; n < exact.size(); ++n) {
    ASSERT_EQ(std::isnan(exact[n][3]), std::isnan(single[n][3]));
    // 30 products of at most about 2000, each rounded to 24 bits, and a world whose cells are about one unit wide.
    for (std::size_t column = 3; column < 7; ++column) {
      ASSERT_NEAR(single[n][column], exact[n][column], 5e-3);
      largest = std::max(largest, std::abs(single[n][column] - exact[n][column]));
    }
  }
  EXPECT_GT(largest, 1e-7);
}

TEST(Eval, TakesTheSamplesAsCoefficientsWithoutThePrefilter) {
  const TemporaryFolder folder;
  const Volume volume = random_volume();
  write_volume(volume, folder / "v.nrrd");
  const glm::dvec3 u(4.3, 5.2, 3.1);
  write_file(folder / "p.csv", csv({volume.world.to_world(u)}));
  const auto spline = make_spline("bcc7");
  const auto coefficients = spline->coefficients(volume, Spline::Prefilter::none);
  const auto found = rows(run({"eval", folder / "v.nrrd", "--points", folder / "p.csv", "--prefilter", "none"}).out);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0][3], spline->evaluate(coefficients, u).value, 1e-9);
}

TEST(Eval, OfStoredCoefficientsIsOffByWhatTheFormatIs) {
  const TemporaryFolder folder;
  const Volume volume = random_volume();
  write_volume(volume, folder / "v.nrrd");
  write_file(folder / "p.csv", csv(random_points(volume.world, glm::dvec3(0.0), glm::dvec3(9, 11, 7), 500)));
  const auto with = [&](const char* storage, const char* precision) {
    return rows(run({"eval", folder / "v.nrrd", "--points", folder / "p.csv", "--prefilter", "none", "--storage", storage, "--precision", precision}).out);
  };
  const auto exact = with("float32", "double");
  EXPECT_EQ(exact, rows(run({"eval", folder / "v.nrrd", "--points", folder / "p.csv", "--prefilter", "none"}).out));
  // Samples of 0 to 999: half a step of each format, and weights that sum to 1.
  for (const auto& [storage, half_step] : {std::pair{"float16", 500.0 / 4096}, {"unorm16", 500.0 / 65535}, {"unorm8", 500.0 / 255}}) {
    const auto found = with(storage, "double"), single = with(storage, "float");
    double largest = 0.0;
    for (std::size_t n = 0; n < exact.size(); ++n) {
      largest = std::max(largest, std::abs(found[n][3] - exact[n][3]));
      ASSERT_NEAR(single[n][3], found[n][3], 1e-3) << storage;
    }
    EXPECT_LE(largest, half_step + 1e-4) << storage;
    EXPECT_GT(largest, 0.1 * half_step) << storage;
  }
  const Outcome refused = run({"eval", folder / "v.nrrd", "--points", folder / "p.csv", "--storage", "int8"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("--storage"));
}

TEST(Eval, NamesTheLineThatIsNoPointAndPrintsNothing) {
  const TemporaryFolder folder;
  write_volume(random_volume(), folder / "v.nrrd");
  write_file(folder / "p.csv", "x,y,z\n0,0,0\n1,2,abc\n");
  const Outcome outcome = run({"eval", folder / "v.nrrd", "--points", folder / "p.csv"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr("p.csv:3: found 'abc'"));
}

TEST(Eval, OfNoPointsPrintsTheHeader) {
  const TemporaryFolder folder;
  write_volume(random_volume(), folder / "v.nrrd");
  write_file(folder / "p.csv", "");
  const Outcome outcome = run({"eval", folder / "v.nrrd", "--points", folder / "p.csv"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "x,y,z,value,gx,gy,gz\n");
}

TEST(Eval, GivesNothingInVoidCellsAndTheLinearFieldBesideThem) {
  const TemporaryFolder folder;
  const auto field = [](const glm::dvec3& x) { return 1.0 + 2.0 * x.x - x.y + 0.5 * x.z; };
  Volume volume = make_volume(LatticeKind::bcc, {9, 9, 9}, {}, field);
  std::get<std::vector<float>>(volume.samples)[4 * 81 + 4 * 9 + 4] = std::nanf("");  // at (8, 8, 8)
  write_volume(volume, folder / "v.nrrd");
  write_file(folder / "p.csv", "8,8,8\n6.2,7.9,8.1\n4.7,8.3,8.4\n11.3,8.2,8.4\n5.2,5.2,5.2\n");
  EXPECT_EQ(run({"eval", folder / "v.nrrd", "--points", folder / "p.csv"}).status, 2);
  for (const std::string precision : {"double", "float"}) {
    const Outcome outcome = run({"eval", folder / "v.nrrd", "--points", folder / "p.csv", "--nan", "empty", "--precision", precision});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const std::vector<Row> result = rows(outcome.out);
    ASSERT_EQ(result.size(), 5u);
    for (std::size_t n = 0; n < 5; ++n) {
      if (n < 2) {
        EXPECT_TRUE(std::isnan(result[n][3]) && std::isnan(result[n][4])) << n;
      } else {
        EXPECT_NEAR(result[n][3], field({result[n][0], result[n][1], result[n][2]}), 1e-4) << n;
        EXPECT_NEAR(result[n][4], 2.0, 1e-4) << n;
      }
    }
  }
  const std::vector<Row> filled = rows(run({"eval", folder / "v.nrrd", "--points", folder / "p.csv", "--nan", "fill=9"}).out);
  // The field is 13 there, and the weight at a sample's own place, prefiltered, about 0.5.
  EXPECT_GT(filled[0][3], 9.0);
  EXPECT_LT(filled[0][3], 13.0);
}

}  // namespace
}  // namespace quincunx::test
