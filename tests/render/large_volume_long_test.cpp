// Volumes of more than 2^32 samples: bounds, active bricks and the pool, in a small part of the memory that they would take.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <random>

#include "accel/streamed_bounds.h"
#include "io/sample_file.h"
#include "render/brick_pool.h"
#include "tests/io/sparse_volume.h"

namespace quincunx {
namespace {

constexpr double kRadius = 30.0;  // of the balls, lattice coordinates; they are 0 beyond twice that
constexpr double kIsovalue = 100.0;
constexpr double kAround = 100.0;  // of a ball's centre, looked at: twice the radius and more than a brick
constexpr double kMostGib = 1.0;

/// Values about `centre` whose isovalue is a ball, 0 to 200.
double ball(const glm::dvec3& u, const glm::dvec3& centre) {
  return std::floor(std::max(0.0, 200.0 - 100.0 * glm::distance(u, centre) / kRadius));
}

double peak_gib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) / double(1 << 20);
}

/// A ball as the samples and coefficients about it, made without a file.
struct Ball {
  glm::dvec3 centre;
  glm::i64vec3 low, high;  ///< indices
  Coefficients<float> coefficients;

  Ball(const glm::dvec3& centre_, const Spline& spline) : centre(centre_) {
    const double step = lattice_step(spline.lattice());
    low = glm::i64vec3((centre - kAround) / step), high = glm::i64vec3((centre + kAround) / step);
    Volume v{spline.lattice(), high - low, {}, std::vector<std::uint8_t>{}, {}};
    for (int c = 0; c < coset_count(v.lattice); ++c)
      for (std::int64_t k = low.z; k < high.z; ++k)
        for (std::int64_t j = low.y; j < high.y; ++j)
          for (std::int64_t i = low.x; i < high.x; ++i)
            std::get<std::vector<std::uint8_t>>(v.samples).push_back(std::uint8_t(ball(step * glm::dvec3(i, j, k) + double(c), centre)));
    coefficients = spline.coefficients_float(v, Spline::Prefilter::automatic);
  }
  double distance_to(const BrickLayout& layout, const glm::ivec3& brick) const {
    const glm::dvec3 corner(brick * layout.edge);
    return glm::distance(glm::clamp(centre, corner, corner + double(layout.edge)), centre);
  }
};

/// A sparse file with three balls, one across sample number 2^32, which is gone after the test.
class LargeVolume {
 public:
  LargeVolume(std::string_view spline_name, const Extents& extents)
      : spline(make_spline(spline_name)), file_(spline->lattice(), extents, SampleType::uint8, path()) {
    const glm::dvec3 last(domain_max(spline->lattice(), extents));
    const std::int64_t plane = (std::int64_t(1) << 32) / (extents.x * extents.y) % extents.z;
    const glm::dvec3 crossing(0.5 * last.x, 0.5 * last.y, double(lattice_step(spline->lattice()) * plane));
    for (const glm::dvec3& centre : {glm::dvec3(130.0), last - 140.0, crossing}) {
      balls.emplace_back(centre, *spline);
      file_.put(balls.back().low, balls.back().high, [&](const glm::dvec3& u) { return ball(u, centre); });
    }
  }
  ~LargeVolume() { std::filesystem::remove(path()); }
  static std::string path() {
    return (std::filesystem::temp_directory_path() / ("quincunx-large-" + std::to_string(getpid()) + ".nrrd")).string();
  }
  const Ball& nearest(const BrickLayout& layout, const glm::ivec3& brick) const {
    return *std::min_element(balls.begin(), balls.end(), [&](const Ball& a, const Ball& b) {
      return a.distance_to(layout, brick) < b.distance_to(layout, brick);
    });
  }

  std::unique_ptr<Spline> spline;
  std::vector<Ball> balls;

 private:
  SparseVolume file_;
};

