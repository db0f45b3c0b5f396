#include "bench/compare_presets.h"

#include <algorithm>
#include <utility>

namespace quincunx {
namespace {

/// Those of `names` that are in the list of splines.
std::vector<std::string> listed(std::initializer_list<std::string_view> names) {
  std::vector<std::string> found;
  for (const std::string_view name : names)
    if (std::find(spline_names().begin(), spline_names().end(), name) != spline_names().end()) found.emplace_back(name);
  return found;
}

template <class T>
void take(const std::optional<T>& wish, T& value) {
  if (wish) value = *wish;
}

}  // namespace

const std::vector<std::string>& compare_preset_names() {
  static const std::vector<std::string> names{"marschner-lobb", "table3", "table5"};
  return names;
}

ComparePreset compare_preset(std::string_view name) {
  ComparePreset preset;
  preset.choices.splines.assign(spline_names().begin(), spline_names().end());
  if (name.empty()) return preset;
  preset.field = "marschner-lobb";
  preset.samples = 81;
  preset.plan.first = {30.0, 60.0, 1.2};  // upon the ripples
  if (name == "table3") {
    preset.choices.intersects = {Intersect::exact};
    preset.choices.normals = {NormalChoice{}, {Normal::central, 0.01}, {Normal::central, 0.1}, {Normal::central, 0.5}, {Normal::central, 1.0}, {Normal::samples, 0.0}};
    preset.choices.splines = listed({"bcc7", "bcc8", "bcc12", "tricubic", "trilinear"});
  } else if (name == "table5") {
    preset.choices.normals = {NormalChoice{}, {Normal::central, 0.5}};
    preset.choices.splines = listed({"bcc7", "bcc8", "bcc12"});
  }
  return preset;
}

ComparePreset with_wishes(ComparePreset preset, const CompareWishes& wishes) {
  take(wishes.splines, preset.choices.splines);
  take(wishes.prefilters, preset.choices.prefilters);
  take(wishes.storages, preset.choices.storages);
  take(wishes.intersects, preset.choices.intersects);
  take(wishes.steps, preset.choices.steps);
  take(wishes.normals, preset.choices.normals);
  take(wishes.skips, preset.choices.skips);
  take(wishes.densities, preset.densities);
  take(wishes.samples, preset.samples);
  take(wishes.views, preset.plan.views);
  take(wishes.rounds, preset.plan.rounds);
  take(wishes.points, preset.plan.points);
  if (wishes.seed) preset.plan.seed = std::uint32_t(*wishes.seed);
  take(wishes.reduce, preset.reduce);
  take(wishes.azimuth, preset.plan.first.azimuth);
  take(wishes.elevation, preset.plan.first.elevation);
  take(wishes.zoom, preset.plan.first.zoom);
  if (wishes.size) preset.plan.width = wishes.size->x, preset.plan.height = wishes.size->y;
  return preset;
}

}  // namespace quincunx
