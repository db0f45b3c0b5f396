#include "io/heat_image.h"

#include <cmath>

#include "tests/io/test_files.h"

namespace quincunx {
namespace {

using testing::ElementsAre;

/// A map whose values rise evenly from 0 at the left to `largest` at the right.
HeatMap ramp(int width, int height, float largest) {
  HeatMap map{.width = width, .height = height, .values = {}, .title = "numbers of a ramp", .maximum = {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) map.values.push_back(width > 1 ? largest * float(x) / float(width - 1) : largest);
  }
  return map;
}

HeatMap one_value(int width, int height, float value) {
  const std::size_t pixels = std::size_t(width) * std::size_t(height);
  return {.width = width, .height = height, .values = std::vector<float>(pixels, value), .title = "one value", .maximum = {}};
}

std::vector<float> color(const Image& image, int x, int y) {
  const auto first = image.pixels.begin() + 3 * (std::ptrdiff_t(y) * image.width + x);
  return {first, first + 3};
}

/// Rec. 709, linear.
double luminance(const Image& image, int x, int y) {
  const std::vector<float> c = color(image, x, y);
  return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

/// How many pixels of the rectangle are darker than a quarter of white.
int dark_pixels(const Image& image, int left, int right, int top, int bottom) {
  int count = 0;
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) count += luminance(image, x, y) < 0.25 ? 1 : 0;
  }
  return count;
}

std::vector<std::string> labels(const HeatMap& map) {
  std::vector<std::string> found;
  for (const HeatLayout::Tick& tick : heat_layout(map, heat_scale(map)).ticks) found.push_back(tick.label);
  return found;
}

TEST(HeatScale, EndsAtARoundNumberThatHoldsTheValues) {
  EXPECT_THAT(labels(ramp(512, 512, 93.0f)), ElementsAre("0", "10", "20", "30", "40", "50", "60", "70", "80", "90", "100"));
  EXPECT_THAT(labels(ramp(512, 512, 0.43f)), ElementsAre("0", "0.05", "0.1", "0.15", "0.2", "0.25", "0.3", "0.35", "0.4", "0.45"));
  EXPECT_THAT(labels(ramp(64, 64, 501.0f)), ElementsAre("0", "200", "400", "600"));  // little room: fewer ticks
  EXPECT_THAT(labels(one_value(512, 512, 200.0f)), ElementsAre("0", "20", "40", "60", "80", "100", "120", "140", "160", "180", "200"));
}

TEST(HeatScale, GivesWholeNumbersWholeSteps) {
  EXPECT_THAT(labels(one_value(512, 512, 2.0f)), ElementsAre("0", "1", "2"));
  EXPECT_EQ(heat_scale(one_value(512, 512, 2.5f)).step, 0.5);
}

TEST(HeatScale, IsNotStretchedByAnOutlierAndSaysThatThereIsOne) {
  HeatMap map = one_value(100, 100, 40.0f);
  map.values[1234] = 1e6f;
  EXPECT_EQ(heat_scale(map).maximum, 40.0);
  EXPECT_TRUE(heat_scale(map).exceeded);
  EXPECT_EQ(labels(map).back(), "40+");
  for (std::size_t i = 0; i < 100; ++i) map.values[i] = 1e6f;  // 1 % of them are no outliers
  EXPECT_EQ(heat_scale(map).maximum, 1e6);
  EXPECT_FALSE(heat_scale(map).exceeded);
}

TEST(HeatScale, ShowsASingleHotPixelAmongZeros) {
  HeatMap map = one_value(100, 100, 0.0f);
  map.values[17] = 8.0f;
  EXPECT_EQ(heat_scale(map).maximum, 8.0);
}

TEST(HeatScale, EndsWhereItIsToldTo) {
  HeatMap map = ramp(512, 512, 93.0f);
  map.maximum = 250.0;
  EXPECT_EQ(heat_scale(map).maximum, 250.0);
  EXPECT_THAT(labels(map), ElementsAre("0", "50", "100", "150", "200", "250"));
  map.maximum = 45.0;  // halfway through the map
  EXPECT_EQ(labels(map).back(), "45+");
  const HeatPicture picture = draw_heat(map);
  EXPECT_EQ(color(picture.image, 400, 3), color(picture.image, 511, 3));
  EXPECT_NE(color(picture.image, 200, 3), color(picture.image, 511, 3));
}

TEST(HeatImage, IsTheMapWithABarAtItsRightAndTheTitleBelow) {
  for (const auto& [width, height] : {std::pair(64, 64), std::pair(640, 480), std::pair(100, 700), std::pair(1, 1)}) {
    const HeatMap map = ramp(width, height, 30.0f);
    const HeatLayout layout = heat_layout(map, heat_scale(map));
    const Image image = draw_heat(map).image;
    EXPECT_EQ(image.channels, (std::vector<std::string>{"R", "G", "B"}));
    EXPECT_EQ(image.width, layout.width);
    EXPECT_EQ(image.height, layout.height);
    EXPECT_GE(layout.bar_height, height);
    EXPECT_GT(layout.bar_left, width);
    EXPECT_GT(layout.width, layout.bar_left + layout.bar_width);
    EXPECT_GT(layout.height, layout.bar_height);
    EXPECT_EQ(color(image, width, 0), (std::vector<float>{1, 1, 1}));  // the gap
  }
}

TEST(HeatImage, GrowsItsTextWithThePictureFromNinePixelsOn) {
  const auto text = [](int width, int height) {
    const HeatMap map = one_value(width, height, 1.0f);
    return heat_layout(map, heat_scale(map)).text;
  };
  EXPECT_EQ(text(1, 1), 9);
  EXPECT_EQ(text(64, 64), 9);
  EXPECT_EQ(text(640, 480), 15);
  EXPECT_EQ(text(480, 640), 15);
  EXPECT_EQ(text(2048, 2048), 64);
}

TEST(HeatImage, GetsLighterWithTheValue) {
  const Image image = draw_heat(ramp(600, 64, 600.0f)).image;
  for (int x = 1; x < 600; ++x) ASSERT_GT(luminance(image, x, 2), luminance(image, x - 1, 2)) << x;
  EXPECT_LT(luminance(image, 0, 0), 0.001);
  EXPECT_GT(luminance(image, 599, 0), 0.8);
}

TEST(HeatImage, GivesEqualValuesEqualColours) {
  HeatMap map = ramp(90, 40, 7.0f);
  const Image image = draw_heat(map).image;
  for (int x = 0; x < 90; ++x) {
    for (int y = 1; y < 40; ++y) ASSERT_EQ(color(image, x, y), color(image, x, 0));
  }
}

class HeatImageFile : public FileTest {};

TEST_F(HeatImageFile, HasTheColoursOfInfernoInThePng) {
  // The ends of the published table: (0.001462, 0.000466, 0.013866) and (0.988362, 0.998364, 0.644924).
  write_image(draw_heat(ramp(64, 64, 10.0f)).image, path("heat.png"));
  const Image png = read_image(path("heat.png"));
  const std::vector<float> low = color(png, 0, 0), high = color(png, 63, 0);
  const std::vector<double> first{0.001462, 0.000466, 0.013866}, last{0.988362, 0.998364, 0.644924};
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(low[c], first[c], 0.0055) << c;
    EXPECT_NEAR(high[c], last[c], 0.0055) << c;
  }
}

