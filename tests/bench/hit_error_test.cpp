#include "bench/hit_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lattice/field.h"

namespace quincunx {
namespace {

/// A sphere seen from the front, its reference, and a copy of that to be spoilt.
class HitErrorTest : public testing::Test {
 protected:
  HitErrorTest() {
    scene.isosurfaces = {Isosurface{.isovalue = 0.0}};
    scene.width = scene.height = 32;
    scene.camera = framing_camera(volume.lattice, volume.extents, volume.world, {}, 32, 32);
    reference = truth.frame(scene);
    frame = reference;
  }

  HitErrors errors() const {
    HitComparison comparison;
    comparison.add(truth, scene, frame, reference);
    return comparison.errors();
  }
  /// World units per cell along every ray: the lattice's steps are equal and at right angles.
  double cell() const { return volume.world.axes[0][0]; }
  static constexpr std::size_t kCentre = 16 * 32 + 16, kCorner = 0;

  const Volume volume = sample_field(*make_field("sphere"), LatticeKind::bcc, {12, 12, 12});
  const Truth truth{volume};
  Scene scene;
  Frame reference, frame;
};

TEST_F(HitErrorTest, IsNothingForTheReferenceItselfButItsRoundingToFloat) {
  const HitErrors e = errors();
  EXPECT_GT(e.expected, 250u);
  EXPECT_LT(e.expected, 32u * 32u);
  EXPECT_EQ(e.missed + e.false_hits + e.wrong_sheet, 0u);
  EXPECT_EQ(e.depth_rms, 0.0);
  EXPECT_EQ(e.normal_rms, 0.0);
  // The eye is some 60 cells away: half an ulp of the depth.
  EXPECT_GT(e.residual_max, 0.0);
  EXPECT_LT(e.residual_max, 4e-6);
}

TEST_F(HitErrorTest, CountsMissedFalseAndStrayHitsApart) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  ASSERT_TRUE(std::isfinite(reference.depth[kCentre]));
  ASSERT_FALSE(std::isfinite(reference.depth[kCorner]));
  frame.depth[kCentre] = inf;
  frame.depth[kCentre + 1] = inf;
  frame.depth[kCorner] = reference.depth[kCentre];
  for (std::size_t p = kCentre + 2; p < kCentre + 5; ++p) frame.depth[p] += float(0.6 * cell());
  const HitErrors e = errors();
  EXPECT_EQ(e.missed, 2u);
  EXPECT_EQ(e.false_hits, 1u);
  EXPECT_EQ(e.wrong_sheet, 3u);
  EXPECT_EQ(e.depth_rms, 0.0);  // strays are no part of it
  EXPECT_GT(e.residual_max, 0.1);
}

TEST_F(HitErrorTest, MeasuresDepthInCellsAndNormalsInDegrees) {
  for (float& depth : frame.depth) depth += float(0.25 * cell());
  // Turned by 10 degrees about an axis at right angles to each normal.
  constexpr double ten = 10.0 * M_PI / 180.0;
  for (std::size_t p = 0; p < frame.depth.size(); ++p) {
    glm::dvec3 n(frame.normal[3 * p], frame.normal[3 * p + 1], frame.normal[3 * p + 2]);
    if (glm::length(n) == 0.0) continue;
    const glm::dvec3 aside = glm::normalize(glm::cross(n, glm::dvec3(0.3, 0.5, 0.7)));
    n = std::cos(ten) * n + std::sin(ten) * aside;
    for (int a = 0; a < 3; ++a) frame.normal[3 * p + std::size_t(a)] = float(n[a]);
  }
  const HitErrors e = errors();
  EXPECT_EQ(e.wrong_sheet, 0u);
  EXPECT_NEAR(e.depth_rms, 0.25, 1e-5);
  EXPECT_NEAR(e.depth_p99, 0.25, 1e-5);
  EXPECT_NEAR(e.normal_rms, 10.0, 1e-3);
  // The surface is no farther than along the ray; where the ray meets it head on, about as far.
  EXPECT_NEAR(e.residual_max, 0.25, 0.02);
}

TEST_F(HitErrorTest, GathersViews) {
  frame.depth[kCentre] = std::numeric_limits<float>::infinity();
  HitComparison comparison;
  comparison.add(truth, scene, frame, reference);
  comparison.add(truth, scene, frame, reference);
  EXPECT_EQ(comparison.errors().missed, 2u);
  EXPECT_EQ(comparison.errors().expected, 2 * errors().expected);
}

}  // namespace
}  // namespace quincunx
