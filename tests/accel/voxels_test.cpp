#include "accel/voxels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "accel/particles.h"
#include "accel/volume_voxels.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

Volume volume_of(LatticeKind lattice, const Extents& n, const std::function<double(const glm::dvec3&)>& f, const World& world = {}) {
  Volume volume{lattice, n, world, {}, {}};
  std::vector<float> samples;
  for (int c = 0; c < coset_count(lattice); ++c)
    for (int k = 0; k < n.z; ++k)
      for (int j = 0; j < n.y; ++j)
        for (int i = 0; i < n.x; ++i) samples.push_back(float(f(double(lattice_step(lattice)) * glm::dvec3(i, j, k) + double(c))));
  volume.samples = std::move(samples);
  return volume;
}

double volume_of_box(const VoxelBox& box) {
  const glm::dvec3 size = box.high - box.low;
  return size.x * size.y * size.z;
}

/// How many voxels hold the point, and the last of them.
int voxels_at(const Voxels& voxels, const glm::dvec3& u, std::size_t* which = nullptr) {
  int count = 0;
  for (std::size_t n = 0; n < voxels.size(); ++n) {
    const VoxelBox box = voxels.box(n);
    if (glm::any(glm::lessThan(u, box.low)) || glm::any(glm::greaterThanEqual(u, box.high))) continue;
    ++count;
    if (which) *which = n;
  }
  return count;
}

TEST(VoxelData, IsReadAsWhatItWasToWithinHalfAStep) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const VoxelScale scale{-20.0, 300.0, 8.0};
  for (int n = 0; n < 20000; ++n) {
    const double density = scale.low + 320.0 * uniform(random), magnitude = scale.steepest * uniform(random);
    const glm::dvec3 direction = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    const VoxelLook look = unpack(pack(VoxelShape::cuboid, density, magnitude * direction, scale), scale);
    EXPECT_NEAR(scale.density(look.density), density, 0.5 * 320.0 / 65535.0 * 1.0001);
    EXPECT_NEAR(look.magnitude, magnitude, std::max(0.5, magnitude < 0.5 * scale.steepest / 16383.0 ? 1.0 : 0.0) * scale.steepest / 16383.0 * 1.0001);
    // Half a step, 1/65534, of either coordinate; the octahedron's map stretches by at most 3.
    EXPECT_LT(glm::length(look.direction - direction), 3.0 * std::sqrt(2.0) / 65534.0);
  }
}

TEST(VoxelData, KeepsTheEndsAndDirectionsOfTheAxesExactly) {
  const VoxelScale scale{0.0, 255.0, 2.0};
  for (int value = 0; value <= 255; ++value) EXPECT_EQ(scale.density(unpack(pack(VoxelShape::cuboid, value, glm::dvec3(0.0), scale), scale).density), double(value));
  for (int a = 0; a < 3; ++a)
    for (const double sign : {-1.0, 1.0}) {
      glm::dvec3 axis(0.0);
      axis[a] = sign;
      const VoxelLook look = unpack(pack(VoxelShape::cuboid, 1.0, 2.0 * axis, scale), scale);
      EXPECT_EQ(look.direction, axis);
      EXPECT_EQ(look.magnitude, 2.0);
    }
}

TEST(VoxelData, TellsNoGradientFromAWeakOne) {
  const VoxelScale scale{0.0, 1.0, 1.0};
  EXPECT_EQ(unpack(pack(VoxelShape::cuboid, 0.0, glm::dvec3(0.0), scale), scale).direction, glm::dvec3(0.0));
  EXPECT_EQ(unpack(pack(VoxelShape::cuboid, 0.0, {0.0, 1e-200, 0.0}, scale), scale).direction, glm::dvec3(0.0, 1.0, 0.0));
}

TEST(VoxelData, HasTheLayoutThatIsWritten) {
  const VoxelScale scale{0.0, 65535.0, 16383.0};
  const VoxelData data = pack(VoxelShape::sphere, 0x1234, glm::dvec3(5.0, 0.0, 0.0), scale);
  EXPECT_EQ(data.words[0], 1u | 0x1234u << 2 | 5u << 18);
  EXPECT_EQ(data.words[1], 65534u | 32767u << 16);
}