TEST(HeatImage, HasTheMapsColoursInTheBar) {
  // Each row of the map has the value that the bar stands for in this row, the maximum at the top.
  constexpr int height = 200;
  HeatMap map{.width = 3, .height = height, .values = {}, .title = "", .maximum = 50.0};
  for (int y = 0; y < height; ++y) map.values.insert(map.values.end(), 3, float(50.0 * (height - 0.5 - y) / height));
  const Image image = draw_heat(map).image;
  const HeatLayout layout = heat_layout(map, heat_scale(map));
  ASSERT_EQ(layout.bar_height, height);
  for (int y = 0; y < height; ++y) {
    ASSERT_EQ(color(image, layout.bar_left, y), color(image, 0, y)) << y;
    ASSERT_EQ(color(image, layout.bar_left + layout.bar_width - 1, y), color(image, 2, y)) << y;
  }
}

TEST(HeatImage, HasATickWhereTheBarHasItsValue) {
  const HeatMap map = one_value(320, 320, 40.0f);
  const HeatLayout layout = heat_layout(map, heat_scale(map));
  const Image image = draw_heat(map).image;
  const int column = layout.bar_left + layout.bar_width;
  for (const HeatLayout::Tick& tick : layout.ticks) {
    EXPECT_EQ(tick.row, int(std::lround(320.0 * (1.0 - tick.value / 40.0))));
    EXPECT_EQ(luminance(image, column, std::min(tick.row, 319)), 0.0) << tick.label;
  }
  // And nowhere else: one row each, white between.
  EXPECT_EQ(dark_pixels(image, column, column + 1, 0, 320), int(layout.ticks.size()));
}

