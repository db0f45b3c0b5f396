#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "io/volume_file.h"
#include "program.h"

namespace quincunx::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Pair;

Volume cartesian_volume() {
  const World world{.origin = {1.0, 2.0, 3.0}, .axes = glm::dmat3(0.5, 0, 0, 0, 1, 0, 0, 0, 2)};
  Volume volume = make_volume(LatticeKind::cartesian, {5, 6, 7}, world,
                              [](const glm::dvec3& x) { return x.x + 10.0 * x.y + 100.0 * x.z; });
  volume.notes = {{"license", "none needed"}};
  return volume;
}

TEST(Convert, MakesABccVolumeOfTheEvenAndTheOddPoints) {
  const TemporaryFolder folder;
  const Volume in = cartesian_volume();
  write_volume(in, folder / "in.nrrd");
  const Outcome outcome = run({"convert", folder / "in.nrrd", folder / "out.nrrd", "--lattice", "bcc"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out + outcome.err, "");
  const Volume out = read_volume(folder / "out.nrrd");
  ASSERT_EQ(out.lattice, LatticeKind::bcc);
  ASSERT_EQ(out.extents, Extents(2, 3, 3));
  for (int c = 0; c < 2; ++c) {
    EXPECT_EQ(out.sample(c, {1, 2, 2}), in.sample(0, {2 + c, 4 + c, 4 + c}));
    EXPECT_EQ(out.sample(c, {0, 0, 1}), in.sample(0, {c, c, 2 + c}));
  }
  EXPECT_EQ(out.world.to_world({2.0, 4.0, 2.0}), in.world.to_world({2.0, 4.0, 2.0}));
}

TEST(Convert, KeepsTheNotesAndTellsTheHistory) {
  const TemporaryFolder folder;
  write_volume(cartesian_volume(), folder / "in.nrrd");
  ASSERT_EQ(run({"convert", folder / "in.nrrd", folder / "bcc.nrrd", "--lattice", "bcc"}).status, 0);
  ASSERT_EQ(run({"convert", folder / "bcc.nrrd", folder / "back.nrrd", "--lattice", "cartesian"}).status, 0);
  const Volume back = read_volume(folder / "back.nrrd");
  EXPECT_THAT(back.notes, Contains(Pair("license", "none needed")));
  EXPECT_THAT(back.notes,
              Contains(Pair("history", testing::AllOf(HasSubstr("even and the odd points"), HasSubstr("even coset")))));
}

TEST(Convert, TakesTheEvenCosetAsACartesianVolume) {
  const TemporaryFolder folder;
  const Volume in = make_volume(LatticeKind::bcc, {3, 4, 5}, {}, [](const glm::dvec3& x) { return x.x * x.y + x.z; });
  write_volume(in, folder / "in.nrrd");
  ASSERT_EQ(
      run({"convert", folder / "in.nrrd", folder / "out.nrrd", "--lattice", "cartesian", "--method", "subset"}).status,
      0);
  const Volume out = read_volume(folder / "out.nrrd");
  ASSERT_EQ(out.lattice, LatticeKind::cartesian);
  ASSERT_EQ(out.extents, Extents(3, 4, 5));
  EXPECT_EQ(out.sample(0, {2, 3, 4}), in.sample(0, {2, 3, 4}));
}

TEST(Convert, WritesTheSameBytesEachTime) {
  const TemporaryFolder folder;
  write_volume(cartesian_volume(), folder / "in.nrrd");
  ASSERT_EQ(run({"convert", folder / "in.nrrd", folder / "a.nrrd", "--lattice", "bcc"}).status, 0);
  ASSERT_EQ(run({"convert", folder / "in.nrrd", folder / "b.nrrd", "--lattice", "bcc"}).status, 0);
  EXPECT_EQ(read_file(folder / "a.nrrd"), read_file(folder / "b.nrrd"));
}

TEST(Convert, RefusesAVolumeThatIsOnTheLatticeAlready) {
  const TemporaryFolder folder;
  write_volume(cartesian_volume(), folder / "in.nrrd");
  const Outcome outcome = run({"convert", folder / "in.nrrd", folder / "out.nrrd", "--lattice", "cartesian"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("in.nrrd"), HasSubstr("cartesian volume already")));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"in.nrrd"});
}

