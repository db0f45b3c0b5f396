#include "bench/timing.h"

#include <cassert>
#include <nlohmann/json.hpp>

#include "app/render_report.h"

namespace quincunx {

std::vector<Cost> time_in_turns(Renderer& renderer, const TimingPlan& plan, const FrameListener& listen,
                                std::string& device, const Progress& progress) {
  std::vector<Cost> costs(plan.settings.size());
  const double frames = double(plan.rounds + 1) * double(plan.views.size() * plan.settings.size());
  double done = 0.0;
  for (int round = -1; round < plan.rounds; ++round) {
    const bool timed = round >= 0;
    for (std::size_t view = 0; view < plan.views.size(); ++view) {
      for (std::size_t s = 0; s < plan.settings.size(); ++s) {
        report(progress, done++ / frames);
        Renderer::Request request = plan.settings[s].applied(plan.views[view]);
        request.repeat = 1;
        request.count_costs = !timed;
        RenderStats stats;
        const Frame frame = renderer.render(request, stats);
        Cost& cost = costs[s];
        if (timed) {
          cost.frame_ms.push_back(stats.trace_ms.front());
          continue;
        }
        cost.rays += stats.rays;
        cost.hits += stats.hits;
        cost.evaluations += stats.evaluations;
        device = stats.device;
        listen(s, view, frame);
      }
    }
  }
  return costs;
}

Spread spread(const std::vector<double>& values) {
  return {percentile(values, 0.5), percentile(values, 0.05), percentile(values, 0.95)};
}

Spread speedup(const Cost& cost, const Cost& baseline) {
  assert(cost.frame_ms.size() == baseline.frame_ms.size());
  std::vector<double> ratios;
  for (std::size_t n = 0; n < cost.frame_ms.size(); ++n) ratios.push_back(baseline.frame_ms[n] / cost.frame_ms[n]);
  return spread(ratios);
}

nlohmann::ordered_json spread_json(const Spread& spread) {
  return {{"median", spread.median}, {"p5", spread.p5}, {"p95", spread.p95}};
}

}  // namespace quincunx
