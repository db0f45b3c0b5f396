#include "bench/compare_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "accel/structure.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

/// Those of `wanted` that the spline has, by what they are: `automatic` is one of the others.
std::vector<Spline::Prefilter> prefilters_of(const Spline& spline, const std::vector<Spline::Prefilter>& wanted) {
  std::vector<Spline::Prefilter> kinds;
  for (const Spline::Prefilter w : wanted) {
    const auto has = [&](const Spline::Filter& f) { return f.kind == w; };
    if (w != Spline::Prefilter::automatic && std::none_of(spline.filters().begin(), spline.filters().end(), has)) continue;
    const Spline::Prefilter kind = spline.filter(w).kind;
    if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) kinds.push_back(kind);
  }
  return kinds;
}

/// Each way to find hits of a spline: one for exact, one a step for march.
std::vector<std::pair<Intersect, double>> ways(const CompareChoices& choices, const Spline& spline) {
  std::vector<std::pair<Intersect, double>> all;
  for (const Intersect intersect : choices.intersects) {
    if (intersect == Intersect::exact) {
      if (!spline.polynomial()) continue;  // a device has to march
      all.emplace_back(intersect, 0.0);
    } else {
      for (const double step : choices.steps) all.emplace_back(intersect, step);
    }
  }
  return all;
}

}  // namespace

std::string NormalChoice::label() const { return normal == Normal::analytic ? "analytic" : normal == Normal::samples ? "samples" : fmt::format("central {}", delta); }

bool CompareSetting::same_spline(const CompareSetting& other) const {
  return volume == other.volume && spline == other.spline && prefilter == other.prefilter;
}

bool CompareSetting::same_coefficients(const CompareSetting& other) const { return same_spline(other) && storage == other.storage; }

bool CompareSetting::same_reconstruction(const CompareSetting& other) const { return same_coefficients(other) && normal == other.normal; }

std::string CompareSetting::method() const { return intersect == Intersect::exact ? "exact" : fmt::format("march {}", step); }

std::string CompareSetting::prefilter_text() const { return std::string(prefilter_name(prefilter)); }

std::string CompareSetting::label(const CompareSubject& subject) const {
  std::string text = spline;
  if (subject.volumes[volume].name.ends_with("sparse")) text += " sparse";
  if (prefilter != Spline::Prefilter::none) text += " " + prefilter_text();
  if (storage != Storage::float32) text += fmt::format(", {}", storage_name(storage));
  text += ", " + method();
  if (normal.normal != Normal::analytic) text += ", " + normal.label();
  if (skip.structure != "auto") text += ", " + skip_label(skip);
  return text;
}

Renderer::Request CompareSetting::applied(Renderer::Request request) const {
  request.scene.intersect = intersect;
  if (intersect == Intersect::march) request.scene.step = step;
  request.scene.normal = normal.normal;
  if (normal.normal == Normal::central) request.scene.delta = normal.delta;
  request.skip = skip;
  return request;
}

std::vector<CompareSetting> compare_settings(const CompareSubject& subject, const CompareChoices& choices) {
  std::vector<CompareSetting> settings;
  for (std::size_t v = 0; v < subject.volumes.size(); ++v)
    for (const std::string& name : choices.splines) {
      const auto spline = make_spline(name);
      if (spline->lattice() != subject.volumes[v].volume.lattice) continue;
      for (const Spline::Prefilter prefilter : prefilters_of(*spline, choices.prefilters))
        for (const Storage storage : choices.storages)
          for (const NormalChoice& normal : choices.normals)
            for (const SkipConfig& skip : choices.skips)
              for (const auto& [intersect, step] : ways(choices, *spline))
                settings.push_back({.volume = v, .spline = name, .prefilter = prefilter, .storage = storage, .intersect = intersect, .step = step, .normal = normal, .skip = skip});
    }
  if (settings.empty())
    throw InputError(fmt::format("--splines: found {}, expected some of the lattice of {}, with a prefilter of --prefilters and a way of --intersect",
                                 fmt::join(choices.splines, ","), subject.name));
  return settings;
}

}  // namespace quincunx
