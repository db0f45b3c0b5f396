#include "bench/sweep_measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "accel/structure.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

constexpr double kIsovalue = 40.0, kMoved = 0.25;

/// A renderer that notes what it is asked for. Frame n takes n ms; every stage takes the number of the call, too.
class NotingRenderer final : public Renderer {
 public:
  Frame render(const Request& request, RenderStats& stats, const Progress& progress) override {
    report(progress, 0.5);
    requests.push_back(request);
    const double n = double(requests.size());
    if (requests.size() > most) throw Interrupted();
    stats = RenderStats{};
    stats.skip = request.skip.structure == "auto" ? automatic : request.skip;
    stats.trace_ms = {n};
    stats.classify_ms = n;
    stats.cluster_ms = 1000.0;
    stats.build_ms = 100.0;
    stats.upload_ms = 10.0;
    stats.table_ms = 5.0;
    stats.rays = 10;
    stats.hits = 4;
    if (request.count_costs) stats.evaluations = 30, stats.steps = 20, stats.intervals = request.scene.stub_sampling ? 70 : 50;
    if (frames.empty()) return {};
    return request.skip.structure == "none" ? frames.at(0) : frames.at(1);
  }
  std::vector<Feature> explain(const Request&) override { return {}; }

  std::vector<Request> requests;
  std::vector<Frame> frames;  ///< of none, and of all others
  std::size_t most = 1000000;
  SkipConfig automatic;
};

class SweepMeasureTest : public testing::Test {
 protected:
  SweepMeasureTest() {
    plan.settings = sweep_settings({.labels = {"grid", "bvh:boxes"}, .blocks = {4, 8}}, std::nullopt);
    plan.views.resize(2);
    for (std::size_t v = 0; v < 2; ++v) {
      plan.views[v].scene.width = 10 + int(v);
      plan.views[v].scene.isosurfaces = {Isosurface{.isovalue = kIsovalue}};
    }
    plan.rounds = 3;
    plan.moved = kMoved;
  }

  /// What was asked for, in few letters: the view; m with moved isovalues, c counted, s a walk, sc a counted walk, t true and plain.
  static std::string kind(const Renderer::Request& request) {
    std::string text = request.scene.width == 10 ? "0" : "1";
    if (request.scene.isosurfaces[0].isovalue != kIsovalue) text += "m";
    if (request.scene.stub_sampling) text += "s";
    if (request.count_costs) text += "c";
    return text.size() == 1 ? text + "t" : text;
  }
  std::vector<std::string> kinds(std::size_t first, std::size_t count) const {
    std::vector<std::string> all;
    for (std::size_t n = first; n < first + count; ++n) all.push_back(kind(renderer.requests.at(n)));
    return all;
  }

  SweepPlan plan;
  NotingRenderer renderer;
  std::vector<SweepMeasurement> measured;
};

constexpr std::size_t kFirstRound = 2 + 2 + 3 + 2, kLaterRound = 1 + 2;  // frames of a setting with two views

TEST_F(SweepMeasureTest, TakesRoundsThenBlocksThenStructuresThenViewsAndNoneInEveryRound) {
  measure_sweep(renderer, plan, measured);
  ASSERT_EQ(renderer.requests.size(), 5 * (kFirstRound + 2 * kLaterRound));
  std::vector<std::string> order;
  for (const Renderer::Request& request : renderer.requests) {
    const std::string now = request.skip.structure == "none" ? "none" : skip_label(request.skip) + std::to_string(request.skip.block);
    EXPECT_EQ(request.repeat, 1);
    if (order.empty() || order.back() != now) order.push_back(now);
  }
  const std::vector<std::string> round{"none", "grid4", "bvh:boxes4", "grid8", "bvh:boxes8"};
  std::vector<std::string> expected;
  for (int n = 0; n < 3; ++n) expected.insert(expected.end(), round.begin(), round.end());
  EXPECT_EQ(order, expected);
}

TEST_F(SweepMeasureTest, MovesTheIsovaluesCountsAndWalksInTheFirstRoundAloneAndWarmsUpInEach) {
  measure_sweep(renderer, plan, measured);
  using Kinds = std::vector<std::string>;
  EXPECT_EQ(kinds(0, kFirstRound), (Kinds{"0m", "0t", "0c", "1c", "0s", "0sc", "1sc", "0t", "1t"}));
  EXPECT_EQ(kinds(4 * kFirstRound, kFirstRound), kinds(0, kFirstRound));
  EXPECT_EQ(kinds(5 * kFirstRound, kLaterRound), (Kinds{"0t", "0t", "1t"}));
  EXPECT_DOUBLE_EQ(renderer.requests[0].scene.isosurfaces[0].isovalue, kIsovalue + kMoved);
}

