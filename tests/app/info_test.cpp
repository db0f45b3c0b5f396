#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "io/volume_file.h"
#include "program.h"

namespace quincunx::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// 2 x 3 x 4 samples a coset, uint8 0..47 in file order; coset steps 2, 4, 6, so cells of 1 x 2 x 3.
Volume counted_volume() {
  Volume volume{.lattice = LatticeKind::bcc, .extents = {2, 3, 4}, .world = {}, .samples = {}, .notes = {}};
  volume.world = {.origin = {10.0, 20.0, 30.0}, .axes = glm::dmat3(1, 0, 0, 0, 2, 0, 0, 0, 3)};
  std::vector<std::uint8_t> samples(48);
  for (std::size_t n = 0; n < samples.size(); ++n) samples[n] = std::uint8_t(n);
  volume.samples = std::move(samples);
  volume.notes = {{"provenance", "counted"}};
  return volume;
}

TEST(Info, TellsWhatTheFileHoldsAsJson) {
  const TemporaryFolder folder;
  write_volume(counted_volume(), folder / "v.nrrd");
  const Outcome outcome = run({"info", folder / "v.nrrd", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json info = json::parse(outcome.out);
  EXPECT_EQ(info["lattice"], "bcc");
  EXPECT_EQ(info["extents"], json({2, 3, 4}));
  EXPECT_EQ(info["samples"], 48);
  EXPECT_EQ(info["type"], "uint8");
  EXPECT_EQ(info["domain"], json({3, 5, 7}));
  EXPECT_EQ(info["spacing"], json({2.0, 4.0, 6.0}));
  EXPECT_EQ(info["axes"], json::parse("[[1,0,0],[0,2,0],[0,0,3]]"));
  EXPECT_EQ(info["world_box"]["min"], json({10.0, 20.0, 30.0}));
  EXPECT_EQ(info["world_box"]["max"], json({13.0, 30.0, 51.0}));
  EXPECT_EQ(info["range"], json({0.0, 47.0}));
  EXPECT_EQ(info["not_finite"], 0);
  EXPECT_EQ(info["memory"]["samples_bytes"], 48);
  // bcc7 reaches one sample beyond each side: 2 x (4 x 5 x 6) floats.
  EXPECT_EQ(info["memory"]["coefficients_bytes"], 2 * 4 * 5 * 6 * 4);
  EXPECT_EQ(info["notes"]["provenance"], "counted");
}

TEST(Info, ShowsQuantilesInAscendingOrderWithinTheRange) {
  const TemporaryFolder folder;
  write_volume(counted_volume(), folder / "v.nrrd");
  const json quantiles = json::parse(run({"info", folder / "v.nrrd", "--json"}).out)["quantiles"];
  double before = 0.0;
  for (const std::string key : {"p1", "p5", "p25", "p50", "p75", "p95", "p99"}) {
    ASSERT_TRUE(quantiles.contains(key)) << key;
    EXPECT_GE(quantiles[key].get<double>(), before) << key;
    before = quantiles[key].get<double>();
  }
  EXPECT_LE(before, 47.0);
  EXPECT_NEAR(quantiles["p50"].get<double>(), 23.5, 0.5);
  EXPECT_NEAR(quantiles["p95"].get<double>(), 0.95 * 47.0, 1.0);
}

TEST(Info, PrintsTheSameForPeople) {
  const TemporaryFolder folder;
  write_volume(counted_volume(), folder / "v.nrrd");
  const std::string text = run({"info", folder / "v.nrrd"}).out;
  for (const std::string part : {"bcc", "2 x 3 x 4 x 2 cosets = 48 samples", "uint8", "3 x 5 x 7 cells", "(2, 4, 6)",
                                 "(10, 20, 30) to (13, 30, 51)", "0 to 47", "provenance: counted"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
}

TEST(Info, CountsSamplesThatAreNotFiniteInsteadOfRefusingThem) {
  const TemporaryFolder folder;
  Volume volume = make_volume(LatticeKind::bcc, {2, 2, 2}, {}, [](const glm::dvec3& x) { return x.x; });
  auto& samples = std::get<std::vector<float>>(volume.samples);
  samples[3] = std::numeric_limits<float>::quiet_NaN();
  samples[5] = std::numeric_limits<float>::infinity();
  write_volume(volume, folder / "v.nrrd");
  const Outcome outcome = run({"info", folder / "v.nrrd", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(json::parse(outcome.out)["not_finite"], 2);
}

}  // namespace
}  // namespace quincunx::test
