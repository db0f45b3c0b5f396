#include "lattice/lattice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lattice/error.h"

namespace quincunx {
namespace {

// A sheared, left-handed, anisotropic world whose numbers are exact in binary.
World sheared_world() {
  return {{10.0, -20.0, 0.5},
          glm::dmat3(glm::dvec3(0.5, 0.0, 0.0), glm::dvec3(0.25, -2.0, 0.0), glm::dvec3(1.0, 0.5, 4.0))};
}

TEST(Lattice, NamesAreParsedBack) {
  for (const LatticeKind kind : {LatticeKind::bcc, LatticeKind::cartesian}) {
    EXPECT_EQ(parse_lattice(lattice_name(kind), "--lattice"), kind);
  }
}

TEST(Lattice, AnUnknownNameIsRefusedNamingTheFlagAndTheChoices) {
  try {
    parse_lattice("BCC", "--lattice");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("--lattice"), testing::HasSubstr("'BCC'"),
                                             testing::HasSubstr("bcc or cartesian")));
  }
}

TEST(Lattice, ANameOfSeveralLinesIsRefusedInOne) {
  // As the key/value of a header may hold, whose newlines are written \\n.
  try {
    parse_lattice("bcc\n\x1b[2J" + std::string(1000, 'x'), "v.nrrd");
    FAIL();
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find_first_of("\n\x1b"), std::string::npos) << message;
    EXPECT_LT(message.size(), 200u);
  }
}

TEST(Lattice, TheDomainEndsAtTheLastOddPointOfBccAndAtTheLastVoxelOfCartesian) {
  // The odd coset's last point is 2(n-1)+1.
  EXPECT_EQ(domain_max(LatticeKind::bcc, {1, 2, 128}), glm::i64vec3(1, 3, 255));
  EXPECT_EQ(domain_max(LatticeKind::cartesian, {1, 2, 128}), glm::i64vec3(0, 1, 127));
  for (const LatticeKind kind : {LatticeKind::bcc, LatticeKind::cartesian}) {
    const Extents n(3, 4, 5);
    const std::int64_t last = coset_count(kind) - 1;
    EXPECT_EQ(domain_max(kind, n), std::int64_t(lattice_step(kind)) * (n - std::int64_t(1)) + last);
  }
}

TEST(World, ColumnsOfTheAxesAreTheStepsOfTheCoordinates) {
  const World world = sheared_world();
  EXPECT_EQ(world.to_world({0, 0, 0}), world.origin);
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 u(0.0);
    u[axis] = 1.0;
    EXPECT_EQ(world.to_world(u) - world.origin, world.axes[axis]);
  }
  EXPECT_EQ(world.to_world({1, 2, 3}), glm::dvec3(10 + 0.5 + 0.5 + 3, -20 - 4 + 1.5, 0.5 + 12));
}

TEST(World, ToLatticeUndoesToWorldInAShearedWorld) {
  const World world = sheared_world();
  for (const glm::dvec3 u : {glm::dvec3(0, 0, 0), glm::dvec3(1.25, -3, 7.5), glm::dvec3(100, 200, 300)}) {
    EXPECT_LT(glm::length(world.to_lattice(world.to_world(u)) - u), 1e-12);
  }
}

TEST(World, GradientsFollowTheInverseTranspose) {
  // f(x) = g . x in the world has the lattice gradient axes^T g.
  const World world = sheared_world();
  const glm::dvec3 g(3.0, -1.0, 0.25);
  const glm::dvec3 per_coordinate = glm::transpose(world.axes) * g;
  EXPECT_LT(glm::length(world.gradient_to_world(per_coordinate) - g), 1e-14);
  // The wrong rule, by the axes themselves, is far off in this world.
  EXPECT_GT(glm::length(world.axes * per_coordinate - g), 1.0);
}

TEST(Cells, FillTheDomainAndAreOneAlongACartesianAxisOfOneSample) {
  EXPECT_EQ(cell_count(LatticeKind::bcc, {1, 2, 128}), glm::i64vec3(1, 3, 255));
  EXPECT_EQ(cell_count(LatticeKind::cartesian, {1, 2, 128}), glm::i64vec3(1, 1, 127));
}

TEST(CellOf, HasACellForEveryPointOfTheClosedDomain) {
  EXPECT_EQ(cell_of({0.0, 0.0, 0.0}, {1, 3, 5}), glm::ivec3(0));
  EXPECT_EQ(cell_of({1.0, 3.0, 5.0}, {1, 3, 5}), glm::ivec3(0, 2, 4));
  EXPECT_EQ(cell_of({0.5, 2.0, 4.999}, {1, 3, 5}), glm::ivec3(0, 2, 4));
  EXPECT_EQ(cell_of({0.0, 0.0, 5.0}, {0, 0, 5}), glm::ivec3(0, 0, 4));
}

}  // namespace
}  // namespace quincunx
