#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "lattice/error.h"
#include "render/color_space.h"
#include "render/json_file.h"
#include "render/transfer_function.h"

namespace quincunx {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMostPoints = 65536;
constexpr std::string_view kKeys = "unit, colors, opacities";

/// A list of a file and what it is called in messages.
struct List {
  const Json& json;
  std::string path, name;

  /// "f.json: point 3 of "colors"".
  std::string point(std::size_t n) const { return fmt::format("{}: point {} of \"{}\"", path, n, name); }
};

double number(const Json& json, const std::string& where) {
  if (!json.is_number() || !std::isfinite(json.get<double>()))
    throw InputError(fmt::format("{} holds {}; expected a finite number", where, brief(json)));
  return json.get<double>();
}

double part(const Json& json, const std::string& where) {
  const double x = number(json, where);
  if (x < 0.0 || x > 1.0) throw InputError(fmt::format("{} holds {}; expected a number from 0 to 1", where, x));
  return x;
}

void check_points(const List& list, std::size_t points, std::size_t least) {
  if (points < least || points > kMostPoints)
    throw InputError(fmt::format("{}: \"{}\" has {} point{}; expected {} to {}", list.path, list.name, points, points == 1 ? "" : "s", least, kMostPoints));
}

template <class Point>
void check_ascending(const List& list, const std::vector<Point>& points) {
  std::vector<double> values;
  for (const Point& point : points) values.push_back(point.value);
  check_values(values, list.path, list.name);
}

// ---- our own form ----

/// "#rrggbb" as linear RGB.
glm::dvec3 named_color(const Json& json, const std::string& where) {
  const std::string text = json.is_string() ? json.get<std::string>() : "";
  unsigned rrggbb = 0;
  if (text.size() != 7 || text[0] != '#' || text.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos)
    throw InputError(fmt::format("{} holds {}; expected \"#rrggbb\"", where, brief(json)));
  std::sscanf(text.c_str() + 1, "%x", &rrggbb);
  const glm::dvec3 srgb = glm::dvec3(double(rrggbb >> 16), double(rrggbb >> 8 & 255u), double(rrggbb & 255u)) / 255.0;
  return glm::min(linear_from_srgb(srgb), 1.0);
}

/// The list `key` of `json`, each of whose points is checked to be a list itself.
List own_list(const Json& json, const std::string& path, const std::string& key, std::size_t least) {
  if (!json.contains(key)) throw InputError(fmt::format("{}: key \"{}\" is missing; expected {}", path, key, kKeys));
  const List list{json[key], path, key};
  if (!list.json.is_array()) throw InputError(fmt::format("{}: \"{}\" is {}; expected a list of points", path, key, brief(list.json)));
  check_points(list, list.json.size(), least);
  for (std::size_t n = 0; n < list.json.size(); ++n)
    if (!list.json[n].is_array() || list.json[n].empty())
      throw InputError(fmt::format("{} is {}; expected a list that begins with a value", list.point(n), brief(list.json[n])));
  return list;
}

std::vector<TransferFunction::ColorPoint> own_colors(const List& list) {
  std::vector<TransferFunction::ColorPoint> points;
  for (std::size_t n = 0; n < list.json.size(); ++n) {
    const Json& point = list.json[n];
    const std::string where = list.point(n);
    if (point.size() == 2) {
      points.push_back({number(point[0], where), named_color(point[1], where)});
    } else if (point.size() == 4) {
      points.push_back({number(point[0], where), {part(point[1], where), part(point[2], where), part(point[3], where)}});
    } else {
      throw InputError(fmt::format("{} is {}; expected [value, \"#rrggbb\"] or [value, r, g, b]", where, brief(point)));
    }
  }
  check_ascending(list, points);
  return points;
}

std::vector<TransferFunction::OpacityPoint> own_opacities(const List& list) {
  std::vector<TransferFunction::OpacityPoint> points;
  for (std::size_t n = 0; n < list.json.size(); ++n) {
    const Json& point = list.json[n];
    if (point.size() != 2) throw InputError(fmt::format("{} is {}; expected [value, opacity]", list.point(n), brief(point)));
    points.push_back({number(point[0], list.point(n)), part(point[1], list.point(n))});
  }
  check_ascending(list, points);
  return points;
}

TransferFunction own_function(const Json& json, const std::string& path) {
  for (const auto& [key, value] : json.items())
    if (key != "unit" && key != "colors" && key != "opacities")
      throw InputError(fmt::format("{}: unknown key {}; expected {}", path, brief(key), kKeys));
  TransferFunction function{.colors = own_colors(own_list(json, path, "colors", 1)),
                            .opacities = own_opacities(own_list(json, path, "opacities", 2))};
  if (json.contains("unit")) {
    function.unit = number(json["unit"], path + ": \"unit\"");
    if (function.unit <= 0.0) throw InputError(fmt::format("{}: \"unit\" is {}; expected a length above 0", path, function.unit));
  }
  return function;
}

// ---- ParaView's colour maps ----

/// The list `key`, flat: four numbers a point.
List flat_list(const Json& json, const std::string& path, const std::string& key, std::size_t least) {
  const List list{json[key], path, key};
  if (!list.json.is_array() || list.json.size() % 4 != 0)
    throw InputError(fmt::format("{}: \"{}\" {}; expected a list of four numbers a point", path, key,
                                 list.json.is_array() ? fmt::format("has {} numbers", list.json.size()) : "is " + brief(list.json)));
  check_points(list, list.json.size() / 4, least);
  return list;
}

ColorSpace color_space(const Json& map, const std::string& path) {
  constexpr std::array<std::pair<std::string_view, ColorSpace>, 6> kSpaces{{{"RGB", ColorSpace::rgb},
                                                                            {"HSV", ColorSpace::hsv},
                                                                            {"Lab", ColorSpace::lab},
                                                                            {"CIELAB", ColorSpace::lab},
                                                                            {"Diverging", ColorSpace::diverging},
                                                                            {"Step", ColorSpace::step}}};
  if (!map.contains("ColorSpace")) return ColorSpace::rgb;
  for (const auto& [name, space] : kSpaces) {
    if (map["ColorSpace"] != name) continue;
    const Json wrap = map.value("HSVWrap", Json(false));
    return space == ColorSpace::hsv && (wrap == true || wrap == 1) ? ColorSpace::hsv_wrap : space;
  }
  throw InputError(fmt::format("{}: \"ColorSpace\" is {}; expected RGB, HSV, Lab, CIELAB, Diverging or Step", path, brief(map["ColorSpace"])));
}

/// Whether a straight line in linear RGB keeps within 1/512 of a map's way from sRGB `a` to `b` between its parts s1 and s2, in every
/// channel of sRGB: looked at in seven places.
bool is_straight(ColorSpace space, const glm::dvec3& a, const glm::dvec3& b, double s1, double s2) {
  constexpr int kProbes = 8;
  constexpr double kTolerance = 0.75 / 512.0;  // where the way turns between two places, it is more
  const glm::dvec3 from = linear_from_srgb(interpolate(space, a, b, s1)), to = linear_from_srgb(interpolate(space, a, b, s2));
  for (int n = 1; n < kProbes; ++n) {
    const double s = double(n) / kProbes;
    const glm::dvec3 error = glm::abs(srgb_from_linear(glm::mix(from, to, s)) - interpolate(space, a, b, std::lerp(s1, s2, s)));
    if (std::max({error.x, error.y, error.z}) > kTolerance) return false;
  }
  return true;
}

/// Appends the parts, from behind s1 to s2, at which the way from `a` to `b` has to be cut to be straight between them.
void append_cuts(ColorSpace space, const glm::dvec3& a, const glm::dvec3& b, double s1, double s2, std::vector<double>& cuts) {
  constexpr double kShortest = 0x1p-12;
  if (s2 - s1 <= kShortest || is_straight(space, a, b, s1, s2)) {
    cuts.push_back(s2);
    return;
  }
  append_cuts(space, a, b, s1, 0.5 * (s1 + s2), cuts);
  append_cuts(space, a, b, 0.5 * (s1 + s2), s2, cuts);
}

/// `points`, whose colours are sRGB, as a function that is linear in linear RGB.
std::vector<TransferFunction::ColorPoint> linear_points(const std::vector<TransferFunction::ColorPoint>& points, ColorSpace space) {
  std::vector<TransferFunction::ColorPoint> all;
  const auto append = [&](double value, const glm::dvec3& srgb) {
    if (all.empty() || value > all.back().value) all.push_back({value, glm::clamp(linear_from_srgb(srgb), 0.0, 1.0)});
  };
  for (std::size_t n = 0; n + 1 < points.size(); ++n) {
    const auto& [v1, a] = points[n];
    const auto& [v2, b] = points[n + 1];
    append(v1, a);
    if (space == ColorSpace::step) {
      if (const double behind = std::nextafter(v1, v2); behind < v2) append(behind, b);
      continue;
    }
    std::vector<double> cuts;
    append_cuts(space, a, b, 0.0, 1.0, cuts);
    for (const double s : cuts)
      if (const double value = std::lerp(v1, v2, s); value < v2) append(value, interpolate(space, a, b, s));
  }
  append(points.back().value, points.back().color);
  return all;
}

std::vector<TransferFunction::ColorPoint> map_colors(const List& list) {
  std::vector<TransferFunction::ColorPoint> points;
  for (std::size_t n = 0; n < list.json.size() / 4; ++n) {
    const std::string where = list.point(n);
    const auto at = [&](std::size_t k) -> const Json& { return list.json[4 * n + k]; };
    points.push_back({number(at(0), where), {part(at(1), where), part(at(2), where), part(at(3), where)}});
  }
  check_ascending(list, points);
  return points;
}

std::vector<TransferFunction::OpacityPoint> map_opacities(const List& list) {
  std::vector<TransferFunction::OpacityPoint> points;
  for (std::size_t n = 0; n < list.json.size() / 4; ++n) {
    const std::string where = list.point(n);
    const auto at = [&](std::size_t k) -> const Json& { return list.json[4 * n + k]; };
    points.push_back({number(at(0), where), part(at(1), where)});
    if (at(2) != 0.5 || at(3) != 0)
      throw InputError(fmt::format("{} has the midpoint {} and the sharpness {}; expected 0.5 and 0, straight lines", where, brief(at(2)), brief(at(3))));
  }
  check_ascending(list, points);
  return points;
}

TransferFunction map_function(const Json& maps, const std::string& path) {
  const auto map = std::ranges::find_if(maps, [](const Json& json) { return json.is_object() && json.contains("RGBPoints"); });
  if (map == maps.end())
    throw InputError(fmt::format("{}: a list of {} without \"RGBPoints\"; expected colour maps as ParaView exports them, or an object with {}",
                                 path, maps.size(), kKeys));
  const bool opacities = map->contains("Points");
  const ColorSpace space = color_space(*map, path);
  const auto colors = map_colors(flat_list(*map, path, "RGBPoints", opacities ? 1 : 2));
  TransferFunction function{.colors = linear_points(colors, space), .opacities = {{colors.front().value, 0.0}, {colors.back().value, 1.0}}};
  if (opacities) function.opacities = map_opacities(flat_list(*map, path, "Points", 2));
  return function;
}

}  // namespace

TransferFunction read_transfer_function(const std::string& path) {
  const Json json = read_json(path, "a transfer function");
  if (!json.is_object() && !json.is_array())
    throw InputError(fmt::format("{}: a JSON {}; expected an object with {}, or a list of ParaView's colour maps", path, json.type_name(), kKeys));
  TransferFunction function = json.is_object() ? own_function(json, path) : map_function(json, path);
  check_transfer_function(function, path);
  return function;
}

}  // namespace quincunx