/// The active bricks are those about the balls' surfaces, all of them.
std::vector<std::int32_t> checked_bricks(const LargeVolume& volume, const BrickLayout& layout, const StreamedBounds& bounds) {
  const std::vector<ValueRange> ranges{{kIsovalue, kIsovalue}};
  const std::vector<std::uint8_t> active = active_bricks(layout, classify(bounds.blocks, bounds.scale, ranges));
  std::vector<std::int32_t> bricks;
  for (std::int32_t n = 0; n < layout.count(); ++n) {
    if (active[std::size_t(n)] == 0) continue;
    bricks.push_back(n);
    EXPECT_LE(volume.nearest(layout, layout.brick(n)).distance_to(layout, layout.brick(n)), kRadius + 17.0);
  }
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (const Ball& b : volume.balls)
    for (int n = 0; n < 5000; ++n) {
      const glm::dvec3 u = b.centre + kRadius * glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
      EXPECT_EQ(active[std::size_t(layout.number(layout.brick_of_cell(glm::ivec3(u))))], 1);
    }
  return bricks;
}

/// Every number of a slot is the coefficient that was made without the file.
void expect_slot(const LargeVolume& volume, const BrickLayout& layout, std::int32_t number, std::span<const float> slot) {
  const glm::ivec3 brick = layout.brick(number);
  const Ball& b = volume.nearest(layout, brick);
  const glm::i64vec3 first = layout.first_index(brick) - b.low;
  std::size_t wrong = 0, n = 0;
  for (int c = 0; c < coset_count(layout.lattice); ++c)
    for (std::int64_t k = 0; k < layout.samples; ++k)
      for (std::int64_t j = 0; j < layout.samples; ++j)
        for (std::int64_t i = 0; i < layout.samples; ++i, ++n)
          wrong += slot[n] != b.coefficients.data[b.coefficients.number(c, first + glm::i64vec3(i, j, k))];
  EXPECT_EQ(wrong, 0u) << "in brick " << number;
}

void expect_streamed(std::string_view spline, const Extents& extents) {
  const LargeVolume volume(spline, extents);
  const SampleFile source(LargeVolume::path(), {});
  ASSERT_GT(source.header().sample_count(), std::size_t(1) << 32);
  const StreamedBounds bounds =
      streamed_bounds(source, *volume.spline, Spline::Prefilter::automatic, 16, LargeVolume::path());
  EXPECT_EQ(bounds.samples.min, 0.0);

  const BrickLayout layout(volume.spline->lattice(), extents, volume.spline->apron(), 32);
  std::vector<std::int32_t> bricks = checked_bricks(volume, layout, bounds);
  sort_front_to_back(layout, glm::dvec3(-100.0), bricks);
  const auto fill = std::make_shared<SampleBricks>(layout, source, *volume.spline, Spline::Prefilter::automatic);
  BrickPool pool(layout, fill, 5 * layout.slot_bytes());
  std::size_t uploads = 0;
  for (std::size_t n = 0; n < bricks.size(); n += 5) {
    const std::span<const std::int32_t> needed = std::span(bricks).subspan(n, std::min<std::size_t>(5, bricks.size() - n));
    std::vector<std::vector<float>> device(5);
    pool.make_resident(needed, [&](std::int32_t, std::int64_t first, std::span<const float> slot) {
      device[std::size_t(first / layout.slot_floats())].assign(slot.begin(), slot.end());
      ++uploads;
    });
    for (const std::int32_t brick : needed) {
      const std::int64_t slot = (pool.page_table()[std::size_t(brick)] - layout.origin(layout.brick(brick), 0)) / layout.slot_floats();
      expect_slot(volume, layout, brick, device[std::size_t(slot)]);
    }
  }
  EXPECT_EQ(uploads, bricks.size());
  EXPECT_GT(uploads, 40u);
  EXPECT_LT(peak_gib(), kMostGib) << "for " << double(source.header().sample_count()) / double(1 << 30) << " GiB of samples";
}

TEST(LargeVolume, OnTheCartesianLatticeIsStreamed) { expect_streamed("trilinear", {2100, 2050, 1150}); }

TEST(LargeVolume, OnTheBccLatticeIsStreamed) { expect_streamed("bcc7", {1300, 1300, 1300}); }

}  // namespace
}  // namespace quincunx
