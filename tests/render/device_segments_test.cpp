// Lists of segments (accel/segments.h) as kernels make and read them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/render/adversarial_volumes.h"
#include "tests/render/device_fixture.h"

namespace quincunx {
namespace {

class DeviceSegments : public DeviceTest {};

SkipConfig segments(int most, bool cell_test = true) { return {.structure = "segments", .block = 4, .cell_test = cell_test, .most_segments = most}; }

/// Surfaces about z = 5 and z = 17; what is between and around them is empty.
Volume two_sheets() {
  return bcc_volume({12, 12, 12}, [](const glm::dvec3& u) { return std::exp(-(u.z - 5.0) * (u.z - 5.0)) + std::exp(-(u.z - 17.0) * (u.z - 17.0)); });
}

/// By number of intervals, how many rays have so many.
std::vector<int> rays_by_intervals(const SkipConfig& skip) {
  const Volume volume = two_sheets();
  Renderer::Request request = request_for(volume, 0.5, 48, 20.0, 60.0);
  request.scene.stub_sampling = request.scene.cost = true;
  request.skip = skip;
  DeviceRenderer renderer(test_kernels(), volume, Renderer::Config{});
  RenderStats stats;
  const Frame frame = renderer.render(request, stats);
  std::vector<int> counts;
  for (std::size_t p = 0; p < frame.depth.size(); ++p) {
    const std::size_t intervals = std::size_t(frame.cost[3 * p + 2]);
    counts.resize(std::max(counts.size(), intervals + 1));
    ++counts[intervals];
  }
  return counts;
}

TEST_F(DeviceSegments, OfNeighbouringBlocksAreOne) {
  const std::vector<int> counts = rays_by_intervals(segments(16, false));
  ASSERT_EQ(counts.size(), 3u) << "no ray meets more than both sheets";
  EXPECT_GT(counts[1], 50);
  EXPECT_GT(counts[2], 200);
  EXPECT_GT(rays_by_intervals({.structure = "grid", .block = 4, .cell_test = false}).size(), 3u) << "which cross several blocks of a sheet";
}

TEST_F(DeviceSegments, BeyondTheMostOfAListReachToTheEndOfTheRay) {
  EXPECT_EQ(rays_by_intervals(segments(2, false)), rays_by_intervals(segments(16, false)));
  const std::vector<int> both = rays_by_intervals(segments(2, false)), one = rays_by_intervals(segments(1, false));
  ASSERT_EQ(one.size(), 2u);
  EXPECT_EQ(one[1], both[1] + both[2]);
}

TEST_F(DeviceSegments, ListsOfAnyLengthShowWhatNoneShows) {
  const Volume noise = random_volume({12, 10, 11}, 3);
  for (const double opacity : {1.0, 0.4}) {
    Renderer::Request request = request_for(noise, 0.9, 32, 70.0, 20.0);
    request.scene.isosurfaces.front().opacity = opacity;
    DeviceRenderer renderer(test_kernels(), noise, Renderer::Config{});
    RenderStats stats;
    request.skip.structure = "none";
    const Frame truth = renderer.render(request, stats);
    EXPECT_TRUE(stats.list_ms.empty());
    for (const int most : {1, 2, 3, 16, 256}) {
      request.skip = segments(most);
      request.skip.block = 2;
      SCOPED_TRACE(most);
      expect_same_picture(renderer.render(request, stats), truth);
      ASSERT_EQ(stats.list_ms.size(), 1u);
      EXPECT_LE(stats.list_ms[0], stats.trace_ms[0]);
    }
  }
}

TEST_F(DeviceSegments, ListsOverTheLimitOfABufferAreMadeInBands) {
  const Volume noise = random_volume({8, 8, 8}, 4);
  Renderer::Request request = request_for(noise, 0.8, 40, 70.0, 20.0);
  request.skip = segments(64);
  RenderStats stats;
  DeviceRenderer whole(test_kernels(), noise, Renderer::Config{}), banded(test_kernels(), noise, Renderer::Config{}, {.texel_elements = 0, .frame_bytes = 40 * 8 * 64 * 8});
  const Frame truth = whole.render(request, stats);
  expect_same_picture(banded.render(request, stats), truth);
  const auto lists = std::ranges::find(stats.device_bytes, "lists of rays", &std::pair<std::string, std::uint64_t>::first);
  ASSERT_NE(lists, stats.device_bytes.end());
  EXPECT_EQ(lists->second, 40u * 8 * 64 * 8);
}

}  // namespace
}  // namespace quincunx