TEST_F(SweepMeasureTest, TakesEachNumberFromTheFrameThatItBelongsTo) {
  measure_sweep(renderer, plan, measured);
  ASSERT_EQ(measured.size(), 5u);
  const SweepMeasurement& m = measured[1];
  const double first = kFirstRound + 1;  // number of the setting's first frame
  EXPECT_EQ(m.stages.classify_ms, first);
  EXPECT_EQ(m.scene.classify_ms, first + 1);
  EXPECT_EQ(m.change_ms(), first + 1 + 1115.0);
  EXPECT_EQ(m.traversal_ms, (std::vector<double>{first + 5, first + 6}));
  EXPECT_EQ(m.traversal_intervals, 140u);
  EXPECT_EQ(m.cost.rays, 20u);
  EXPECT_EQ(m.cost.hits, 8u);
  EXPECT_EQ(m.cost.evaluations, 60u);
  EXPECT_EQ(m.steps, 40u);
  EXPECT_EQ(m.intervals, 100u);
  // The warm-up frame of a later round is not among the timed ones.
  const double second = 5 * kFirstRound + kLaterRound + 1, third = second + 5 * kLaterRound;
  EXPECT_EQ(m.cost.frame_ms, (std::vector<double>{first + 7, first + 8, second + 1, second + 2, third + 1, third + 2}));
}

/// Two pixels.
Frame small_frame() { return {2, 1, {1, 2, 3, 4, 5, 6, 7, 8}, {9, 10}, {11, 12, 13, 14, 15, 16}, {}}; }

TEST_F(SweepMeasureTest, CountsThePixelsOfAllViewsThatAreNotThoseOfNone) {
  Frame other = small_frame();
  other.normal[5] = std::nextafter(other.normal[5], 0.0f);
  renderer.frames = {small_frame(), other};
  measure_sweep(renderer, plan, measured);
  EXPECT_EQ(measured[0].differing_pixels, 0u);
  for (std::size_t n = 1; n < measured.size(); ++n) EXPECT_EQ(measured[n].differing_pixels, 2u);  // one in each view
}

TEST(DifferingPixels, AreThoseWithAnyOtherBit) {
  const Frame truth = small_frame();
  EXPECT_EQ(differing_pixels(truth, truth), 0u);
  Frame other = truth;
  other.color[0] = 0.0f, other.color[3] = 0.0f, other.depth[0] = 0.0f;  // all of the first pixel
  EXPECT_EQ(differing_pixels(truth, other), 1u);
  other = truth;
  other.depth[1] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(differing_pixels(truth, other), 1u);
  other = truth;
  other.normal[0] = other.normal[3] = -0.0f;
  EXPECT_EQ(differing_pixels(truth, other), 2u);
  Frame zero = other;
  zero.normal[0] = zero.normal[3] = 0.0f;
  EXPECT_EQ(differing_pixels(zero, other), 2u);  // equal numbers, other bits
}

TEST(MovedScene, MovesIsovaluesAndEveryPointOfTheTransferFunction) {
  Scene scene;
  scene.isosurfaces = {Isosurface{.isovalue = 3.0}};
  scene.volume = DirectVolume{};
  scene.volume->function = {.colors = {{0.0, glm::dvec3(1.0)}}, .opacities = {{1.0, 0.0}, {2.0, 0.5}}};
  const Scene moved = moved_scene(scene, 0.25);
  EXPECT_EQ(moved.isosurfaces[0].isovalue, 3.25);
  EXPECT_EQ(moved.volume->function.colors[0].value, 0.25);
  EXPECT_EQ(moved.volume->function.opacities[1].value, 2.25);
  EXPECT_EQ(moved.volume->function.opacities[1].opacity, 0.5);
}

TEST_F(SweepMeasureTest, WithoutDetailsWarmsUpAndTimesAlone) {
  plan.details = false;
  plan.rounds = 1;
  measure_sweep(renderer, plan, measured);
  ASSERT_EQ(renderer.requests.size(), 5 * kLaterRound);
  EXPECT_EQ(kinds(0, 3), (std::vector<std::string>{"0t", "0t", "1t"}));
  EXPECT_EQ(measured[4].cost.frame_ms, (std::vector<double>{14.0, 15.0}));
}

