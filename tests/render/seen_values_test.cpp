// What is outside the ranges adds nothing, by the kernels' own look-ups; and the ranges are not much wider than that.
#include "render/seen_values.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "render/transfer_table.h"

namespace quincunx {
namespace {

/// A place among ranges: 2n + 1 inside range n, 2n before it.
std::size_t place_among(const std::vector<ValueRange>& ranges, double v) {
  std::size_t n = 0;
  while (n < ranges.size() && ranges[n].high < v) ++n;
  return n < ranges.size() && ranges[n].low <= v ? 2 * n + 1 : 2 * n;
}
bool inside(const std::vector<ValueRange>& ranges, double v) { return place_among(ranges, v) % 2 == 1; }

/// A table as shaders/transfer.glsl looks it up, in floats.
struct LookUp {
  float low, per_value, last;
  explicit LookUp(const DirectVolume& volume) : low(float_below(volume.function.low())) {
    const double n = volume.table_entries() - 1, high = float_above(volume.function.high());
    per_value = float(n / (high - double(low))), last = float(n);
  }
  float place(float value) const { return std::clamp((value - low) * per_value, 0.0f, last); }
};
float mix(float a, float b, float x) { return a * (1.0f - x) + b * x; }

float post(const TransferTable& table, float x) {
  const int i = std::min(int(x), int(table.entries.size()) - 2);
  return mix(table.entries[std::size_t(i)].a, table.entries[std::size_t(i) + 1].a, x - float(i));
}
float pre_integrated(const PreIntegratedTable& table, float front, float back) {
  const int i = std::min(int(front), table.entries - 2), j = std::min(int(back), table.entries - 2);
  const auto a = [&](int k, int l) { return table.cells[std::size_t(l) * std::size_t(table.entries) + std::size_t(k)].a; };
  const float x = front - float(i), y = back - float(j);
  return mix(mix(a(i, j), a(i + 1, j), x), mix(a(i, j + 1), a(i + 1, j + 1), x), y);
}

/// Points at random values; runs of them without opacity, at the ends too.
DirectVolume random_volume_look(std::mt19937& random, Classify classify) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  DirectVolume volume;
  volume.classify = classify;
  volume.entries = classify == Classify::post ? 64 + int(random() % 400) : 8 + int(random() % 40);
  volume.function.colors = {{0.0, {1.0, 1.0, 1.0}}};
  const double offset = std::exp(8.0 * uniform(random) - 4.0) * (uniform(random) - 0.5);
  const double width = std::exp(10.0 * uniform(random) - 5.0) / 8.0;
  bool clear = random() % 2;
  double value = offset;
  for (int n = 0; n < 8; ++n) {
    volume.function.opacities.push_back({value, clear ? 0.0 : 0.05 + 0.9 * uniform(random)});
    value += width * (0.2 + uniform(random));
    clear = random() % 3 != 0;
  }
  volume.function.colors.front().value = offset;
  return volume;
}

Scene scene_of(const DirectVolume& volume) {
  Scene scene;
  scene.volume = volume;
  return scene;
}

/// Random values about the function's, and those next to its entries and to the ranges' ends.
std::vector<float> values_about(const DirectVolume& volume, const std::vector<ValueRange>& ranges, std::mt19937& random) {
  const double low = volume.function.low(), high = volume.function.high(), width = high - low;
  std::uniform_real_distribution<double> uniform(low - 0.3 * width, high + 0.3 * width);
  std::vector<float> values;
  for (int n = 0; n < 400; ++n) values.push_back(float(uniform(random)));
  const int last = volume.table_entries() - 1;
  for (int n = 0; n <= last; ++n) values.push_back(float(low + width * n / last));
  for (const ValueRange& range : ranges)
    for (const double end : {range.low, range.high})
      if (std::abs(end) < 1e30) values.insert(values.end(), {float_below(end), float_above(end)});
  return values;
}

TEST(SeenValues, AreAllThoseToWhichAPostTableGivesOpacityAndLittleMore) {
  std::mt19937 random(11);
  std::size_t outside = 0;
  for (int n = 0; n < 400; ++n) {
    const DirectVolume volume = random_volume_look(random, Classify::post);
    const std::vector<ValueRange> ranges = seen_values(scene_of(volume));
    const TransferTable table = bake(volume.function, volume.entries, 1.0, 1.0);
    const LookUp look(volume);
    for (const float v : values_about(volume, ranges, random)) {
      const float place = look.place(v);
      if (!inside(ranges, v)) {
        ++outside;
        ASSERT_EQ(post(table, place), 0.0f) << "function " << n << ", value " << v << ", entry " << place;
      } else {
        const float near = std::max(post(table, std::max(place - 0.05f, 0.0f)), post(table, std::min(place + 0.05f, look.last)));
        ASSERT_GT(near, 0.0f) << "function " << n << ", value " << v << ", entry " << place;
      }
    }
  }
  EXPECT_GT(outside, 50000u);
}

TEST(SeenValues, HoldEachStretchToWhichAPreIntegratedTableGivesOpacity) {
  std::mt19937 random(12);
  std::size_t apart = 0;
  for (int n = 0; n < 400; ++n) {
    const DirectVolume volume = random_volume_look(random, Classify::pre_integrated);
    const std::vector<ValueRange> ranges = seen_values(scene_of(volume));
    const PreIntegratedTable table = pre_integrate(volume.function, volume.entries, 1.0, 1.0);
    const LookUp look(volume);
    std::vector<float> values = values_about(volume, ranges, random);
    for (std::size_t k = 0; k + 1 < values.size(); ++k) {
      // Both ends between the same two ranges.
      const std::size_t place = place_among(ranges, values[k]);
      const std::size_t other = random() % values.size();
      if (place % 2 == 1 || place != place_among(ranges, values[other])) continue;
      ++apart;
      ASSERT_EQ(pre_integrated(table, look.place(values[k]), look.place(values[other])), 0.0f)
          << "function " << n << ", values " << values[k] << ", " << values[other];
    }
    // Little more: no value is farther than three entries from one with opacity.
    const double interval = (volume.function.high() - volume.function.low()) / double(volume.entries - 1);
    for (const float v : values)
      if (inside(ranges, v)) {
        bool near = false;
        for (double d = -3.0; d <= 3.0; d += 0.02) near = near || volume.function.opacity(v + d * interval) > 0.0;
        ASSERT_TRUE(near) << "function " << n << ", value " << v;
      }
  }
  EXPECT_GT(apart, 20000u);
}

TEST(SeenValues, AreMetByAStretchHoweverNarrowThatAPreIntegratedTableMeets) {
  DirectVolume volume;
  volume.classify = Classify::pre_integrated;
  volume.entries = 16;
  volume.function.colors = {{0.0, {1.0, 1.0, 1.0}}};
  volume.function.opacities = {{0.0, 0.0}, {50.0, 0.0}, {50.0001, 0.9}, {50.0002, 0.0}, {100.0, 0.0}};
  const std::vector<ValueRange> ranges = seen_values(scene_of(volume));
  ASSERT_EQ(ranges.size(), 1u);
  EXPECT_LT(ranges[0].low, 50.0);
  EXPECT_GT(ranges[0].high, 50.0002);
  EXPECT_GT(ranges[0].low, 50.0 - 3.0 * 100.0 / 15.0);
  EXPECT_LT(ranges[0].high, 50.0 + 3.0 * 100.0 / 15.0);
}

TEST(SeenValues, AreTheIsovaluesOfVisibleSurfacesToo) {
  Scene scene;
  scene.isosurfaces = {{3.0}, {-2.0}, {7.0, {1.0, 1.0, 1.0}, 0.0}, {0.5}};
  EXPECT_EQ(seen_values(scene), (std::vector<ValueRange>{{-2.0, -2.0}, {0.5, 0.5}, {3.0, 3.0}}));
  DirectVolume volume;
  volume.function.colors = {{0.0, {1.0, 1.0, 1.0}}};
  volume.function.opacities = {{0.0, 0.0}, {0.4, 0.1}, {0.6, 0.1}, {1.0, 0.0}};
  scene.volume = volume;
  const std::vector<ValueRange> both = seen_values(scene);
  ASSERT_EQ(both.size(), 3u) << "0.5 is among the volume's values";
  EXPECT_EQ(both[0], (ValueRange{-2.0, -2.0}));
  EXPECT_LE(both[1].low, 0.0);
  EXPECT_GE(both[1].high, 1.0);
  EXPECT_EQ(both[2], (ValueRange{3.0, 3.0}));
}

TEST(SeenValues, AreNoneWhereNothingHasOpacity) {
  for (const Classify classify : {Classify::post, Classify::pre_integrated}) {
    DirectVolume volume;
    volume.classify = classify;
    volume.function.colors = {{0.0, {1.0, 1.0, 1.0}}};
    volume.function.opacities = {{0.0, 0.0}, {1.0, 0.0}};
    EXPECT_TRUE(seen_values(scene_of(volume)).empty());
  }
}

TEST(SeenValues, DoNotDependOnHowThinTheVolumeIs) {
  // A unit that is huge beside a length of 1, in a world whose cells are as large: what is seen there is seen.
  DirectVolume volume;
  volume.entries = 64;
  volume.function.colors = {{0.0, {1.0, 1.0, 1.0}}};
  volume.function.opacities = {{0.0, 0.0}, {0.4, 0.0}, {0.5, 1e-12}, {0.6, 0.0}, {1.0, 0.0}};
  volume.function.unit = 1e36;
  const std::vector<ValueRange> ranges = seen_values(scene_of(volume));
  ASSERT_EQ(ranges.size(), 1u);
  EXPECT_LT(ranges[0].low, 0.42);
  EXPECT_GT(ranges[0].high, 0.58);
}

TEST(SeenValues, AreAtMost254Ranges) {
  DirectVolume volume;
  volume.entries = 8192;
  volume.function.colors = {{0.0, {1.0, 1.0, 1.0}}};
  for (int n = 0; n < 300; ++n) {
    const double v = n + 0.001 * (n % 7);
    volume.function.opacities.insert(volume.function.opacities.end(), {{v + 0.3, 0.0}, {v + 0.5, 0.5}, {v + 0.7, 0.0}});
  }
  Scene scene = scene_of(volume);
  for (int n = 0; n < 10; ++n) scene.isosurfaces.push_back({-5.0 - n});
  const std::vector<ValueRange> ranges = seen_values(scene);
  EXPECT_EQ(ranges.size(), 254u);
  for (const auto& point : volume.function.opacities)
    EXPECT_TRUE(point.opacity == 0.0 || inside(ranges, point.value)) << point.value;
  for (const Isosurface& surface : scene.isosurfaces) EXPECT_TRUE(inside(ranges, surface.isovalue));
}

}  // namespace
}  // namespace quincunx
