#include "render/brick_source.h"

#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <mutex>
#include <random>

namespace quincunx {
namespace {

template <class T>
Volume noise(LatticeKind lattice, const Extents& extents, double scale) {
  Volume v{lattice, extents, {}, std::vector<T>{}, {}};
  std::mt19937 random(3);
  for (std::size_t n = 0; n < v.sample_count(); ++n)
    std::get<std::vector<T>>(v.samples).push_back(T(scale * double(random()) / double(random.max())));
  return v;
}

Volume noise(SampleType type, LatticeKind lattice, const Extents& extents) {
  switch (type) {
    case SampleType::uint8: return noise<std::uint8_t>(lattice, extents, 255.0);
    case SampleType::int16: return noise<std::int16_t>(lattice, extents, -30000.0);
    case SampleType::uint16: return noise<std::uint16_t>(lattice, extents, 65535.0);
    case SampleType::float32: break;
  }
  return noise<float>(lattice, extents, 1e-3);
}

/// A volume that notes which samples are read.
class WatchedSource final : public SampleSource {
 public:
  explicit WatchedSource(const Volume& volume) : source_(volume) {}
  const Volume& header() const override { return source_.header(); }
  Volume read_box(const glm::i64vec3& low, const glm::i64vec3& high) const override {
    const std::lock_guard lock(mutex_);
    largest = glm::max(largest, high - low);
    return source_.read_box(low, high);
  }
  mutable glm::i64vec3 largest{0};

 private:
  VolumeSource source_;
  mutable std::mutex mutex_;
};

/// The bits of a slot's numbers as BrickLayout defines them, from the coefficients of the whole volume.
std::vector<std::uint32_t> expected_slot(const BrickLayout& layout, const glm::ivec3& brick, const Coefficients<float>& whole) {
  std::vector<std::uint32_t> bits;
  const glm::i64vec3 first = layout.first_index(brick), last = whole.extents - std::int64_t(1);
  for (int c = 0; c < coset_count(layout.lattice); ++c)
    for (std::int64_t k = first.z; k < first.z + layout.samples; ++k)
      for (std::int64_t j = first.y; j < first.y + layout.samples; ++j)
        for (std::int64_t i = first.x; i < first.x + layout.samples; ++i) {
          const glm::i64vec3 index = glm::clamp(glm::i64vec3(i, j, k), glm::i64vec3(0), last);
          bits.push_back(std::bit_cast<std::uint32_t>(whole.data[whole.number(c, index)]));
        }
  return bits;
}

std::vector<std::uint32_t> filled(const BrickSource& source, const BrickLayout& layout, const glm::ivec3& brick) {
  std::vector<float> slot(std::size_t(layout.slot_floats()), std::numeric_limits<float>::quiet_NaN());
  source.fill(brick, slot);
  std::vector<std::uint32_t> bits;
  for (const float f : slot) bits.push_back(std::bit_cast<std::uint32_t>(f));
  return bits;
}

TEST(BrickSource, BricksOfSamplesAndOfCoefficientsAreTheWholeVolumesBitForBit) {
  int type = 0;
  for (const std::string_view name : spline_names()) {
    const auto spline = make_spline(name);
    for (const auto& [prefilter, reach, gain, order] : spline->filters())
      // No multiples of the bricks, just multiples, one sample on one axis and on all.
      for (const Extents& extents : {Extents(13, 7, 10), Extents(9, 5, 17), Extents(11, 1, 6), Extents(1, 1, 1)})
        for (const int edge : {4, 8}) {
          const Volume volume = noise(SampleType(type++ % 4), spline->lattice(), extents);
          const WatchedSource samples(volume);
          const Coefficients<float> whole = spline->coefficients_float(volume, prefilter);
          const BrickLayout layout(spline->lattice(), extents, spline->apron(), edge);
          const CoefficientBricks from_coefficients(layout, whole);
          const SampleBricks from_samples(layout, samples, *spline, prefilter);
          for (std::int32_t n = 0; n < layout.count(); ++n) {
            const std::vector<std::uint32_t> expected = expected_slot(layout, layout.brick(n), whole);
            ASSERT_EQ(filled(from_coefficients, layout, layout.brick(n)), expected) << name << " brick " << n << " of " << edge;
            ASSERT_EQ(filled(from_samples, layout, layout.brick(n)), expected) << name << " brick " << n << " of " << edge;
          }
          for (int a = 0; a < 3; ++a) EXPECT_LE(samples.largest[a], layout.samples + 2 * reach) << "more was read than a brick needs";
        }
  }
}

}  // namespace
}  // namespace quincunx
