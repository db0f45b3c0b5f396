#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace quincunx::test
