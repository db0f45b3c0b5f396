// Pictures of a volume of 4.6 GiB, through pools of 64 and 256 MiB. The table of docs/performance.md, "Larger than memory", is what this prints.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/image_file.h"
#include "program.h"
#include "render/camera.h"
#include "tests/io/sparse_volume.h"

namespace quincunx::test {
namespace {

using nlohmann::json;

constexpr std::int64_t kEdge = 1700;  // samples an axis
constexpr double kIsovalue = 100.0;
constexpr int kSize = 256;            // pixels
constexpr double kMostGib = 0.75;     // of memory, whatever the pool

/// Distance to the surface, negative inside; values are 100 there and fall to 0 in 12 cells.
double sample(double distance) { return std::clamp(std::floor(kIsovalue - 8.0 * distance), 0.0, 200.0); }

/// A spherical shell 8 cells thick.
struct Shell {
  glm::dvec3 centre;
  double radius = 150.0;
  double distance(const glm::dvec3& u) const { return std::abs(glm::distance(u, centre) - radius) - 4.0; }
};

/// A bar along x.
struct Bar {
  glm::dvec3 low, high;
  double distance(const glm::dvec3& u) const {
    const glm::dvec3 off = glm::max(low - u, u - high);
    const glm::dvec3 outside = glm::max(off, glm::dvec3(0.0));
    return glm::length(outside) + std::min(0.0, std::max(off.x, std::max(off.y, off.z)));
  }
};

/// A file of 1700^3 samples of 8 bits, mostly a hole: a shell near the first sample, one through sample number 2^32, one near the last; a bar on the far edge.
class LargeRender : public testing::Test {
 protected:
  void SetUp() override {
    SparseVolume file(LatticeKind::cartesian, Extents(kEdge), SampleType::uint8, volume);
    for (const Shell& s : shells) {
      const double reach = s.radius + 18.0;
      file.put(glm::i64vec3(s.centre - reach), glm::i64vec3(s.centre + reach), [&](const glm::dvec3& u) { return sample(s.distance(u)); });
    }
    file.put(glm::i64vec3(bar.low - 13.0), glm::i64vec3(bar.high + 13.0), [&](const glm::dvec3& u) { return sample(bar.distance(u)); });
    write_file(tf, R"({"unit": 10, "colors": [[20, "#3060c0"], [200, "#f0d080"]], "opacities": [[20, 0], [110, 0.05], [160, 0.6]]})");
  }

  /// The picture of `look` through `pool`, which must not take the memory of the volume; prints what it cost.
  Image picture(const Arguments& look, const std::string& pool, json& told) const {
    const std::string exr = folder / "picture.exr";
    Arguments arguments{"render", volume, "-o", exr, "--json", "--quiet", "--pool", pool, "--block", "16", "--azimuth", "205", "--elevation", "25",
                        "--size", std::to_string(kSize), std::to_string(kSize)};
    arguments.insert(arguments.end(), look.begin(), look.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    told = json::parse(outcome.out);
    const double gib = double(outcome.peak_bytes) / double(1 << 30);
    const json& bricks = told["bricks"];
    fmt::print("| {} | {} | {:.2f} | {:.0f} | {} | {} | {} | {:.1f} |\n", look.front(), pool, gib, told["stages_ms"]["bounds"].get<double>() / 1e3,
               bricks["rounds"].get<int>(), bricks["loads"].get<int>(), bricks["evictions"].get<int>(), bricks["load_ms"].get<double>() / 1e3);
    EXPECT_LT(gib, kMostGib);
    EXPECT_LE(bricks["resident"].get<std::uint64_t>(), bricks["slots"].get<std::uint64_t>());
    return read_image(exr);
  }

  /// The pictures through both pools are one; evictions of the small pool to `evictions`.
  Image same_pictures(const Arguments& look, json& told) const {
    fmt::print("| | --pool | peak, GiB | bounds, s | rounds | loads | evictions | loading, s |\n");
    json roomy;
    const Image small = picture(look, "64M", told), large = picture(look, "256M", roomy);
    EXPECT_EQ(small.pixels, large.pixels);
    EXPECT_LE(roomy["bricks"]["evictions"], told["bricks"]["evictions"]);
    EXPECT_GT(told["bricks"]["evictions"], 0) << "the pool of 64 MiB was too large";
    return small;
  }

  const TemporaryFolder folder;
  const std::string volume = folder / "large.nrrd", tf = folder / "tf.json";
  // Sample (i, j, k) is number (k 1700 + j) 1700 + i: 2^32 is in the plane k = 1486.
  const std::vector<Shell> shells{{glm::dvec3(170.0)}, {{850.0, 850.0, 1486.0}}, {{1500.0, 300.0, 1525.0}}};
  const Bar bar{{100.0, 1680.0, 1680.0}, {1685.0, 1686.0, 1686.0}};
};

TEST_F(LargeRender, ShowsIsosurfacesWhereTheyAre) {
  json told;
  const Image image = same_pictures({"--iso", fmt::format("{}", kIsovalue)}, told);
  const auto vector = [&](const char* key) { return glm::dvec3(told["camera"][key][0], told["camera"][key][1], told["camera"][key][2]); };
  const Camera camera{vector("eye"), vector("target"), vector("up"), told["camera"]["fov"]};
  const CameraFrame frame = camera_frame(camera, kSize, kSize);
  std::vector<int> hits(4);
  double worst = 0.0;
  const int z = image.channel("Z");
  for (int j = 0; j < kSize; ++j)
    for (int i = 0; i < kSize; ++i) {
      const double depth = image.pixels[(std::size_t(j) * kSize + std::size_t(i)) * image.channels.size() + std::size_t(z)];
      if (!std::isfinite(depth)) continue;
      const glm::dvec3 u = camera.eye + depth * pixel_direction(frame, kSize, kSize, i, j);
      std::vector<double> off{std::abs(bar.distance(u))};
      for (const Shell& s : shells) off.push_back(std::abs(s.distance(u)));
      const auto least = std::min_element(off.begin(), off.end());
      ++hits[std::size_t(least - off.begin())];
      worst = std::max(worst, *least);
    }
  EXPECT_LT(worst, 0.5) << "cells from where a surface is";
  EXPECT_GT(*std::min_element(hits.begin(), hits.end()), 50);
}

TEST_F(LargeRender, GoesThroughAPoolWithoutBeingToldTo) {
  const Outcome outcome = run({"render", volume, "-o", folder / "x.png", "--iso", fmt::format("{}", kIsovalue), "--block", "16", "--size", "64", "64"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("rendered through a pool of 1.0 GiB (--pool)"), std::string::npos) << outcome.err;
  EXPECT_LT(double(outcome.peak_bytes), 2.0 * (1 << 30));
}

TEST_F(LargeRender, ShowsTheVolume) {
  json told;
  const Image image = same_pictures({"--tf", tf}, told);
  EXPECT_GT(told["hits"], 1000);
}

}  // namespace
}  // namespace quincunx::test
