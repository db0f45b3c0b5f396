#include "lattice/target_grid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lattice/error.h"

namespace quincunx {
namespace {

const World kSheared{{1.5, -2.0, 8.0}, glm::dmat3(glm::dvec3(0.5, 0.25, 0.0), glm::dvec3(0.0, -2.0, 0.5), glm::dvec3(1.0, 0.0, 4.0))};

Volume source(LatticeKind lattice, const Extents& n) { return {lattice, n, kSheared, std::vector<float>{}, {}}; }

glm::dvec3 far_corner(LatticeKind lattice, const Extents& n, const World& world) { return world.to_world(glm::dvec3(domain_max(lattice, n))); }

TEST(TargetGrid, OfExtentsSpansTheSameDomain) {
  for (const LatticeKind from : {LatticeKind::cartesian, LatticeKind::bcc})
    for (const LatticeKind to : {LatticeKind::cartesian, LatticeKind::bcc}) {
      const Volume volume = source(from, {9, 8, 7});
      const TargetGrid grid = grid_of_extents(volume, to, {5, 13, 20});
      EXPECT_EQ(grid.lattice, to);
      EXPECT_EQ(grid.extents, Extents(5, 13, 20));
      EXPECT_EQ(grid.world.origin, kSheared.origin);
      EXPECT_LT(glm::distance(far_corner(to, grid.extents, grid.world), far_corner(from, volume.extents, kSheared)), 1e-12);
      for (int a = 0; a < 3; ++a) EXPECT_LT(glm::length(glm::cross(grid.world.axes[a], kSheared.axes[a])), 1e-12);
    }
  EXPECT_THROW(grid_of_extents(source(LatticeKind::cartesian, {4, 4, 1}), LatticeKind::cartesian, {4, 4, 2}), InputError);
  EXPECT_THROW(grid_of_extents(source(LatticeKind::cartesian, {4, 4, 1}), LatticeKind::bcc, {4, 4, 1}), InputError);
  EXPECT_EQ(grid_of_extents(source(LatticeKind::cartesian, {4, 4, 1}), LatticeKind::cartesian, {7, 2, 1}).extents, Extents(7, 2, 1));
}

TEST(TargetGrid, OfASpacingHoldsWhatFitsInTheDomain) {
  // Edges of 8, 7 and 6 cells: 4.472, 14.43 and 24.74 world units.
  const Volume volume = source(LatticeKind::cartesian, {9, 8, 7});
  const TargetGrid cartesian = grid_of_spacing(volume, LatticeKind::cartesian, 1.0);
  EXPECT_EQ(cartesian.extents, Extents(5, 15, 25));
  const TargetGrid bcc = grid_of_spacing(volume, LatticeKind::bcc, 2.0);
  EXPECT_EQ(bcc.extents, Extents(2, 7, 12));  // cells of 1: up to 3, 13, 23
  for (int a = 0; a < 3; ++a) {
    EXPECT_NEAR(glm::length(cartesian.world.axes[a]), 1.0, 1e-12);
    EXPECT_NEAR(glm::length(bcc.world.axes[a]), 1.0, 1e-12);
  }
  // The source's own step, rounded as it may be, holds the source's own samples.
  const Volume cubes{LatticeKind::cartesian, {31, 41, 51}, {{}, glm::dmat3(0.1)}, std::vector<float>{}, {}};
  EXPECT_EQ(grid_of_spacing(cubes, LatticeKind::cartesian, 0.1).extents, cubes.extents);
  EXPECT_EQ(grid_of_spacing(cubes, LatticeKind::cartesian, 0.3).extents, Extents(11, 14, 17));
  EXPECT_EQ(grid_of_spacing(cubes, LatticeKind::bcc, 6.0).extents, Extents(1, 1, 1));
  EXPECT_THROW(grid_of_spacing(cubes, LatticeKind::bcc, 6.1), InputError);
}

TEST(TargetGrid, OfACountHasAboutSoManySamplesInCellsOfTheSameShape) {
  for (const LatticeKind from : {LatticeKind::cartesian, LatticeKind::bcc})
    for (const LatticeKind to : {LatticeKind::cartesian, LatticeKind::bcc})
      for (const double count : {1e4, 1e6, 3e7}) {
        const Volume volume = source(from, {100, 90, 120});
        const TargetGrid grid = grid_of_count(volume, to, std::uint64_t(count));
        const double found = double(coset_count(to) * grid.extents.x * grid.extents.y * grid.extents.z);
        EXPECT_NEAR(found / count, 1.0, 0.06);
        EXPECT_LT(glm::distance(far_corner(to, grid.extents, grid.world), far_corner(from, volume.extents, kSheared)), 1e-9);
        const glm::dvec3 steps = relative_steps(grid, kSheared);
        for (int a = 0; a < 3; ++a) EXPECT_NEAR(steps[a] / steps.x, 1.0, 0.06);
      }
  // As many samples: BCC cells are 4^-1/3 of Cartesian ones.
  const Volume volume = source(LatticeKind::cartesian, {200, 200, 200});
  EXPECT_NEAR(relative_steps(grid_of_count(volume, LatticeKind::bcc, 8000000), kSheared).x, std::cbrt(0.25), 0.01);
  EXPECT_EQ(grid_of_count(volume, LatticeKind::cartesian, 8000000).extents, volume.extents);
  EXPECT_EQ(grid_of_count(source(LatticeKind::cartesian, {64, 64, 1}), LatticeKind::cartesian, 1024).extents, Extents(32, 32, 1));
}

}  // namespace
}  // namespace quincunx
