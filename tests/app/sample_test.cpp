#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/volume_file.h"
#include "lattice/field.h"
#include "program.h"

namespace quincunx::test {
namespace {

using testing::HasSubstr;

TEST(Sample, GivesTheFieldsValuesAtTheLatticePointsOfTheCube) {
  const TemporaryFolder folder;
  for (const auto& [lattice, name] : {std::pair{LatticeKind::bcc, "quartic"}, {LatticeKind::cartesian, "gyroid"}}) {
    const Outcome outcome = run({"sample", name, folder / "v.nrrd", "--lattice", std::string(lattice_name(lattice)),
                                 "--dims", "3", "4", "5", "--seed", "7"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Volume volume = read_volume(folder / "v.nrrd");
    ASSERT_EQ(volume.lattice, lattice);
    ASSERT_EQ(volume.extents, Extents(3, 4, 5));
    const glm::dvec3 x = volume.world.to_world(double(lattice_step(lattice)) * glm::dvec3(1, 2, 3));
    EXPECT_NEAR(volume.sample(0, {1, 2, 3}), make_field(name, 7)->value(x), 1e-6) << name;
    const glm::dvec3 far = volume.world.to_world(glm::dvec3(domain_max(lattice, volume.extents)));
    EXPECT_LT(glm::length(far - glm::dvec3(1.0)), 1e-12) << name;
  }
}

TEST(Sample, MakesAnotherQuarticOfAnotherSeed) {
  const TemporaryFolder folder;
  for (const std::string seed : {"1", "2"}) {
    ASSERT_EQ(
        run({"sample", "quartic", folder / seed, "--lattice", "bcc", "--dims", "2", "2", "2", "--seed", seed}).status,
        0);
  }
  EXPECT_NE(read_volume(folder / "1").samples, read_volume(folder / "2").samples);
}

TEST(Sample, RefusesMoreThanTheMemoryHoldsBeforeAnythingIsAllocated) {
  const TemporaryFolder folder;
  // 2^40 samples a coset, 2 cosets, 4 bytes each: 8192 GiB.
  const Outcome outcome =
      run({"sample", "sphere", folder / "v.nrrd", "--lattice", "bcc", "--dims", "1099511627776", "1", "1"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("--dims"), HasSubstr("8192.0 GiB")));
  EXPECT_TRUE(folder.names().empty());
}

TEST(Sample, RefusesSizesWhoseProductOverflows) {
  const TemporaryFolder folder;
  const std::string huge = "1099511627776";
  const Outcome outcome = run({"sample", "sphere", folder / "v.nrrd", "--lattice", "bcc", "--dims", huge, huge, huge});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--dims"));
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace quincunx::test
