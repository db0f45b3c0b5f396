// Colour and opacity by value: what direct volume rendering shows.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace quincunx {

/// Piecewise linear functions of the value, constant before their first point and after their last.
/// Values ascend; colours are linear RGB, 0..1; opacities, 0..1, are those of a stretch of length `unit`.
struct TransferFunction {
  struct ColorPoint {
    double value;
    glm::dvec3 color;
    bool operator==(const ColorPoint&) const = default;
  };
  struct OpacityPoint {
    double value, opacity;
    bool operator==(const OpacityPoint&) const = default;
  };
  std::vector<ColorPoint> colors;        ///< at least one
  std::vector<OpacityPoint> opacities;   ///< at least two; all 0 is allowed: nothing is seen then
  double unit = 0.0;                     ///< world units; 0: one cell

  glm::dvec3 color(double value) const;
  double opacity(double value) const;
  /// First and last value of any point.
  double low() const;
  double high() const;
  bool operator==(const TransferFunction&) const = default;
};

/// Throws InputError, which begins with `what` (a file, a flag), where a list is too short, values do not ascend, or a number is out
/// of range or not finite.
void check_transfer_function(const TransferFunction& function, std::string_view what);

/// Throws InputError unless `values`, those of the points of `list`, ascend and lie within +-1e37, the range of the device's numbers.
void check_values(std::span<const double> values, std::string_view what, std::string_view list);

/// Reads a JSON file, either ours
///   { "unit": 1.5, "colors": [[0, "#20408f"], [90, 0.9, 0.3, 0.1]], "opacities": [[40, 0], [90, 0.4]] }
/// (value, then linear r,g,b of 0..1 or "#rrggbb" of sRGB; value, opacity; unit, in world units, may be absent), or
/// colour maps as ParaView exports them: an array of objects, of which the first that has "RGBPoints" counts. "ColorSpace" may be RGB,
/// HSV, Lab, CIELAB, Diverging or Step; "Points" are value, opacity, 0.5, 0 each (other midpoints and sharpness are refused); without them
/// opacity goes from 0 at the first colour's value to 1 at the last's. Colours between the points are those of ParaView
/// to within 1/512 of each sRGB channel.
/// At most 64 MiB and 65536 points a list. Throws InputError naming the file, what was found and what was expected.
TransferFunction read_transfer_function(const std::string& path);

}  // namespace quincunx
