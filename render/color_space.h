// Displayed colours, and how colour maps go from one to the next.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string_view>

namespace quincunx {

/// sRGB, 0..1, as linear RGB and back (IEC 61966-2-1).
glm::dvec3 linear_from_srgb(const glm::dvec3& srgb);
glm::dvec3 srgb_from_linear(const glm::dvec3& linear);

/// The space in which a colour map is interpolated, as VTK's vtkColorTransferFunction does it.
///   rgb        sRGB itself
///   hsv        hue, saturation, value of sRGB; hues go the way that does not pass 0
///   hsv_wrap   the same, hues by the shorter way
///   lab        CIELAB
///   diverging  Msh: K. Moreland, Diverging color maps for scientific visualization, 2009, DOI 10.1007/978-3-642-10520-3_9
///   step       no interpolation: the second colour from just behind the first on
enum class ColorSpace { rgb, hsv, hsv_wrap, lab, diverging, step };

/// From `a` (s = 0) to `b` (s = 1), sRGB all three.
glm::dvec3 interpolate(ColorSpace space, const glm::dvec3& a, const glm::dvec3& b, double s);

}  // namespace quincunx