TEST(HeatImage, WritesANumberAtEachTickAndTheTitleInsideThePicture) {
  for (const int size : {64, 300, 1000}) {
    HeatMap map = ramp(size, size, 12345.0f);
    map.title = "steps of the walk a ray: mean 6172.5, max 12345";
    const HeatLayout layout = heat_layout(map, heat_scale(map));
    const HeatPicture picture = draw_heat(map);
    ASSERT_TRUE(picture.labelled);
    const int left = layout.bar_left + layout.bar_width + layout.text / 3 + 1;
    for (const HeatLayout::Tick& tick : layout.ticks) {
      const int top = std::max(0, tick.row - layout.text), bottom = std::min(size, tick.row + layout.text);
      EXPECT_GT(dark_pixels(picture.image, left, layout.width, top, bottom), 3) << size << ": " << tick.label;
    }
    const int title = layout.bar_height + layout.text / 4;
    EXPECT_GT(dark_pixels(picture.image, 0, layout.width, title, layout.height), 100);
    // Nothing is cut off: the text has a pixel of white around it.
    EXPECT_EQ(dark_pixels(picture.image, left, layout.width, 0, 1), 0);
    EXPECT_EQ(dark_pixels(picture.image, left, layout.width, layout.bar_height - 1, title), 0);
    EXPECT_EQ(dark_pixels(picture.image, layout.width - 1, layout.width, 0, layout.height), 0);
    EXPECT_EQ(dark_pixels(picture.image, 0, layout.width, layout.height - 1, layout.height), 0);
    EXPECT_EQ(dark_pixels(picture.image, 0, 1, layout.bar_height, layout.height), 0);
  }
}

TEST(HeatImage, BreaksATitleThatIsWiderThanThePicture) {
  HeatMap map = one_value(64, 64, 1.0f);
  map.title = "blocks that may hold a surface and that the whole ray meets";
  const HeatLayout layout = heat_layout(map, heat_scale(map));
  EXPECT_GT(layout.title.size(), 1u);
  std::string joined;
  for (const std::string& line : layout.title) joined += (joined.empty() ? "" : " ") + line;
  EXPECT_EQ(joined, map.title);
}

TEST(HeatImage, DrawsTheBarWithoutNumbersWhereThereIsNoFont) {
  const HeatMap map = ramp(200, 200, 10.0f);
  const HeatPicture with = draw_heat(map), without = draw_heat(map, {.fonts = {"/no/such/font.ttf", "no such font"}});
  EXPECT_TRUE(with.labelled);
  EXPECT_FALSE(without.labelled);
  EXPECT_EQ(without.image.width, with.image.width);
  EXPECT_EQ(without.image.height, with.image.height);
  const HeatLayout layout = heat_layout(map, heat_scale(map));
  const int right = layout.bar_left + layout.bar_width, labels = right + layout.text / 3 + 1;
  EXPECT_EQ(dark_pixels(without.image, labels, layout.width, 0, layout.height), 0);
  EXPECT_GT(dark_pixels(without.image, right, labels, 0, layout.height), 0);  // the ticks
  EXPECT_EQ(color(without.image, layout.bar_left, 0), color(with.image, layout.bar_left, 0));
}

TEST(HeatImage, DrawsAMapOfZerosInTheLowestColour) {
  const HeatMap map = one_value(64, 64, 0.0f);
  EXPECT_EQ(heat_scale(map).maximum, 1.0);
  const Image image = draw_heat(map).image, whole = draw_heat(ramp(64, 64, 1.0f)).image;
  EXPECT_EQ(color(image, 20, 20), color(whole, 0, 0));
}

TEST(HeatImage, DrawsASinglePixel) {
  const HeatMap map = one_value(1, 1, 3.0f);
  const HeatPicture picture = draw_heat(map);
  EXPECT_EQ(color(picture.image, 0, 0), color(draw_heat(ramp(64, 64, 3.0f)).image, 63, 0));
  EXPECT_THAT(labels(map), ElementsAre("0", "1", "2", "3"));
  EXPECT_EQ(color(picture.image, 0, 1), (std::vector<float>{1, 1, 1}));
}

}  // namespace
}  // namespace quincunx
