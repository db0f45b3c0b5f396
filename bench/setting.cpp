#include "bench/setting.h"

#include <fmt/format.h>

#include <algorithm>

namespace quincunx {

std::string Setting::method() const { return intersect == Intersect::exact ? "exact" : fmt::format("march {}", step); }

Renderer::Request Setting::applied(Renderer::Request request) const {
  request.scene.intersect = intersect;
  if (intersect == Intersect::march) request.scene.step = step;
  request.skip.structure = structure;
  return request;
}

Setting published_setting() { return {Intersect::march, 0.25, "none"}; }

std::vector<Setting> intersect_settings(std::span<const double> steps) {
  std::vector<Setting> settings{{Intersect::exact, 0.0, "grid"}, {Intersect::exact, 0.0, "none"}};
  for (const char* structure : {"grid", "none"}) {
    for (const double step : steps) settings.push_back({Intersect::march, step, structure});
  }
  if (std::find(settings.begin(), settings.end(), published_setting()) == settings.end()) {
    settings.push_back(published_setting());
  }
  return settings;
}

}  // namespace quincunx
