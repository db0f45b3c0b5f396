// The property of skipped space over many rays: minutes, run by `ctest --preset long`.
#include <cstdio>

#include "tests/render/device_fixture.h"
#include "tests/render/skip_property.h"

namespace quincunx {
namespace {

class SkippedSpaceOf : public DeviceTest, public testing::WithParamInterface<std::string_view> {};

TEST_P(SkippedSpaceOf, HoldsNoPointOfTheSurfaceAlongTenMillionRays) {
  SkippedSpace seen;
  std::uint32_t seed = 1000;
  for (const AdversarialVolume& v : adversarial_volumes())
    for (int block = 1; block <= 8; block *= 2)
      for (const bool cell_test : {false, true})
        seen += look_into_skipped_space(v, labelled_skip(GetParam(), {.block = block, .cell_test = cell_test}), 1 << 16, seed++);
  EXPECT_EQ(seen.violations, 0u);
  EXPECT_GE(seen.rays, 10'000'000u);
  std::printf("%llu rays, %llu points of %llu skipped stretches; seeds 1000 to %u\n", static_cast<unsigned long long>(seen.rays),
              static_cast<unsigned long long>(seen.points), static_cast<unsigned long long>(seen.stretches), seed - 1);
}

INSTANTIATE_TEST_SUITE_P(EveryWay, SkippedSpaceOf, testing::Values("grid", "octree", "distance", "bvh", "bvh:cubes", "bvh:boxes", "bih", "kdtree:shallow", "kdtree:deep", "hybrid:mm", "hybrid:pc", "segments"),
                         [](const auto& test) {
                           std::string name(test.param);
                           std::replace(name.begin(), name.end(), ':', '_');
                           return name;
                         });

}  // namespace
}  // namespace quincunx
