#include "render/color_space.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quincunx {
namespace {

using glm::dvec3;

constexpr double kPi = std::numbers::pi;

template <class Function>
dvec3 each(const dvec3& v, const Function& function) {
  return {function(v.x), function(v.y), function(v.z)};
}

const dvec3 kWhite(0.9505, 1.0, 1.089);  // D65

dvec3 lab_from_srgb(const dvec3& srgb) {
  const dvec3 c = linear_from_srgb(srgb);
  const dvec3 xyz(dot(c, dvec3(0.4124, 0.3576, 0.1805)), dot(c, dvec3(0.2126, 0.7152, 0.0722)), dot(c, dvec3(0.0193, 0.1192, 0.9505)));
  const dvec3 f = each(xyz / kWhite, [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; });
  return {116.0 * f.y - 16.0, 500.0 * (f.x - f.y), 200.0 * (f.y - f.z)};
}

dvec3 srgb_from_lab(const dvec3& lab) {
  const double y = (lab.x + 16.0) / 116.0;
  const dvec3 f(lab.y / 500.0 + y, y, y - lab.z / 200.0);
  const dvec3 xyz = kWhite * each(f, [](double t) { return t * t * t > 0.008856 ? t * t * t : (t - 16.0 / 116.0) / 7.787; });
  const dvec3 linear(dot(xyz, dvec3(3.2406, -1.5372, -0.4986)), dot(xyz, dvec3(-0.9689, 1.8758, 0.0415)),
                     dot(xyz, dvec3(0.0557, -0.2040, 1.0570)));
  const dvec3 srgb = srgb_from_linear(linear);
  return glm::clamp(srgb / std::max({1.0, srgb.x, srgb.y, srgb.z}), 0.0, 1.0);  // what no display shows: its nearest of that hue
}

/// Hue, saturation and value, 0..1 all three.
dvec3 hsv_from_srgb(const dvec3& c) {
  const double high = std::max({c.x, c.y, c.z}), low = std::min({c.x, c.y, c.z}), range = high - low;
  if (range <= 0.0) return {0.0, 0.0, high};
  double hue = high == c.x ? (c.y - c.z) / range : high == c.y ? 2.0 + (c.z - c.x) / range : 4.0 + (c.x - c.y) / range;
  if (hue < 0.0) hue += 6.0;
  return {hue / 6.0, range / high, high};
}

dvec3 srgb_from_hsv(const dvec3& hsv) {
  const auto channel = [&](double turn) {
    const double k = std::fmod(turn + hsv.x * 6.0, 6.0);
    return hsv.z * (1.0 - hsv.y * std::clamp(std::min(k, 4.0 - k), 0.0, 1.0));
  };
  return {channel(5.0), channel(3.0), channel(1.0)};
}

dvec3 interpolate_hsv(const dvec3& a, const dvec3& b, double s, bool wrap) {
  dvec3 from = hsv_from_srgb(a), to = hsv_from_srgb(b);
  if (wrap && std::abs(from.x - to.x) > 0.5) (from.x > to.x ? from.x : to.x) -= 1.0;
  dvec3 hsv = glm::mix(from, to, s);
  if (hsv.x < 0.0) hsv.x += 1.0;
  return srgb_from_hsv(hsv);
}

/// Magnitude, saturation and hue, the last two angles: polar coordinates of CIELAB.
struct Msh {
  double m, s, h;
};

Msh msh_from_srgb(const dvec3& srgb) {
  const dvec3 lab = lab_from_srgb(srgb);
  const double m = length(lab), s = m > 0.001 ? std::acos(std::clamp(lab.x / m, -1.0, 1.0)) : 0.0;
  return {m, s, s > 0.001 ? std::atan2(lab.z, lab.y) : 0.0};
}

/// A hue for the end without saturation, of magnitude `m`, so that colours change evenly.
double adjusted_hue(const Msh& saturated, double m) {
  if (saturated.m >= m - 0.1) return saturated.h;
  const double spin = saturated.s * std::sqrt(m * m - saturated.m * saturated.m) / (saturated.m * std::sin(saturated.s));
  return saturated.h > -0.3 * kPi ? saturated.h + spin : saturated.h - spin;
}

dvec3 interpolate_diverging(const dvec3& a, const dvec3& b, double s) {
  constexpr double kSaturated = 0.05;
  Msh from = msh_from_srgb(a), to = msh_from_srgb(b);
  const double turn = std::abs(from.h - to.h), angle = std::min(turn, 2.0 * kPi - turn);
  if (from.s > kSaturated && to.s > kSaturated && angle > 0.33 * kPi) {  // white between colours of two hues
    const Msh white{std::max({from.m, to.m, 88.0}), 0.0, 0.0};
    (s < 0.5 ? to : from) = white;
    s = s < 0.5 ? 2.0 * s : 2.0 * s - 1.0;
  }
  if (from.s < kSaturated && to.s > kSaturated) from.h = adjusted_hue(to, from.m);
  else if (to.s < kSaturated && from.s > kSaturated) to.h = adjusted_hue(from, to.m);
  const double m = std::lerp(from.m, to.m, s), saturation = std::lerp(from.s, to.s, s), h = std::lerp(from.h, to.h, s);
  return srgb_from_lab(m * dvec3(std::cos(saturation), std::sin(saturation) * std::cos(h), std::sin(saturation) * std::sin(h)));
}

}  // namespace

dvec3 linear_from_srgb(const dvec3& srgb) {
  return each(srgb, [](double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); });
}

dvec3 srgb_from_linear(const dvec3& linear) {
  return each(linear, [](double x) { return x <= 0.0031308 ? x * 12.92 : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055; });
}

dvec3 interpolate(ColorSpace space, const dvec3& a, const dvec3& b, double s) {
  switch (space) {
    case ColorSpace::rgb: return glm::mix(a, b, s);
    case ColorSpace::hsv: return interpolate_hsv(a, b, s, false);
    case ColorSpace::hsv_wrap: return interpolate_hsv(a, b, s, true);
    case ColorSpace::lab: return srgb_from_lab(glm::mix(lab_from_srgb(a), lab_from_srgb(b), s));
    case ColorSpace::diverging: return interpolate_diverging(a, b, s);
    case ColorSpace::step: return s > 0.0 ? b : a;
  }
  return b;
}

}  // namespace quincunx
