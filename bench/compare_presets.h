// What `quincunx compare` compares, by name and by flags.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/compare_measure.h"
#include "bench/compare_settings.h"
#include "bench/compare_subject.h"

namespace quincunx {

/// All that a comparison depends on but its volume and isovalue.
struct ComparePreset {
  std::string field;  ///< empty: it has to be named
  int samples = 41;   ///< Cartesian ones of a field along each axis
  double reduce = 2.0;  ///< of a Cartesian volume: how many times as long the steps become; 1: it is compared on as it is
  std::vector<Density> densities{Density::equal};
  CompareChoices choices;
  ComparePlan plan;   ///< settings are left open
};

/// What flags say of it.
struct CompareWishes {
  std::optional<std::vector<std::string>> splines;
  std::optional<std::vector<Spline::Prefilter>> prefilters;
  std::optional<std::vector<Storage>> storages;
  std::optional<std::vector<Intersect>> intersects;
  std::optional<std::vector<double>> steps;
  std::optional<std::vector<NormalChoice>> normals;
  std::optional<std::vector<SkipConfig>> skips;
  std::optional<std::vector<Density>> densities;
  std::optional<int> samples, views, rounds, points, seed;
  std::optional<glm::ivec2> size;
  std::optional<double> reduce, azimuth, elevation, zoom;
  std::optional<double> isovalue;
  std::string error;
};

/// The names compare_preset knows.
///   marschner-lobb  the field of S. Marschner and R. Lobb at the density of 81^3, all splines, exact and marched
///   table3          gradients: analytic, and by central differences of several steps (M. Kim 2013, Table 3; spline/bcc7.h)
///   table5          the time of BCC splines, marched and exact, with both kinds of gradients (likewise, Table 5)
const std::vector<std::string>& compare_preset_names();

/// The preset of that name, or what is compared where none is named (empty).
ComparePreset compare_preset(std::string_view name);

/// `preset` with what was wished for instead.
ComparePreset with_wishes(ComparePreset preset, const CompareWishes& wishes);

}  // namespace quincunx