TEST(VolumeVoxels, FillSpaceWithoutOverlappingOnBothLattices) {
  std::mt19937 random(2);
  for (const LatticeKind lattice : {LatticeKind::cartesian, LatticeKind::bcc}) {
    for (const bool merged : {false, true}) {
      const Volume volume = volume_of(lattice, {6, 5, 7}, [](const glm::dvec3& u) { return u.x < 3.0 ? 7.0 : u.y; });
      VoxelConfig config;
      if (merged) config.deviation = 0.0;
      const Voxels voxels = volume_voxels(volume, config);
      double sum = 0.0;
      for (std::size_t n = 0; n < voxels.size(); ++n) sum += volume_of_box(voxels.box(n));
      EXPECT_EQ(sum, double(volume.sample_count()) * (lattice == LatticeKind::bcc ? 4.0 : 1.0));
      const glm::dvec3 far(domain_max(lattice, volume.extents));
      std::uniform_real_distribution<double> uniform(0.0, 1.0);
      for (int n = 0; n < 2000; ++n) {
        const glm::dvec3 u = far * glm::dvec3(uniform(random), uniform(random), uniform(random));
        EXPECT_EQ(voxels_at(voxels, u), 1) << u.x << " " << u.y << " " << u.z;
      }
    }
  }
}

TEST(VolumeVoxels, AreAboutTheirSamplesAndHoldTheirValues) {
  for (const LatticeKind lattice : {LatticeKind::cartesian, LatticeKind::bcc}) {
    const auto f = [](const glm::dvec3& u) { return u.x + 16.0 * u.y + 256.0 * u.z; };
    const Volume volume = volume_of(lattice, {4, 4, 4}, f);
    const Voxels voxels = volume_voxels(volume, {});
    ASSERT_EQ(voxels.size(), volume.sample_count());
    for (std::size_t n = 0; n < voxels.size(); ++n) {
      const VoxelBox box = voxels.box(n);
      const VoxelLook look = unpack(voxels.data[n], voxels.scale);
      EXPECT_NEAR(voxels.scale.density(look.density), f(0.5 * (box.low + box.high)), 0.05);
      EXPECT_LT(glm::length(look.magnitude * look.direction - glm::dvec3(1.0, 16.0, 256.0)), 0.05);
    }
  }
}

TEST(VolumeVoxels, HaveGradientsOfTheWorld) {
  World world;
  world.axes = glm::dmat3(2.0, 0.0, 0.0, 0.5, 3.0, 0.0, 0.0, 0.25, 1.5);
  const glm::dvec3 slope(3.0, -1.0, 2.0);
  const Volume volume = volume_of(LatticeKind::cartesian, {4, 4, 4}, [&](const glm::dvec3& u) { return glm::dot(slope, world.to_world(u)); }, world);
  const Voxels voxels = volume_voxels(volume, {});
  for (const VoxelData& data : voxels.data) {
    const VoxelLook look = unpack(data, voxels.scale);
    EXPECT_LT(glm::length(look.magnitude * look.direction - slope), 1e-3);
  }
}

TEST(VolumeVoxels, LeaveOutWhatIsBelowTheMinimumOrNotFinite) {
  Volume volume = volume_of(LatticeKind::cartesian, {4, 3, 2}, [](const glm::dvec3& u) { return u.x; });
  std::get<std::vector<float>>(volume.samples)[3] = NAN;
  const Voxels voxels = volume_voxels(volume, {.minimum = 2.0, .deviation = {}});
  EXPECT_EQ(voxels.size(), 2u * 6u - 1u);
  EXPECT_EQ(voxels.scale.low, 2.0);
  EXPECT_EQ(voxels.scale.high, 3.0);
  EXPECT_EQ(voxels.samples, 24u);
  EXPECT_TRUE(volume_voxels(volume, {.minimum = 4.0, .deviation = {}}).data.empty());
}

TEST(VolumeVoxels, MergeWhereNoSampleDiffersFromTheMeanByMore) {
  // Eight alike but one: their mean is 1/8 off, and that one 7/8.
  const Volume volume = volume_of(LatticeKind::cartesian, {4, 4, 4}, [](const glm::dvec3& u) { return u == glm::dvec3(0.0) ? 1.0 : 0.0; });
  const auto voxels_of = [&](double deviation) { return volume_voxels(volume, {.minimum = 0.0, .deviation = deviation}); };
  EXPECT_EQ(voxels_of(0.0).size(), 8u + 7u);  // the alike cubes of 2^3, and one that is not
  EXPECT_EQ(voxels_of(0.874).size(), 8u + 7u);
  EXPECT_EQ(voxels_of(0.875).size(), 8u);     // 4^3 has a mean of 1/64, and 63/64 is too far
  EXPECT_EQ(voxels_of(0.985).size(), 1u);
  const Voxels one = voxels_of(0.985);
  EXPECT_EQ(one.scale.low, 1.0 / 64.0);
  EXPECT_EQ(one.box(0).low, glm::dvec3(-0.5));
  EXPECT_EQ(one.box(0).high, glm::dvec3(3.5));
}

