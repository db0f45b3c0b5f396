#include "app/heat.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "program.h"

namespace quincunx::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::Each;
using testing::FloatEq;
using testing::HasSubstr;
using testing::Not;

const std::string neghip = QUINCUNX_SOURCE_DIR "/data/neghip_bcc.nrrd";
constexpr int width = 96, height = 80;

/// Two pixels whose rays cost 7 and 8, 9 and 12, 5 and 2.
const Frame two_pixels{.width = 2, .height = 1, .color = {}, .depth = {}, .normal = {}, .cost = {7, 9, 5, 8, 12, 2}};

RenderStats with_grid() {
  RenderStats stats;
  stats.skip.structure = "grid";
  stats.blocks = 8 * 6 * 6;
  stats.block_extents = {8, 6, 6};
  return stats;
}

TEST(Heat, TakesItsNumbersFromTheCostChannels) {
  const auto values = [](HeatKind kind) { return make_heat(kind, two_pixels, {}, with_grid()).values; };
  EXPECT_EQ(values(HeatKind::evaluations), (std::vector<float>{7, 8}));
  EXPECT_EQ(values(HeatKind::steps), (std::vector<float>{9, 12}));
  EXPECT_EQ(values(HeatKind::intervals), (std::vector<float>{5, 2}));
  EXPECT_EQ(values(HeatKind::depth), (std::vector<float>{0.25f, 0.1f}));  // over 8 + 6 + 6 blocks
}

TEST(Heat, SaysWhatTheNumbersAreAndHowLarge) {
  Scene scene;
  const auto title = [&](HeatKind kind) { return make_heat(kind, two_pixels, scene, with_grid()).title; };
  EXPECT_EQ(title(HeatKind::evaluations), "polynomial pieces evaluated along a ray: mean 7.5, max 8");
  EXPECT_EQ(title(HeatKind::steps), "steps of the walk along a ray (grid): mean 10.5, max 12");
  EXPECT_EQ(title(HeatKind::intervals), "intervals that a ray meets (grid): mean 3.5, max 5");
  scene.intersect = Intersect::march;
  EXPECT_THAT(title(HeatKind::evaluations), HasSubstr("samples of the spline"));
  scene.stub_sampling = true;
  EXPECT_THAT(title(HeatKind::intervals), HasSubstr("the whole ray"));
  EXPECT_EQ(title(HeatKind::depth),
            "depth complexity (grid): intervals that the whole ray meets over 8 + 6 + 6 blocks: mean 0.175, max 0.25");
}

TEST(Heat, SumsUpWhatItShows) {
  HeatMap map{.width = 101, .height = 1, .values = std::vector<float>(101), .title = {}, .maximum = {}};
  std::iota(map.values.begin(), map.values.end(), 0.0f);
  const json summary = heat_json(HeatKind::depth, map);
  EXPECT_EQ(summary["kind"], "depth");
  EXPECT_EQ(summary["max"], 100.0);
  EXPECT_EQ(summary["mean"], 50.0);
  EXPECT_EQ(summary["p99"], 99.0);
}

/// `render` of neghip with more arguments.
Outcome render(const Arguments& more) {
  Arguments arguments{"render", neghip, "--iso", "40", "--size", fmt::format("{}", width), fmt::format("{}", height)};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run(arguments);
}

std::vector<float> channel_of(const Image& image, const std::string& name) {
  const auto found = std::find(image.channels.begin(), image.channels.end(), name);
  if (found == image.channels.end()) throw std::runtime_error("no channel " + name);
  std::vector<float> values;
  for (std::size_t i = std::size_t(found - image.channels.begin()); i < image.pixels.size(); i += image.channels.size())
    values.push_back(image.pixels[i]);
  return values;
}

/// Luminance of the map's part of a heat picture; the scale is ever lighter.
std::vector<float> lightness(const Image& picture) {
  std::vector<float> values;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float* c = picture.pixels.data() + 3 * (std::size_t(y) * std::size_t(picture.width) + std::size_t(x));
      values.push_back(0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2]);
    }
  }
  return values;
}

/// Pixels in the order of their values have colours in the order of their lightness, and equal ones where values are equal.
/// Rounding to 8 bits may turn neighbours on the scale around a little.
void expect_colours_follow(const std::vector<float>& values, const std::vector<float>& light) {
  ASSERT_EQ(values.size(), light.size());
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  for (std::size_t i = 1; i < order.size(); ++i) {
    const std::size_t before = order[i - 1], p = order[i];
    if (values[before] == values[p]) {
      ASSERT_EQ(light[before], light[p]) << values[p];
    } else {
      ASSERT_GE(light[p], light[before] - 0.01f) << values[before] << " and " << values[p];
    }
  }
  EXPECT_GT(light[order.back()], light[order.front()] + 0.3f);
}

class HeatPictures : public testing::Test {
 protected:
  const TemporaryFolder folder;
  const std::string png = folder / "heat.png", exr = folder / "all.exr", stats = folder / "stats.json";
};

