#include "bench/timing.h"

#include <gtest/gtest.h>

#include <utility>

namespace quincunx {
namespace {

/// A renderer that notes what it is asked for and takes ever longer: frame n takes n ms.
class SlowingRenderer final : public Renderer {
 public:
  Frame render(const Request& request, RenderStats& stats, const Progress&) override {
    requests.push_back(request);
    stats = RenderStats{};
    stats.device = "a slowing device";
    stats.trace_ms.assign(std::size_t(request.repeat), double(requests.size()));
    stats.rays = 10;
    stats.hits = 4;
    stats.evaluations = request.count_costs ? 30 : 0;
    return {};
  }
  std::vector<Feature> explain(const Request&) override { return {}; }

  std::vector<Request> requests;
};

class TurnsTest : public testing::Test {
 protected:
  TurnsTest() {
    const std::vector<double> steps{0.5, 0.25};
    plan.settings = intersect_settings(steps);
    plan.views.resize(2);
    plan.views[1].scene.width = 7;
    plan.rounds = 3;
    costs = time_in_turns(
        renderer, plan, [&](std::size_t s, std::size_t v, const Frame&) { heard.emplace_back(s, v); }, device);
  }

  TimingPlan plan;
  SlowingRenderer renderer;
  std::vector<std::pair<std::size_t, std::size_t>> heard;
  std::string device;
  std::vector<Cost> costs;
};

TEST(Settings, AreExactAndEveryStepWithAndWithoutSkippingAndThePublishedOneOnce) {
  const std::vector<double> steps{0.5, 0.25}, without{0.5};
  const std::vector<Setting> settings = intersect_settings(steps);
  const std::vector<Setting> expected{{Intersect::exact, 0.0, "grid"}, {Intersect::exact, 0.0, "none"},
                                      {Intersect::march, 0.5, "grid"}, {Intersect::march, 0.25, "grid"},
                                      {Intersect::march, 0.5, "none"}, {Intersect::march, 0.25, "none"}};
  EXPECT_EQ(settings, expected);
  // The published one is measured even where it is not asked for: speed is told relative to it.
  EXPECT_EQ(intersect_settings(without).back(), published_setting());
  EXPECT_EQ(intersect_settings(without).size(), 5u);
}

TEST_F(TurnsTest, TakeEverySettingOnceFromAViewBeforeAnyASecondTime) {
  ASSERT_EQ(renderer.requests.size(), (3 + 1) * 2 * plan.settings.size());
  std::size_t n = 0;
  for (int round = -1; round < 3; ++round) {
    for (const Renderer::Request& view : plan.views) {
      for (const Setting& setting : plan.settings) {
        const Renderer::Request& request = renderer.requests[n++];
        EXPECT_EQ(request.scene.intersect, setting.intersect);
        EXPECT_EQ(request.skip.structure, setting.structure);
        if (setting.intersect == Intersect::march) {
          EXPECT_EQ(request.scene.step, setting.step);
        }
        EXPECT_EQ(request.scene.width, view.scene.width);
      }
    }
  }
}

TEST_F(TurnsTest, TimeNoneOfTheFirstFramesWhichCountAndAreListenedTo) {
  const std::size_t settings = plan.settings.size();
  EXPECT_EQ(heard.size(), 2 * settings);
  EXPECT_EQ(device, "a slowing device");
  for (std::size_t s = 0; s < settings; ++s) {
    EXPECT_EQ(costs[s].rays, 20u);
    EXPECT_EQ(costs[s].hits, 8u);
    EXPECT_EQ(costs[s].evaluations, 60u);
    ASSERT_EQ(costs[s].frame_ms.size(), 6u);
    // Frame number 2 * settings is the first after the untimed ones.
    EXPECT_EQ(costs[s].frame_ms.front(), double(2 * settings + s + 1));
    EXPECT_EQ(costs[s].frame_ms.back(), double(7 * settings + s + 1));
  }
}

TEST(Speedup, IsTheMedianOfTheRatiosOfFramesTakenTogether) {
  // Ratios 4, 2, 6: a machine that is ten times slower in the second round changes nothing.
  const Cost cost{.frame_ms = {1.0, 10.0, 1.0}}, baseline{.frame_ms = {4.0, 20.0, 6.0}};
  EXPECT_DOUBLE_EQ(speedup(cost, baseline).median, 4.0);
  EXPECT_DOUBLE_EQ(speedup(cost, baseline).p5, 2.2);
  EXPECT_DOUBLE_EQ(speedup(cost, baseline).p95, 5.8);
  EXPECT_DOUBLE_EQ(speedup(baseline, baseline).median, 1.0);
}

}  // namespace
}  // namespace quincunx
