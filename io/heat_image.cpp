#include "io/heat_image.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace quincunx {
namespace {

using Color = std::array<float, 3>;

constexpr int kColors = 1024;          // of the scale
constexpr double kDigitWidth = 0.65;   // of the font size, a little more than that of DejaVu Sans
constexpr double kLetterWidth = 0.58;  // the same of a title's letters and spaces together
constexpr double kPercentile = 0.99;

/// The smallest of 1, 2, 5 times a power of ten that is at least `x` > 0.
double round_up(double x) {
  const double power = std::pow(10.0, std::floor(std::log10(x)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (digit * power >= x * (1.0 - 1e-9)) return digit * power;
  }
  return 10.0 * power;
}

int bar_height(const HeatMap& map, int text) { return std::max(map.height, 5 * text); }
int text_size(const HeatMap& map) { return std::max(9, std::min(map.width, map.height) / 32); }

/// The text in lines of at most `letters`, broken at spaces; a longer word has a line of its own.
std::vector<std::string> wrap(const std::string& text, std::size_t letters) {
  std::vector<std::string> lines;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find(' ', start), text.size());
    const std::string word = text.substr(start, end - start);
    if (!lines.empty() && lines.back().size() + 1 + word.size() <= letters) {
      lines.back() += " " + word;
    } else {
      lines.push_back(word);
    }
    start = end + 1;
  }
  return lines;
}

/// IEC 61966-2-1, the inverse of what write_image does for PNG.
float linear(float srgb) { return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f); }

/// The colours of 0 .. maximum, linear as color_map gives them.
std::vector<Color> heat_colors() {
  OIIO::ImageBuf ramp(OIIO::ImageSpec(kColors, 1, 1, OIIO::TypeDesc::FLOAT));
  for (int i = 0; i < kColors; ++i) {
    const float value = float(i) / float(kColors - 1);
    ramp.setpixel(i, 0, &value, 1);
  }
  const OIIO::ImageBuf mapped = OIIO::ImageBufAlgo::color_map(ramp, 0, "inferno");
  std::vector<Color> colors(kColors);
  for (int i = 0; i < kColors; ++i) {
    mapped.getpixel(i, 0, colors[std::size_t(i)].data(), 3);
  }
  return colors;
}

/// The first font that can be drawn with, "" where there is none.
std::string find_font(const HeatConfig& config, int size) {
  for (const std::string& font : config.fonts) {
    if (OIIO::ImageBufAlgo::text_size("0", size, font).defined()) return font;
  }
  OIIO::geterror();  // it has been heard
  return {};
}

/// A white page with what is black on it: ticks, and labels and title where there is a font. sRGB.
void draw_black(const HeatLayout& layout, const std::string& font, OIIO::ImageBuf& page) {
  using namespace OIIO::ImageBufAlgo;
  const std::array<float, 3> black{0.0f, 0.0f, 0.0f}, white{1.0f, 1.0f, 1.0f};
  fill(page, white);
  const int thick = std::max(1, layout.text / 12), length = layout.text / 3 + 1;
  const int right = layout.bar_left + layout.bar_width;
  for (const HeatLayout::Tick& tick : layout.ticks) {
    const int top = std::clamp(tick.row - thick / 2, 0, layout.bar_height - thick);
    fill(page, black, OIIO::ROI(right, right + length, top, top + thick));
    if (font.empty()) continue;
    // Digits are 0.73 of the font size high; those at the ends stay within the bar's height.
    const int digit = int(std::ceil(0.73 * layout.text));
    const int baseline = std::clamp(tick.row + digit / 2, digit + 1, layout.bar_height - 1);
    render_text(page, right + length + layout.text / 4, baseline, tick.label, layout.text, font, black);
  }
  if (font.empty()) return;
  int baseline = layout.title_row;
  for (const std::string& line : layout.title) {
    render_text(page, layout.text / 2, baseline, line, layout.text, font, black);
    baseline += layout.line_height;
  }
}

/// Colours pixels of the page.
class Painter {
 public:
  Painter(Image& page, double maximum) : page_(page), maximum_(maximum), colors_(heat_colors()) {}

  void paint(int x, int y, double value) {
    const double place = std::clamp(value / maximum_, 0.0, 1.0) * (kColors - 1);
    const Color& color = colors_[std::size_t(std::lround(place))];
    const std::size_t pixel = std::size_t(y) * std::size_t(page_.width) + std::size_t(x);
    std::copy(color.begin(), color.end(), page_.pixels.begin() + std::ptrdiff_t(3 * pixel));
  }

