#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/render_flags.h"
#include "app/render_report.h"

namespace quincunx {
namespace {

using testing::HasSubstr;

TEST(Report, InterleavesTheFramesPlanesAsNamedChannels) {
  const Frame frame{.width = 2,
                    .height = 1,
                    .color = {1, 2, 3, 4, 11, 12, 13, 14},
                    .depth = {5, 15},
                    .normal = {6, 7, 8, 16, 17, 18},
                    .cost = {}};
  const Image image = to_image(frame);
  EXPECT_EQ(image.channels, (std::vector<std::string>{"R", "G", "B", "A", "Z", "N.X", "N.Y", "N.Z"}));
  EXPECT_EQ(image.pixels, (std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8, 11, 12, 13, 14, 15, 16, 17, 18}));
}

TEST(Report, LeavesTheOpacityOutOfAnOpaquePicture) {
  const Frame frame{
      .width = 2, .height = 1, .color = {1, 2, 3, 4, 11, 12, 13, 14}, .depth = {}, .normal = {}, .cost = {}};
  EXPECT_EQ(to_opaque_image(frame).pixels, (std::vector<float>{1, 2, 3, 11, 12, 13}));
}

TEST(Report, AddsTheCostChannelsWhereTheFrameHasThem) {
  const Frame frame{
      .width = 1, .height = 1, .color = {1, 2, 3, 4}, .depth = {5}, .normal = {6, 7, 8}, .cost = {9, 10, 11}};
  const Image image = to_image(frame);
  ASSERT_EQ(image.channels.size(), 11u);
  EXPECT_EQ(image.channels[8], "cost.evaluations");
  EXPECT_EQ(image.channels[10], "cost.intervals");
  EXPECT_EQ(image.pixels[9], 10.0f);
}

TEST(Report, TakesPercentilesBetweenTheNeighbouringValues) {
  const std::vector<double> values{4.0, 1.0, 3.0, 2.0};
  EXPECT_EQ(percentile(values, 0.0), 1.0);
  EXPECT_EQ(percentile(values, 0.5), 2.5);
  EXPECT_EQ(percentile(values, 1.0), 4.0);
  EXPECT_EQ(percentile({7.0}, 0.95), 7.0);
}

TEST(Report, ExplainsWhatIsInBeforeWhatIsOut) {
  const std::string text = explain_text({{"compositing", false, "one opaque surface"}, {"bcc7", true, "the spline"}});
  EXPECT_LT(text.find("in   bcc7"), text.find("out  compositing"));
  EXPECT_THAT(text, HasSubstr("one opaque surface"));
}

TEST(Palette, LetsTheEyeThroughToTheHighestIsovalue) {
  RenderFlags flags;
  flags.isovalues = {700.0, 130.0, 300.0};
  const std::vector<Isosurface> surfaces = make_isosurfaces(flags);
  ASSERT_EQ(surfaces.size(), 3u);
  EXPECT_EQ(surfaces[0].isovalue, 700.0);
  EXPECT_EQ(surfaces[0].opacity, 1.0);
  EXPECT_LT(surfaces[1].opacity, 0.5);
  EXPECT_LT(surfaces[2].opacity, 0.5);
  EXPECT_NE(surfaces[1].color, surfaces[2].color);
}

TEST(Palette, GivesWayToColoursAndOpacitiesThatWereAskedFor) {
  RenderFlags flags;
  flags.isovalues = {1.0, 2.0};
  flags.colors = {{1, 0, 0}, {0, 1, 0}};
  flags.opacities = {0.75};
  const std::vector<Isosurface> surfaces = make_isosurfaces(flags);
  EXPECT_EQ(surfaces[1].color, glm::dvec3(0, 1, 0));
  EXPECT_EQ(surfaces[0].opacity, 0.75);
  EXPECT_EQ(surfaces[1].opacity, 0.75);
}

TEST(Palette, LeavesASingleSurfaceOpaque) {
  RenderFlags flags;
  flags.isovalues = {1.0};
  EXPECT_EQ(make_isosurfaces(flags).front().opacity, 1.0);
}

}  // namespace
}  // namespace quincunx
