// Numbers of pixels as colours, with the scale beside them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/image_file.h"

namespace quincunx {

/// A number for each pixel of a picture.
struct HeatMap {
  int width = 0, height = 0;      ///< at least 1
  std::vector<float> values;      ///< width*height, row 0 at the top; finite; below 0 is drawn as 0
  std::string title;              ///< UTF-8, stands below the picture
  std::optional<double> maximum;  ///< the end of the scale, above 0; else heat_scale chooses it
};

/// The scale goes from 0 to `maximum`, with a tick at each multiple of `step` (1, 2 or 5 times a power of ten).
struct HeatScale {
  double maximum = 1.0, step = 1.0;
  bool exceeded = false;  ///< some values are above the maximum and have its colour
};

/// The scale of a map. Unless the map says where it ends, it ends at the 99th percentile (at the largest value where that
/// percentile is 0), rounded up to a whole step: outliers take no colours from the rest. Whole numbers get whole steps.
HeatScale heat_scale(const HeatMap& map);

/// Where things are in the picture, in pixels from its upper left corner; all follows from the map's size, its
/// title and its scale. The map itself begins in the corner.
struct HeatLayout {
  struct Tick {
    double value;
    int row;            ///< of its line's middle
    std::string label;  ///< that of the maximum ends in "+" where values exceed it
  };
  int width = 0, height = 0;  ///< of the whole
  int text = 0;               ///< font size: 1/32 of the map's shorter edge, at least 9
  int bar_left = 0, bar_width = 0, bar_height = 0;  ///< from row 0 on; as high as the map, at least 5 font sizes
  std::vector<Tick> ticks;                      ///< ascending values
  std::vector<std::string> title;               ///< its lines, the first one's baseline at title_row
  int title_row = 0, line_height = 0;
};
HeatLayout heat_layout(const HeatMap& map, const HeatScale& scale);

struct HeatConfig {
  /// Of numbers and title; tried in turn: paths, or names that OpenImageIO looks for.
  std::vector<std::string> fonts{"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "DejaVuSans"};
};

struct HeatPicture {
  Image image;            ///< R G B, linear
  bool labelled = false;  ///< false: no font was found; the bar and its ticks are there, without numbers and title
};

/// Draws the map, a colour bar at its right and the title below, black on white. Colours: "inferno" of S. van der Walt and
/// N. Smith, even to the eye and ever lighter towards the maximum.
HeatPicture draw_heat(const HeatMap& map, const HeatConfig& config = {});

}  // namespace quincunx