 private:
  Image& page_;
  double maximum_;
  std::vector<Color> colors_;
};

}  // namespace

HeatScale heat_scale(const HeatMap& map) {
  assert(!map.values.empty() && (!map.maximum || *map.maximum > 0.0));
  std::vector<float> values = map.values;
  const auto high = values.begin() + std::ptrdiff_t(std::ceil(kPercentile * double(values.size() - 1)));
  std::nth_element(values.begin(), high, values.end());
  const double largest = *std::max_element(high, values.end());
  const double end = map.maximum ? *map.maximum : *high > 0.0f ? *high : largest > 0.0 ? largest : 1.0;

  HeatScale scale;
  const int most = std::clamp(2 * bar_height(map, text_size(map)) / (3 * text_size(map)), 3, 10);
  scale.step = round_up(end / most);
  const bool whole = std::all_of(values.begin(), values.end(), [](float v) { return v == std::floor(v); });
  if (whole) scale.step = std::max(scale.step, 1.0);
  scale.maximum = map.maximum ? end : std::ceil(end / scale.step * (1.0 - 1e-9)) * scale.step;
  scale.exceeded = largest > scale.maximum;
  return scale;
}

HeatLayout heat_layout(const HeatMap& map, const HeatScale& scale) {
  HeatLayout layout;
  layout.text = text_size(map);
  layout.bar_height = bar_height(map, layout.text);
  layout.bar_left = map.width + layout.text;
  layout.bar_width = layout.text + layout.text / 4;

  std::size_t longest = 0;
  const int count = int(std::floor(scale.maximum / scale.step * (1.0 + 1e-9)));
  for (int i = 0; i <= count; ++i) {
    const double value = i * scale.step;
    const bool plus = scale.exceeded && value > scale.maximum * (1.0 - 1e-9);
    layout.ticks.push_back({value, int(std::lround((1.0 - value / scale.maximum) * layout.bar_height)),
                            fmt::format("{:g}{}", value, plus ? "+" : "")});
    longest = std::max(longest, layout.ticks.back().label.size());
  }
  const int labels = int(std::ceil((double(longest) * kDigitWidth + 0.25) * layout.text));
  const int tick = layout.text / 3 + 1 + layout.text / 4;
  layout.width = layout.bar_left + layout.bar_width + tick + labels + layout.text / 4;

  const double room = double(layout.width - layout.text) / layout.text;
  layout.title = wrap(map.title, std::size_t(room / kLetterWidth));
  layout.line_height = layout.text + layout.text / 3;
  layout.title_row = layout.bar_height + layout.line_height;
  const int lines = int(layout.title.size());
  layout.height = layout.bar_height + (lines > 0 ? lines * layout.line_height + layout.text / 2 : 0);
  return layout;
}

HeatPicture draw_heat(const HeatMap& map, const HeatConfig& config) {
  assert(map.values.size() == std::size_t(map.width) * std::size_t(map.height));
  const HeatScale scale = heat_scale(map);
  const HeatLayout layout = heat_layout(map, scale);
  HeatPicture picture;
  picture.image = {.width = layout.width, .height = layout.height, .channels = {"R", "G", "B"}, .pixels = {}};
  picture.image.pixels.resize(std::size_t(layout.width) * std::size_t(layout.height) * 3);

  const std::string font = find_font(config, layout.text);
  picture.labelled = !font.empty();
  OIIO::ImageBuf page(OIIO::ImageSpec(layout.width, layout.height, 3, OIIO::TypeDesc::FLOAT), picture.image.pixels.data());
  draw_black(layout, font, page);
  for (float& v : picture.image.pixels) {
    if (v < 1.0f) v = linear(v);
  }

  Painter painter(picture.image, scale.maximum);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x)
      painter.paint(x, y, map.values[std::size_t(y) * std::size_t(map.width) + std::size_t(x)]);
  }
  for (int y = 0; y < layout.bar_height; ++y) {
    const double value = scale.maximum * (layout.bar_height - 0.5 - y) / layout.bar_height;
    for (int x = 0; x < layout.bar_width; ++x) painter.paint(layout.bar_left + x, y, value);
  }
  return picture;
}

}  // namespace quincunx