TEST(VolumeVoxels, DoNotMergeWhereASiblingIsMissing) {
  const Volume odd = volume_of(LatticeKind::cartesian, {3, 4, 4}, [](const glm::dvec3&) { return 1.0; });
  EXPECT_EQ(volume_voxels(odd, {.minimum = 0.0, .deviation = 1.0}).size(), 4u + 16u);  // cubes of 2^3 in the first two columns, single ones in the third
  const Volume holed = volume_of(LatticeKind::cartesian, {2, 2, 2}, [](const glm::dvec3& u) { return u == glm::dvec3(1.0) ? 0.0 : 1.0; });
  EXPECT_EQ(volume_voxels(holed, {.minimum = 0.5, .deviation = 1.0}).size(), 7u);
}

TEST(VolumeVoxels, OfTheBccLatticeMergeInTheLayersOfACoset) {
  const Volume volume = volume_of(LatticeKind::bcc, {4, 4, 3}, [](const glm::dvec3&) { return 1.0; });
  const Voxels voxels = volume_voxels(volume, {.minimum = 0.0, .deviation = 0.0});
  ASSERT_EQ(voxels.size(), 2u * 3u);
  for (std::size_t n = 0; n < voxels.size(); ++n) {
    const VoxelBox box = voxels.box(n);
    EXPECT_EQ(box.high - box.low, glm::dvec3(8.0, 8.0, 1.0));
  }
}

TEST(VolumeVoxels, RefuseVolumesOfMoreThan16BitsOfHalfCells) {
  const auto long_one = [](std::int64_t n) { return volume_of(LatticeKind::cartesian, {n, 1, 1}, [](const glm::dvec3&) { return 1.0; }); };
  const Voxels last = volume_voxels(long_one(32767), {});
  EXPECT_EQ(last.box(last.size() - 1).high.x, 32766.5);
  EXPECT_THROW(volume_voxels(long_one(32768), {}), InputError);
}

TEST(ParticleVoxels, LieInTheirBox) {
  const std::vector<Particle> particles{{{0.0, 0.0, 0.0}, 0.5, 1.0}, {{10.0, -3.0, 2.0}, 2.0, 5.0}};
  const Voxels voxels = particle_voxels(particles, "p.csv");
  ASSERT_EQ(voxels.size(), 2u);
  EXPECT_EQ(voxels.unit, 2.0);
  const glm::dvec3 far(domain_max(voxels.lattice, voxels.extents));
  for (std::size_t n = 0; n < 2; ++n) {
    const VoxelBox box = voxels.box(n);
    EXPECT_TRUE(glm::all(glm::greaterThanEqual(box.low, glm::dvec3(0.0)))) << n;
    EXPECT_TRUE(glm::all(glm::lessThanEqual(box.high, far))) << n;
    const glm::dvec3 centre = voxels.world.to_world(0.5 * (box.low + box.high));
    EXPECT_LT(glm::length(centre - particles[n].centre), 1e-5);
    EXPECT_NEAR(0.5 * (box.high.x - box.low.x) * voxels.world.axes[0].x, particles[n].radius, 1e-5);
    EXPECT_EQ(voxels.scale.density(unpack(voxels.data[n], voxels.scale).density), particles[n].density);
  }
}

TEST(ParticleVoxels, RefuseWhatIsNoSphere) {
  const auto refusal = [](const std::vector<Particle>& particles) -> std::string {
    try {
      particle_voxels(particles, "p.csv");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refusal({}), testing::HasSubstr("p.csv: found no particle"));
  EXPECT_THAT(refusal({{{0, 0, 0}, 1.0, 0.0}, {{0, 0, 0}, 0.0, 0.0}}), testing::HasSubstr("radius 0 of particle 2"));
  EXPECT_THAT(refusal({{{0, 0, 0}, 1.0, 0.0}, {{1e6, 0, 0}, 1.0, 0.0}}), testing::HasSubstr("65535"));
  EXPECT_THAT(refusal({{{1e300, 0, 0}, 1.0, 0.0}}), testing::HasSubstr("not finite"));
}

}  // namespace
}  // namespace quincunx
