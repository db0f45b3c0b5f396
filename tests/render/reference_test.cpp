#include "render/reference.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "accel/bounds.h"
#include "lattice/error.h"
#include "render/shading.h"
#include "same_picture.h"
#include "volumes.h"

namespace quincunx {
namespace {

const float kNoHit = std::numeric_limits<float>::infinity();

/// A small smooth volume with several sheets.
Volume waves(const Extents& n, const World& world = {}) {
  return bcc_volume(
      n, [](const glm::dvec3& u) { return std::sin(0.4 * u.x) * std::cos(0.3 * u.y) + std::sin(0.5 * u.z); }, world);
}

/// f = x in lattice coordinates: bcc7 reproduces it away from the border.
Volume ramp(const World& world = {}) {
  return bcc_volume({10, 8, 8}, [](const glm::dvec3& u) { return u.x; }, world);
}

Scene scene_of(const Volume& volume, std::vector<Isosurface> surfaces, const Orbit& orbit = {30.0, 15.0, 1.0},
               int size = 48) {
  Scene scene;
  scene.isosurfaces = std::move(surfaces);
  scene.width = scene.height = size;
  scene.camera = framing_camera(volume.lattice, volume.extents, volume.world, orbit, size, size);
  return scene;
}

Frame render(const Sampled& sampled, const Scene& scene, const CellBounds* cells = nullptr) {
  return render_reference(*sampled.spline, sampled.coefficients, scene, cells);
}

int hits(const Frame& frame) {
  return int(std::count_if(frame.depth.begin(), frame.depth.end(), [](float z) { return std::isfinite(z); }));
}

TEST(Reference, CompositesSeveralSurfacesAsComputedByHand) {
  // Along +x through the planes f = 5, 9, 12, of opacities 1/4, 1/2 and 1, one pixel, head-on: no shading but colour.
  const Sampled volume(ramp());
  Scene scene;
  scene.width = scene.height = 1;
  scene.camera = {{-3.0, 7.0, 7.3}, {0.0, 7.0, 7.3}, {0.0, 0.0, 1.0}, 10.0};
  scene.background = {0.0, 0.0, 0.5};
  const Isosurface red{5.0, {1.0, 0.0, 0.0}, 0.25}, green{9.0, {0.0, 1.0, 0.0}, 0.5}, blue{12.0, {0.0, 0.0, 1.0}, 1.0};

  scene.isosurfaces = {green, blue, red};
  const Frame three = render(volume, scene);
  EXPECT_THAT(three.color, ::testing::Pointwise(::testing::FloatNear(1e-6f), {0.25f, 0.375f, 0.375f, 1.0f}));
  EXPECT_NEAR(three.depth[0], 8.0f, 1e-6f);
  EXPECT_THAT(three.normal, ::testing::Pointwise(::testing::FloatNear(1e-6f), {-1.0f, 0.0f, 0.0f}));

  scene.isosurfaces = {red, green};
  const Frame two = render(volume, scene);
  EXPECT_THAT(two.color, ::testing::Pointwise(::testing::FloatNear(1e-6f), {0.25f, 0.375f, 0.375f * 0.5f, 0.625f}));

  // From the other side the order turns round.
  scene.isosurfaces = {red, green, blue};
  scene.camera.eye.x = 30.0;
  scene.isosurfaces[2].opacity = 0.5;
  const Frame back = render(volume, scene);
  EXPECT_THAT(back.color, ::testing::Pointwise(::testing::FloatNear(1e-6f),
                                               {0.0625f, 0.25f, 0.5f + 0.1875f * 0.5f, 0.8125f}));
  EXPECT_NEAR(back.depth[0], 18.0f, 1e-6f);
}

TEST(Reference, ASurfaceOfOpacityZeroLeavesNoTrace) {
  const Volume waves_volume = waves({8, 8, 8});
  const Sampled volume(waves_volume);
  const Isosurface seen{0.3, {1.0, 0.5, 0.2}, 0.6}, ghost{-0.2, {0.0, 1.0, 0.0}, 0.0};
  const Frame one = render(volume, scene_of(waves_volume, {seen}));
  const Frame both = render(volume, scene_of(waves_volume, {ghost, seen}));
  EXPECT_GT(hits(one), 500);
  EXPECT_EQ(one.color, both.color);
  EXPECT_EQ(one.depth, both.depth);
  EXPECT_EQ(hits(render(volume, scene_of(waves_volume, {ghost}))), 0);
}

TEST(Reference, WhereNothingIsHitTheBackgroundShows) {
  const Volume waves_volume = waves({6, 6, 6});
  Scene scene = scene_of(waves_volume, {{100.0}});
  scene.background = {0.1, 0.2, 0.3};
  const Frame frame = render(Sampled(waves_volume), scene);
  for (std::size_t p = 0; p < frame.depth.size(); ++p) {
    EXPECT_EQ(frame.depth[p], kNoHit);
    EXPECT_EQ(frame.color[4 * p], 0.1f);
    EXPECT_EQ(frame.color[4 * p + 2], 0.3f);
    EXPECT_EQ(frame.color[4 * p + 3], 0.0f);
    EXPECT_EQ(frame.normal[3 * p], 0.0f);
  }
  EXPECT_TRUE(frame.cost.empty());
}

TEST(Reference, DepthAndNormalAreThoseOfASphereInASquashedLeftHandedWorld) {
  // A ball in lattice coordinates is an ellipsoid |A^-1 (x - m)| = r in this world.
  World world;
  world.origin = {3.0, -8.0, 1.0};
  world.axes = glm::dmat3(glm::dvec3(-0.5, 0.0, 0.0), glm::dvec3(0.2, 1.0, 0.0), glm::dvec3(0.0, 0.3, 2.0));
  const glm::dvec3 centre(11.5);
  const double r = 5.5;
  const Volume volume = bcc_volume(
      {12, 12, 12}, [&](const glm::dvec3& u) { return r * r - glm::dot(u - centre, u - centre); }, world);
  const Sampled sampled(volume);
  const Scene scene = scene_of(volume, {{0.0, {1.0, 1.0, 1.0}, 1.0}}, {35.0, 25.0, 2.2}, 64);
  const Frame frame = render(sampled, scene);
  const CameraFrame camera = camera_frame(scene.camera, 64, 64);
  const glm::dmat3 inverse = glm::inverse(world.axes);
  int compared = 0;
  for (int j = 0; j < 64; ++j)
    for (int i = 0; i < 64; ++i) {
      const std::size_t p = 64 * j + i;
      const glm::dvec3 d = pixel_direction(camera, 64, 64, i, j);
      const glm::dvec3 o = inverse * (scene.camera.eye - world.to_world(centre)), e = inverse * d;
      const double b = glm::dot(o, e) / glm::dot(e, e), q = (glm::dot(o, o) - r * r) / glm::dot(e, e);
      ASSERT_EQ(std::isfinite(frame.depth[p]), b * b >= q) << i << " " << j;
      if (b * b < q) continue;
      const double t = -b - std::sqrt(b * b - q);
      EXPECT_NEAR(frame.depth[p], t, 1e-6 * t);
      glm::dvec3 n = glm::normalize(glm::transpose(inverse) * (o + t * e));
      if (glm::dot(n, d) > 0.0) n = -n;
      for (int a = 0; a < 3; ++a) EXPECT_NEAR(frame.normal[3 * p + a], n[a], 2e-6);
      EXPECT_NEAR(frame.color[4 * p], 0.2 + 0.8 * -glm::dot(n, d), 2e-6);
      EXPECT_EQ(frame.color[4 * p + 3], 1.0f);
      ++compared;
    }
  EXPECT_GT(compared, 800);
}

TEST(Reference, ShowsTheImageUprightAndNotMirrored) {
  // Balls at +x and at +z of the centre, seen along +y: x is on the right, z at the top.
  const auto ball_at = [](const glm::dvec3& centre) {
    const Volume volume = bcc_volume({12, 12, 12}, [&](const glm::dvec3& u) { return 5.0 - glm::length(u - centre); });
    const Frame frame = render(Sampled(volume), scene_of(volume, {{2.0}}, {0.0, 0.0, 1.0}, 33));
    glm::dvec2 sum(0.0);
    for (int p = 0; p < 33 * 33; ++p)
      if (std::isfinite(frame.depth[p])) sum += glm::dvec2(p % 33, p / 33);
    return sum / double(hits(frame));
  };
  EXPECT_GT(ball_at({17.0, 11.5, 11.5}).x, 20.0);
  EXPECT_NEAR(ball_at({17.0, 11.5, 11.5}).y, 16.0, 1.0);
  EXPECT_LT(ball_at({11.5, 11.5, 17.0}).y, 12.0);
  EXPECT_NEAR(ball_at({11.5, 11.5, 17.0}).x, 16.0, 1.0);
}

TEST(Reference, SkippingCellsChangesNoBit) {
  World skew;
  skew.axes = glm::dmat3(glm::dvec3(0.5, 0.1, 0.0), glm::dvec3(0.0, 0.7, 0.2), glm::dvec3(-0.3, 0.0, 1.1));
  for (const Volume& volume : {waves({12, 9, 10}, skew), random_volume({8, 8, 8}, 31), ramp(),
                               bcc_volume({6, 6, 6}, [](const glm::dvec3& u) { return u.x < 5.0 ? 0.0 : 1.0; })}) {
    const Sampled sampled(volume);
    const CellBounds bounds = cell_bounds(
        *sampled.spline, sampled.spline->coefficients_float(volume, Spline::Prefilter::automatic));
    for (const Intersect intersect : {Intersect::exact, Intersect::march})
      for (const auto& surfaces : {std::vector<Isosurface>{{0.5, {1.0, 0.9, 0.8}, 1.0}},
                                   {{0.75, {1.0, 0.0, 0.0}, 0.3}, {0.25, {0.0, 1.0, 0.0}, 0.4}, {1.0, {}, 0.5}}}) {
        Scene scene = scene_of(volume, surfaces, {40.0, 20.0, 1.2}, 40);
        scene.intersect = intersect;
        scene.cost = true;
        const Frame all = render(sampled, scene), skipped = render(sampled, scene, &bounds);
        expect_same_picture(all, skipped);
        EXPECT_GT(hits(all), 100);
        double looked = 0.0, skipping = 0.0;
        for (std::size_t p = 0; p < all.depth.size(); ++p) {
          looked += all.cost[3 * p];
          skipping += skipped.cost[3 * p];
          EXPECT_EQ(all.cost[3 * p + 1], skipped.cost[3 * p + 1]) << "steps count what is skipped, too";
          EXPECT_LE(all.cost[3 * p + 2], 1.0f);
        }
        EXPECT_LT(skipping, looked);
      }
  }
}

TEST(Reference, SkippingFromAnEyeInsideChangesNoBit) {
  const Volume volume = random_volume({9, 9, 9}, 32);
  const Sampled sampled(volume);
  const CellBounds bounds = cell_bounds(
      *sampled.spline, sampled.spline->coefficients_float(volume, Spline::Prefilter::automatic));
  std::mt19937 random(33);
  std::uniform_real_distribution<double> inside(0.0, 17.0);
  for (int view = 0; view < 10; ++view) {
    Scene scene = scene_of(volume, {{0.6, {1.0, 0.9, 0.8}, 0.5}, {0.4, {0.2, 0.9, 0.8}, 0.5}}, {}, 24);
    // Some eyes on lattice points, some along knot planes.
    scene.camera.eye = {inside(random), inside(random), inside(random)};
    if (view % 2) scene.camera.eye = glm::round(scene.camera.eye);
    scene.camera.target = scene.camera.eye + glm::dvec3(1.0, view % 3 - 1, 0.0);
    scene.camera.up = {0.0, 0.0, 1.0};
    scene.camera.fov = 100.0;
    expect_same_picture(render(sampled, scene), render(sampled, scene, &bounds));
  }
}

TEST(Reference, AFineMarchFindsTheSurfacesOfTheExactCaster) {
  const Volume volume = waves({10, 10, 10});
  const Sampled sampled(volume);
  Scene scene = scene_of(volume, {{0.4, {1.0, 1.0, 1.0}, 1.0}});
  const Frame exact = render(sampled, scene);
  scene.intersect = Intersect::march;
  scene.step = 0.02;
  const Frame march = render(sampled, scene);
  int differ = 0;
  for (std::size_t p = 0; p < exact.depth.size(); ++p) {
    const bool both = std::isfinite(exact.depth[p]) && std::isfinite(march.depth[p]);
    if (both) {
      EXPECT_FLOAT_EQ(exact.depth[p], march.depth[p]);
    } else {
      differ += exact.depth[p] != march.depth[p];
    }
  }
  EXPECT_GT(hits(exact), 500);
  EXPECT_LE(differ, 2);
}

TEST(Reference, CentralDifferencesApproachTheAnalyticNormalsAsTheSquareOfDelta) {
  const Volume volume = waves({10, 10, 10});
  const Sampled sampled(volume);
  Scene scene = scene_of(volume, {{0.4, {1.0, 1.0, 1.0}, 1.0}});
  const Frame analytic = render(sampled, scene);
  scene.normal = Normal::central;
  const auto error = [&](double delta) {
    scene.delta = delta;
    const Frame central = render(sampled, scene);
    EXPECT_EQ(central.depth, analytic.depth);
    std::vector<double> errors;
    for (std::size_t i = 0; i < analytic.normal.size(); ++i)
      errors.push_back(std::abs(double(central.normal[i]) - analytic.normal[i]));
    std::sort(errors.begin(), errors.end());
    return errors[errors.size() * 9 / 10];
  };
  const double coarse = error(0.5), fine = error(0.125);
  EXPECT_LT(coarse, 0.05);
  EXPECT_GT(coarse / fine, 10.0);
}

TEST(Reference, LosesNothingFromAnEyeTenThousandSizesAway) {
  const Volume volume = waves({10, 10, 10});
  const Sampled sampled(volume);
  Scene scene = scene_of(volume, {{0.4, {1.0, 1.0, 1.0}, 1.0}});
  const glm::dvec3 back = glm::normalize(scene.camera.eye - scene.camera.target);
  scene.camera.eye = scene.camera.target + 1e4 * 19.0 * back;
  scene.camera.fov = 2.0 * std::atan(15.0 / (1e4 * 19.0)) * 180.0 / M_PI;
  const Frame far = render(sampled, scene);
  // From ten times nearer the rays are the same but for a perspective of 1 part in 1000.
  scene.camera.eye = scene.camera.target + 1e3 * 19.0 * back;
  scene.camera.fov = 2.0 * std::atan(15.0 / (1e3 * 19.0)) * 180.0 / M_PI;
  const Frame near = render(sampled, scene);
  int differ = 0;
  for (std::size_t p = 0; p < far.depth.size(); ++p) {
    differ += std::isfinite(far.depth[p]) != std::isfinite(near.depth[p]);
    for (int c = 0; c < 4; ++c) EXPECT_TRUE(std::isfinite(far.color[4 * p + c]));
  }
  EXPECT_GT(hits(far), 700);
  EXPECT_LT(differ, 20);
}

TEST(Reference, AnyViewAlongAxesAndPlanesHasNoHole) {
  // A box seen exactly along axes and diagonals from its lattice: rays in lattice planes, the middle row and column too.
  const glm::dvec3 centre(9.0, 9.0, 9.0);
  const Volume volume = bcc_volume({10, 10, 10}, [&](const glm::dvec3& u) { return 5.0 - glm::length(u - centre); });
  const Sampled sampled(volume);
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        Scene scene;
        scene.width = scene.height = 33;
        scene.isosurfaces = {{0.0, {1.0, 1.0, 1.0}, 1.0}};
        scene.camera.target = centre;
        scene.camera.eye = centre + 40.0 * glm::dvec3(x, y, z);
        scene.camera.up = x == 0 && y == 0 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
        scene.camera.fov = 2.0 * std::atan(4.0 / glm::length(40.0 * glm::dvec3(x, y, z))) * 180.0 / M_PI;
        const Frame frame = render(sampled, scene);
        for (int j = 0; j < 33; ++j)
          for (int i = 0; i < 33; ++i) {
            const bool on_ball = std::hypot(i - 16, j - 16) < 16;
            EXPECT_TRUE(!on_ball || std::isfinite(frame.depth[33 * j + i])) << i << " " << j;
          }
      }
}

TEST(Reference, AFlatGradientShowsTheSurfaceHeadOn) {
  // f = (x - 7)^3 passes 0 without a slope; its normal is undefined and looks at the viewer.
  const Volume volume = bcc_volume({8, 8, 8}, [](const glm::dvec3& u) { return std::pow(u.x - 7.0, 3.0); });
  Scene scene;
  scene.width = scene.height = 1;
  scene.isosurfaces = {{0.0, {1.0, 1.0, 1.0}, 1.0}};
  scene.camera = {{-5.0, 7.0, 7.0}, {0.0, 7.0, 7.0}, {0.0, 0.0, 1.0}, 5.0};
  const Frame frame = render(Sampled(volume), scene);
  EXPECT_NEAR(frame.depth[0], 12.0f, 1e-3f) << "a triple root: rounding has its cube root";
  EXPECT_NEAR(frame.normal[0], -1.0f, 1e-6f);
  EXPECT_NEAR(frame.color[0], 1.0f, 1e-6f);
}

TEST(Reference, CountsEvaluationsStepsAndIntervals) {
  const Volume volume = ramp();
  const Sampled sampled(volume);
  Scene scene;
  scene.width = scene.height = 1;
  scene.cost = true;
  scene.isosurfaces = {{9.5, {1.0, 1.0, 1.0}, 1.0}};
  scene.camera = {{-5.0, 7.2, 7.6}, {0.0, 7.2, 7.6}, {0.0, 0.0, 1.0}, 5.0};
  const Frame all = render(sampled, scene);
  EXPECT_EQ(all.cost[1], 10.0f) << "cells 0 to 9";
  EXPECT_EQ(all.cost[2], 1.0f);
  EXPECT_GE(all.cost[0], 20.0f) << "2 to 3 pieces a cell";
  EXPECT_LE(all.cost[0], 40.0f);
  const CellBounds bounds = cell_bounds(
      *sampled.spline, sampled.spline->coefficients_float(volume, Spline::Prefilter::automatic));
  const Frame skipped = render(sampled, scene, &bounds);
  EXPECT_EQ(skipped.cost[1], 10.0f);
  EXPECT_EQ(skipped.cost[2], 1.0f);
  EXPECT_LE(skipped.cost[0], 4.0f) << "the pieces of cell 9";
  scene.intersect = Intersect::march;
  scene.step = 0.5;
  const Frame march = render(sampled, scene);
  EXPECT_EQ(march.cost[1], 20.0f) << "samples at 0, 0.5 ... 9.5";
  EXPECT_GE(march.cost[0], 20.0f);
}

TEST(Reference, TellsItsProgressAndLetsAnInterruptThrough) {
  const Volume volume = waves({6, 6, 6});
  const Sampled sampled(volume);
  const Scene scene = scene_of(volume, {{0.3}}, {}, 400);
  std::vector<double> told;
  render_reference(*sampled.spline, sampled.coefficients, scene, nullptr, [&](double x) { told.push_back(x); });
  EXPECT_GT(told.size(), 3u);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(told.back(), 1.0);
  EXPECT_THROW(render_reference(*sampled.spline, sampled.coefficients, scene, nullptr,
                                [](double x) {
                                  if (x > 0.3) throw Interrupted();
                                }),
               Interrupted);
}

TEST(Reference, RefusesABadSceneBeforeItStarts) {
  const Volume volume = waves({6, 6, 6});
  const Sampled sampled(volume);
  Scene scene = scene_of(volume, {{0.3}});
  scene.isosurfaces.clear();
  EXPECT_THROW(render(sampled, scene), InputError);
}

TEST(Reference, VolumesOfOneSampleAnAxisAreRendered) {
  for (const Extents& n : {Extents(1, 5, 5), Extents(6, 1, 6), Extents(1, 1, 7), Extents(1, 1, 1)}) {
    const Volume volume = bcc_volume(n, [](const glm::dvec3& u) { return u.x + u.y + u.z; });
    const double middle = 0.5 * double(n.x + n.y + n.z) * 2.0 - 1.5;
    const Frame frame = render(Sampled(volume), scene_of(volume, {{middle}}));
    for (const float c : frame.color) EXPECT_TRUE(std::isfinite(c));
    // Two points, clamped, make a constant spline.
    EXPECT_TRUE(hits(frame) > 0 || n == Extents(1, 1, 1)) << n.x << " " << n.y << " " << n.z;
  }
}

}  // namespace
}  // namespace quincunx