TEST(Convert, NamesTheFileThatIsTooThinForASubset) {
  const TemporaryFolder folder;
  Volume thin = make_volume(LatticeKind::cartesian, {1, 4, 4}, {}, [](const glm::dvec3& x) { return x.y; });
  write_volume(thin, folder / "thin.nrrd");
  const Outcome outcome = run({"convert", folder / "thin.nrrd", folder / "out.nrrd", "--lattice", "bcc"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("thin.nrrd: 1 x 4 x 4 samples"), HasSubstr("at least 2")));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"thin.nrrd"});
}

/// A smooth field of the world, sampled over a skewed box.
Volume smooth_volume(LatticeKind lattice) {
  const World world{.origin = {1.0, 2.0, 3.0}, .axes = glm::dmat3(0.5, 0, 0, 0.1, 0.5, 0, 0, 0, 0.75)};
  return make_volume(lattice, lattice == LatticeKind::bcc ? Extents(12, 11, 10) : Extents(24, 22, 20), world,
                     [](const glm::dvec3& x) { return std::sin(0.4 * x.x) + std::cos(0.3 * x.y) * std::sin(0.2 * x.z); });
}

/// Values of the spline that `eval` takes, at some places of the world away from the border.
std::vector<double> values_at(const TemporaryFolder& folder, const std::string& volume, const Arguments& more) {
  write_file(folder / "p.csv", "5,6,9\n6.5,7.25,10\n8,6.5,8.75\n7,8,7\n");
  Arguments arguments{"eval", volume, "--points", folder / "p.csv"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  std::vector<double> values;
  for (const std::string& line : lines(outcome.out)) {
    double x, y, z, value;
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &x, &y, &z, &value) == 4) values.push_back(value);
  }
  EXPECT_EQ(values.size(), 4u);
  return values;
}

TEST(Convert, ResamplesToTheOtherLatticeAndBackAndKeepsTheWorld) {
  const TemporaryFolder folder;
  for (const LatticeKind from : {LatticeKind::cartesian, LatticeKind::bcc}) {
    const LatticeKind to = from == LatticeKind::bcc ? LatticeKind::cartesian : LatticeKind::bcc;
    const Arguments own{"--spline", from == LatticeKind::bcc ? "bcc7" : "tricubic"}, other{"--spline", to == LatticeKind::bcc ? "bcc7" : "tricubic"};
    write_volume(smooth_volume(from), folder / "in.nrrd");
    const std::string to_name(lattice_name(to)), from_name(lattice_name(from));
    ASSERT_EQ(run({"convert", folder / "in.nrrd", folder / "out.nrrd", "--lattice", to_name, "--samples", "10000"}).status, 0);
    ASSERT_EQ(run({"convert", folder / "out.nrrd", folder / "back.nrrd", "--lattice", from_name, "--method", "spline", "--dims", "12", "11", "10", "--low-pass", "off"}).status, 0);
    const Volume out = read_volume(folder / "out.nrrd");
    EXPECT_EQ(out.lattice, to);
    EXPECT_EQ(out.type(), SampleType::float32);
    EXPECT_NEAR(double(out.sample_count()), 10000.0, 1000.0);
    EXPECT_THAT(out.notes, Contains(Pair("history", HasSubstr("resampled by"))));
    const std::vector<double> before = values_at(folder, folder / "in.nrrd", own), after = values_at(folder, folder / "out.nrrd", other),
                              back = values_at(folder, folder / "back.nrrd", own);
    for (std::size_t n = 0; n < before.size(); ++n) {
      EXPECT_NEAR(after[n], before[n], 2e-4);
      EXPECT_NEAR(back[n], before[n], 5e-3);
    }
  }
}

