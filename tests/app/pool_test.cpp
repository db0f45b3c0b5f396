// Volumes that are not in memory: `render --pool`, through the whole program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>

#include "io/image_file.h"
#include "io/volume_file.h"
#include "program.h"

namespace quincunx::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// A folder with a Cartesian volume of 12 x 11 x 10 samples (v.nrrd, isovalue 0) and a transfer function for it (tf.json).
class Pool : public ProgramInFolder {
 protected:
  static double hills(const glm::dvec3& x) { return std::sin(0.5 * x.x) + std::cos(0.4 * x.y) * std::sin(0.3 * x.z + 1.0); }

  void SetUp() override {
    write_volume(make_volume(LatticeKind::cartesian, {12, 11, 10}, {}, hills), volume, Encoding::raw);
    write_file(tf, R"({"colors": [[-1, "#3060c0"], [1, "#f0a030"]], "opacities": [[0.2, 0], [0.7, 0.3], [1.2, 0]]})");
  }

  Arguments render(const Arguments& more) const {
    Arguments arguments{"render", volume, "-o", out, "--iso", "0", "--size", "16", "16"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  /// The picture that `arguments` make, and what --json tells of it.
  std::pair<Image, json> picture(Arguments arguments) const {
    const std::string exr = folder / "picture.exr";
    arguments.insert(arguments.begin(), "render");
    arguments.insert(arguments.end(), {"-o", exr, "--json", "--quiet"});
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return {read_image(exr), json::parse(outcome.out)};
  }

  const std::string volume = folder / "v.nrrd", tf = folder / "tf.json", out = folder / "out.png";
};

TEST_F(Pool, ReadsNothingBeyondItsSlotsWhileBricksAreMissing) {
  // The layer checks what kernels index: a cell whose brick is not there yet has no coefficients of its own to be read.
  const TemporaryFolder own;
  const Outcome outcome = run({"render", QUINCUNX_SOURCE_DIR "/data/neghip_bcc.nrrd", "--iso", "40", "--pool", "256K", "--brick", "16", "--size", "24", "24", "--validate", "-o", own / "pool.exr"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST_F(Pool, ShowsAVolumeOfFourTimesItsSizeAsItIs) {
  const std::string large = folder / "large.nrrd";  // 160^3 coefficients are 15.6 MiB and more
  write_volume(make_volume(LatticeKind::cartesian, {160, 160, 160}, {}, [](const glm::dvec3& x) { return hills(0.15 * x); }), large, Encoding::raw);
  for (const Arguments& look : {Arguments{"--iso", "0.3"}, {"--tf", tf}, {"--iso", "0.9,-0.5", "--opacity", "0.5", "--tf", tf}}) {
    Arguments plain{large, "--size", "64", "64", "--spline", "trilinear"}, pooled = plain;
    plain.insert(plain.end(), look.begin(), look.end());
    pooled.insert(pooled.end(), look.begin(), look.end());
    pooled.insert(pooled.end(), {"--pool", "4M"});
    const auto [truth, unused] = picture(plain);
    const auto [found, told] = picture(pooled);
    EXPECT_EQ(found.pixels, truth.pixels) << testing::PrintToString(look);
    EXPECT_GT(told["hits"], 500);
    const json& bricks = told["bricks"];
    EXPECT_EQ(bricks["count"], 125);
    EXPECT_EQ(bricks["slots"], 29);  // 4 MiB of 33^3 floats
    EXPECT_EQ(bricks["resident"].get<int>() + bricks["evictions"].get<int>(), bricks["loads"].get<int>());
    EXPECT_GT(bricks["loads"], bricks["slots"]);
  }
}

TEST_F(Pool, UnpacksAPackedVolumeWhereItIsTold) {
  const std::string packed = folder / "packed.nrrd";
  write_volume(make_volume(LatticeKind::cartesian, {12, 11, 10}, {}, hills), packed, Encoding::gzip);
  const TemporaryFolder scratch;
  const Arguments look{"--iso", "0", "--size", "16", "16", "--pool", "1M", "--brick", "4"};
  Arguments plain = look, unpacked = look;
  plain.insert(plain.begin(), volume);
  unpacked.insert(unpacked.begin(), packed);
  unpacked.insert(unpacked.end(), {"--scratch", scratch / "."});
  EXPECT_EQ(picture(unpacked).first.pixels, picture(plain).first.pixels);
  EXPECT_TRUE(scratch.names().empty());
  expect_refused({"render", packed, "-o", out, "--iso", "0", "--pool", "1M", "--scratch", folder / "none"}, {"--scratch", "none"});
}

TEST_F(Pool, NamesWhatItTakesForOneBrick) {
  const auto refused = [&](const Arguments& spline, const std::string& bytes) {
    Arguments arguments = render({"--pool", bytes, "--brick", "8"});
    arguments.insert(arguments.end(), spline.begin(), spline.end());
    return run(arguments).err;
  };
  for (const Arguments& spline : {Arguments{}, {"--spline", "tricubic"}}) {
    const std::string message = refused(spline, "10");
    std::smatch least;
    ASSERT_TRUE(std::regex_search(message, least, std::regex("--pool: found 10 bytes, expected at least ([0-9]+) bytes"))) << message;
    const std::string bytes = least[1];
    EXPECT_THAT(refused(spline, std::to_string(std::stoll(bytes) - 1)), HasSubstr("at least " + bytes));
    Arguments enough{volume, "--iso", "0", "--size", "16", "16"};
    enough.insert(enough.end(), spline.begin(), spline.end());
    const Image truth = picture(enough).first;
    enough.insert(enough.end(), {"--brick", "8", "--pool", bytes});
    const auto [found, told] = picture(enough);
    EXPECT_EQ(found.pixels, truth.pixels);
    EXPECT_EQ(told["bricks"]["slots"], 1);
  }
}

TEST_F(Pool, HasNoMoreSlotsThanBricks) {
  const auto [unused, told] = picture({volume, "--iso", "0", "--size", "16", "16", "--pool", "1T", "--brick", "4"});
  EXPECT_EQ(told["bricks"]["slots"], 3 * 3 * 3);
  EXPECT_EQ(told["bricks"]["count"], 3 * 3 * 3);
  EXPECT_EQ(told["bricks"]["evictions"], 0);
}

TEST_F(Pool, HoldsMoreBricksOfFewerBits) {
  // Bricks of 5^3 coefficients: 500 bytes of floats.
  for (const auto& [storage, slots] : {std::pair{"float32", 10}, {"unorm16", 20}, {"unorm8", 27}}) {
    const auto [image, told] = picture({volume, "--iso", "0", "--size", "16", "16", "--pool", "5000", "--brick", "4", "--spline", "trilinear", "--storage", storage});
    EXPECT_EQ(told["bricks"]["slots"], slots) << storage;
    EXPECT_EQ(told["storage"], storage);
    EXPECT_GT(told["hits"], 50);
  }
}

TEST_F(Pool, OfNoSizeIsRefused) {
  for (const std::string bad : {"0", "10", "many", "-5M", "", "4MB", "nan", "1e3", "99999T"})
    expect_refused(render({"--pool=" + bad}), {"--pool", bad});
  for (const std::string bad : {"3", "512", "12", "0", "-8", "large"})
    expect_refused(render({"--pool", "1M", "--brick=" + bad}), {"--brick", bad, "4 to 256"});
  expect_refused(render({"--pool", "1M", "--brick="}), {"--brick", "required N missing"});
}

TEST_F(Pool, RefusesWhatNeedsTheWholeVolume) {
  expect_refused(render({"--pool", "1M", "--intersect", "march"}), {"--pool", "march"});
  expect_refused(render({"--pool", "1M", "--normal", "central"}), {"--pool", "central"});
  expect_refused(render({"--pool", "1M", "--device", "cpu"}), {"--pool", "--device cpu"});
}

TEST_F(Pool, NamesThePlaceOfSamplesThatAreNotFinite) {
  Volume broken = make_volume(LatticeKind::cartesian, {12, 11, 10}, {}, hills);
  std::get<std::vector<float>>(broken.samples)[(9 * 11 + 8) * 12 + 7] = std::numeric_limits<float>::quiet_NaN();
  const std::string nan = folder / "nan.nrrd";
  write_volume(broken, nan);
  for (const std::string structure : {"none", "auto", "octree"})
    expect_refused({"render", nan, "-o", out, "--iso", "0", "--pool", "1M", "--skip", structure}, {"nan.nrrd", "1 NaN or infinite of 1320", "index (7, 8, 9)"});
}

TEST_F(Pool, EndsAtCtrlCAndLeavesNothing) {
  const std::string packed = folder / "packed.nrrd";
  write_volume(make_volume(LatticeKind::bcc, {64, 64, 64}, {}, hills), packed);
  const auto before = folder.names();
  const TemporaryFolder scratch;
  // One slot for 32768 bricks: rounds without end.
  const auto first = std::chrono::steady_clock::now();
  const auto later = [&] { return std::chrono::steady_clock::now() > first + std::chrono::milliseconds(1500); };
  const Outcome outcome = run_and_signal({"render", packed, "--tf", tf, "--pool", "5000", "--brick", "4", "-o", out, "--scratch", scratch / "."}, SIGINT, later);
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_EQ(folder.names(), before);
  EXPECT_TRUE(scratch.names().empty());
}

}  // namespace
}  // namespace quincunx::test
