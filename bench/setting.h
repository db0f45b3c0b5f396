// The ways to find a first hit that are compared.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "render/renderer.h"

namespace quincunx {

/// One way.
struct Setting {
  Intersect intersect = Intersect::exact;
  double step = 0.0;      ///< of Intersect::march, in cells; 0 for exact
  std::string structure;  ///< a name of structure_names()

  bool operator==(const Setting&) const = default;
  /// "exact" or "march 0.25".
  std::string method() const;
  /// `request` made this setting's own.
  Renderer::Request applied(Renderer::Request request) const;
};

/// The published method, which speed is told relative to: a step of a quarter cell and no skipping. M. Kim
/// (spline/bcc7.h).
Setting published_setting();

/// Exact with grid and with none, then march with grid and with none at each of `steps` (cells, no two alike); the
/// published one stands at the end where it is not among these.
std::vector<Setting> intersect_settings(std::span<const double> steps);

}  // namespace quincunx