TEST(Convert, ResamplesOnTheSameLatticeAtASpacingWithALowPassWhereThatIsCoarser) {
  const TemporaryFolder folder;
  // A wave of 2.5 samples along x on a ramp: at twice the spacing it would come back as one of 10.
  write_volume(make_volume(LatticeKind::cartesian, {81, 12, 12}, {}, [](const glm::dvec3& x) { return 0.1 * x.x + std::cos(0.8 * M_PI * x.x); }), folder / "in.nrrd");
  const auto largest = [&](const std::string& low_pass) {
    EXPECT_EQ(run({"convert", folder / "in.nrrd", folder / "out.nrrd", "--lattice", "cartesian", "--spacing", "2", "--low-pass", low_pass}).status, 0);
    const Volume out = read_volume(folder / "out.nrrd");
    EXPECT_EQ(out.extents, Extents(41, 6, 6));
    double most = 0.0;
    for (std::int64_t i = 8; i < 33; ++i) most = std::max(most, std::abs(out.sample(0, {i, 3, 3}) - 0.2 * double(i)));
    return most;
  };
  EXPECT_LT(largest("auto"), 2e-3);
  EXPECT_LT(largest("on"), 2e-3);
  EXPECT_GT(largest("off"), 0.5);
}

TEST(Convert, WritesIntegersWhereAsked) {
  const TemporaryFolder folder;
  write_volume(make_volume(LatticeKind::cartesian, {8, 8, 8}, {}, [](const glm::dvec3& x) { return 30.4 * x.x; }), folder / "in.nrrd");
  ASSERT_EQ(run({"convert", folder / "in.nrrd", folder / "out.nrrd", "--lattice", "cartesian", "--dims", "8", "8", "8", "--spline", "trilinear", "--type", "uint8"}).status, 0);
  const Volume out = read_volume(folder / "out.nrrd");
  EXPECT_EQ(out.type(), SampleType::uint8);
  EXPECT_EQ(out.sample(0, {5, 0, 3}), 152.0);
}

class ConvertErrors : public ProgramInFolder {};

TEST_F(ConvertErrors, NameTheFlagOfResamplingThatDoesNotFit) {
  const std::string in = folder / "in.nrrd", out = folder / "out.nrrd", holed = folder / "holed.nrrd";
  write_volume(smooth_volume(LatticeKind::cartesian), in);
  write_volume(make_volume(LatticeKind::cartesian, {4, 4, 4}, {}, [](const glm::dvec3& x) { return x.x == 2.0 ? std::nan("") : x.y; }), holed);
  const auto refused = [&](Arguments more, const std::vector<std::string>& parts) {
    Arguments arguments{"convert", in, out, "--lattice", "bcc"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_refused(arguments, parts);
  };
  refused({"--method", "spline"}, {"--method", "none of --dims, --spacing and --samples"});
  refused({"--spacing", "1", "--samples", "100"}, {"several of --dims"});
  refused({"--method", "subset", "--spacing", "1"}, {"--spacing", "--method subset", "--method spline"});
  refused({"--low-pass", "on"}, {"--low-pass", "--method spline"});
  refused({"--type", "uint8"}, {"--type", "--method spline"});
  refused({"--samples", "100", "--type", "double"}, {"--type", "'double'", "float"});
  refused({"--samples", "0"}, {"--samples", "0"});
  refused({"--spacing", "-1"}, {"--spacing", "-1", "above 0"});
  refused({"--spacing", "1e9"}, {"--spacing", "at most"});
  refused({"--dims", "4", "4", "0"}, {"--dims", "0"});
  refused({"--dims", "100000000", "100000000", "100000000"}, {"--dims"});
  refused({"--spacing", "1e-4"}, {"--spacing", "memory"});
  refused({"--samples", "100", "--spline", "bcc7"}, {"--spline", "cartesian"});
  refused({"--samples", "100", "--spline", "tricubic", "--prefilter", "iir"}, {"--prefilter", "iir"});
  expect_refused({"convert", holed, out, "--lattice", "bcc", "--samples", "100"}, {"holed.nrrd", "16 NaN"});
}

}  // namespace
}  // namespace quincunx::test