TEST_F(HeatPictures, FollowTheCostChannelsOfTheExr) {
  for (const std::string kind : {"evaluations", "steps", "intervals", "depth"}) {
    const Outcome outcome = render({"--skip", "grid", "--block", "8", "--heat", kind, "-o", png, "-o", exr, "--stats", stats});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const std::string channel = kind == "depth" ? "intervals" : kind;
    const std::vector<float> values = channel_of(read_image(exr), "cost." + channel);
    const Image picture = read_image(png);
    EXPECT_EQ(picture.channels.size(), 3u);
    expect_colours_follow(values, lightness(picture));

    const json summary = json::parse(read_file(stats)).at("heat");
    const double unit = kind == "depth" ? 8 + 8 + 8 : 1;  // 63 cells an axis in blocks of 8
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    EXPECT_EQ(summary["kind"], kind);
    EXPECT_NEAR(summary["max"], *std::max_element(values.begin(), values.end()) / unit, 1e-6);
    EXPECT_NEAR(summary["mean"], sum / double(values.size()) / unit, 1e-6);
    EXPECT_LE(summary["p99"], summary["max"]);
  }
}

TEST_F(HeatPictures, AreTheSizeOfTheMapWithItsScaleAndTitle) {
  ASSERT_EQ(render({"--skip", "grid", "--heat", "steps", "-o", png, "-o", exr, "--background", "1,0,0"}).status, 0);
  Frame frame{.width = width, .height = height, .color = {}, .depth = {}, .normal = {}, .cost = {}};
  for (const float steps : channel_of(read_image(exr), "cost.steps")) frame.cost.insert(frame.cost.end(), {0.0f, steps, 0.0f});
  const HeatMap map = make_heat(HeatKind::steps, frame, {}, with_grid());
  const HeatLayout layout = heat_layout(map, heat_scale(map));
  const Image picture = read_image(png);
  EXPECT_EQ(picture.width, layout.width);
  EXPECT_EQ(picture.height, layout.height);
}

TEST_F(HeatPictures, LeaveTheOtherChannelsAsTheyAre) {
  const std::string plain = folder / "plain.exr";
  ASSERT_EQ(render({"--heat", "intervals", "-o", png, "-o", exr}).status, 0);
  ASSERT_EQ(render({"--cost", "-o", plain}).status, 0);
  EXPECT_EQ(read_image(exr).channels, read_image(plain).channels);
  EXPECT_EQ(read_image(exr).pixels, read_image(plain).pixels);
}

TEST_F(HeatPictures, OfTheReferenceShowItsOwnCosts) {
  const Outcome outcome = run({"render", neghip, "--iso", "40", "--size", "24", "20", "--device", "cpu", "--heat", "evaluations", "-o", png});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_GT(read_image(png).width, 24);
}

TEST_F(HeatPictures, OfDepthWalkToTheEndAndHitNothing) {
  const Outcome outcome = render({"--heat", "depth", "-o", png, "-o", exr});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("nothing evaluated"), Not(HasSubstr("hit"))));
  EXPECT_THAT(channel_of(read_image(exr), "A"), Each(FloatEq(0.0f)));
  EXPECT_THAT(channel_of(read_image(exr), "cost.evaluations"), Each(FloatEq(0.0f)));

  const Outcome whole = render({"--stub-sampling", "--cost", "-o", folder / "stub.exr"});
  ASSERT_EQ(whole.status, 0) << whole.err;
  EXPECT_EQ(read_image(folder / "stub.exr").pixels, read_image(exr).pixels);
  // A ray that stops at its hit meets no more than the whole ray, and some meet less.
  ASSERT_EQ(render({"--cost", "-o", folder / "hits.exr"}).status, 0);
  const std::vector<float> all = channel_of(read_image(exr), "cost.intervals");
  const std::vector<float> some = channel_of(read_image(folder / "hits.exr"), "cost.intervals");
  EXPECT_LT(std::accumulate(some.begin(), some.end(), 0.0), 0.9 * std::accumulate(all.begin(), all.end(), 0.0));
}

TEST_F(HeatPictures, AreRefusedWhereThereIsNothingToShowOrNoPlaceForIt) {
  const std::vector<std::pair<Arguments, std::string>> cases{
      {{"--heat", "steps", "-o", exr}, "-o OUT.png"},
      {{"--heat", "steps", "--stats", stats}, "-o OUT.png"},
      {{"--heat", "warmth", "-o", png}, "evaluations, steps, intervals, depth"},
      {{"--heat", "evaluations", "--stub-sampling", "-o", png}, "--stub-sampling"},
      {{"--heat", "intervals", "--skip", "none", "-o", png}, "--skip none"},
      {{"--heat", "depth", "--skip", "none", "-o", png}, "--skip none"},
      {{"--heat", "depth", "--device", "cpu", "-o", png}, "--device cpu"}};
  for (auto [arguments, expected] : cases) {
    arguments.insert(arguments.begin(), {neghip, "--iso", "40"});
    EXPECT_THAT(render_refusal(arguments), AllOf(HasSubstr("--heat"), HasSubstr("found"), HasSubstr("expected"), HasSubstr(expected)));
  }
  const Outcome outcome = render({"--heat", "steps", "-o", exr});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--heat"));
  EXPECT_TRUE(folder.names().empty());
}

TEST_F(HeatPictures, StubSamplingIsRefusedByTheReference) {
  const Outcome outcome = render({"--stub-sampling", "--device", "cpu", "-o", png});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("--stub-sampling"), HasSubstr("cpu")));
}

}  // namespace
}  // namespace quincunx::test