TEST_F(SweepMeasureTest, TellsHowFarItIsInFramesUpToTheEnd) {
  std::vector<double> fractions;
  measure_sweep(renderer, plan, measured, [&](double f) { fractions.push_back(f); });
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.front(), 0.0);
  const double frames = double(renderer.requests.size());
  EXPECT_DOUBLE_EQ(fractions.back(), (frames - 0.5) / frames);
}

TEST_F(SweepMeasureTest, InterruptedKeepsTheSettingsWhoseFirstRoundIsWhole) {
  renderer.most = 3 * kFirstRound - 1;  // the last frame of the third setting is missing
  EXPECT_THROW(measure_sweep(renderer, plan, measured), Interrupted);
  EXPECT_EQ(measured.size(), 2u);
  EXPECT_EQ(measured[1].cost.frame_ms.size(), 2u);
}

TEST_F(SweepMeasureTest, InterruptedInALaterRoundKeepsWholeRoundsOfEachSetting) {
  renderer.most = 5 * kFirstRound + kLaterRound + 2;  // none has two rounds, the second setting one and a half
  EXPECT_THROW(measure_sweep(renderer, plan, measured), Interrupted);
  ASSERT_EQ(measured.size(), 5u);
  EXPECT_EQ(measured[0].cost.frame_ms.size(), 4u);
  EXPECT_EQ(measured[1].cost.frame_ms.size(), 2u);
}

TEST_F(SweepMeasureTest, AsksForAutoWithAPictureOfHardlyAnyPixels) {
  renderer.automatic = labelled_skip("distance", {.block = 32});
  EXPECT_EQ(chosen_skip(renderer, plan.views[0]), renderer.automatic);
  EXPECT_EQ(renderer.requests.front().skip, SkipConfig{});
  EXPECT_LE(renderer.requests.front().scene.width * renderer.requests.front().scene.height, 64);
}

/// "grid 4", "grid 4 off", with "+" behind what auto chose.
std::vector<std::string> names(const std::vector<SweepSetting>& settings) {
  std::vector<std::string> all;
  for (const SweepSetting& s : settings) {
    std::string name = s.label();
    if (s.skips()) name += " " + std::to_string(s.skip.block) + (s.skip.cell_test ? "" : " off");
    all.push_back(name + (s.chosen ? "+" : ""));
  }
  return all;
}

TEST(SweepSettings, AreNoneAndEveryStructureWithEveryBlock) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(sweep_settings({.labels = {"grid", "none", "octree"}, .blocks = {4, 8}}, std::nullopt)),
            (Names{"none", "grid 4", "octree 4", "grid 8", "octree 8"}));
  EXPECT_EQ(names(sweep_settings({.labels = {"grid", "octree"}, .blocks = {4}, .cell_tests = CellTests::both}, std::nullopt)),
            (Names{"none", "grid 4", "octree 4", "grid 4 off", "octree 4 off"}));
  EXPECT_EQ(names(sweep_settings({.labels = {"grid"}, .blocks = {4}, .cell_tests = CellTests::off}, std::nullopt)),
            (Names{"none", "grid 4 off"}));
}

TEST(SweepSettings, MarkWhatAutoChoseAndAddItWhereItIsMissing) {
  using Names = std::vector<std::string>;
  const SweepChoices choices{.labels = {"grid", "bvh:cubes"}, .blocks = {4, 16}};
  EXPECT_EQ(names(sweep_settings(choices, labelled_skip("grid", {.block = 16}))),
            (Names{"none", "grid 4", "bvh:cubes 4", "grid 16+", "bvh:cubes 16"}));
  EXPECT_EQ(names(sweep_settings(choices, labelled_skip("distance", {.block = 8}))),
            (Names{"none", "grid 4", "bvh:cubes 4", "distance 8+", "grid 16", "bvh:cubes 16"}));
  EXPECT_EQ(names(sweep_settings(choices, labelled_skip("grid", {.block = 16, .cell_test = false}))),
            (Names{"none", "grid 4", "bvh:cubes 4", "grid 16", "bvh:cubes 16", "grid 16 off+"}));
  EXPECT_EQ(names(sweep_settings(choices, labelled_skip("none", {.block = 64}))).front(), "none+");
  EXPECT_EQ(sweep_settings(choices, labelled_skip("none")).size(), 5u);
  // A clustering to other sizes is another setting.
  EXPECT_EQ(sweep_settings(choices, labelled_skip("bvh:cubes", {.block = 4, .max_cluster = 2})).size(), 6u);
}

}  // namespace
}  // namespace quincunx
