#include "bench/sweep_measure.h"

#include <utility>

namespace quincunx {
namespace {

/// Renders a plan's frames and tells how far it is.
class Frames {
 public:
  Frames(Renderer& renderer, const SweepPlan& plan, const Progress& progress)
      : renderer_(renderer), plan_(plan), progress_(progress) {
    const double views = double(plan.views.size()), extra = plan.details ? 2.0 + 2.0 * views : 0.0;
    all_ = double(plan.settings.size()) * (plan.rounds * (1.0 + views) + extra);
  }

  /// The request for a setting and a view, for render to take.
  Renderer::Request request(std::size_t setting, std::size_t view) const {
    Renderer::Request request = plan_.views[view];
    request.skip = plan_.settings[setting].skip;
    request.repeat = 1;
    return request;
  }
  RenderStats render(const Renderer::Request& request) {
    const auto within = [this](double fraction) { report(progress_, (done_ + fraction) / all_); };
    within(0.0);
    RenderStats stats;
    renderer_.render(request, stats, within);
    done_ += 1.0;
    return stats;
  }

 private:
  Renderer& renderer_;
  const SweepPlan& plan_;
  const Progress& progress_;
  double done_ = 0.0, all_ = 1.0;
};

/// Makes everything new for the setting, then for the true isovalues.
void measure_stages(Frames& frames, const SweepPlan& plan, std::size_t setting, SweepMeasurement& m) {
  Renderer::Request request = frames.request(setting, 0);
  if (plan.details) {
    for (Isosurface& surface : request.scene.isosurfaces) surface.isovalue += plan.moved_isovalue;
    m.stages = frames.render(request);
  }
  m.scene = frames.render(frames.request(setting, 0));
  m.new_isovalue_ms = m.scene.classify_ms + m.scene.cluster_ms + m.scene.build_ms + m.scene.upload_ms;
}

void count(Frames& frames, std::size_t setting, std::size_t view, SweepMeasurement& m) {
  Renderer::Request request = frames.request(setting, view);
  request.count_costs = true;
  const RenderStats stats = frames.render(request);
  m.cost.rays += stats.rays;
  m.cost.hits += stats.hits;
  m.cost.evaluations += stats.evaluations;
  m.steps += stats.steps;
  m.intervals += stats.intervals;
}

/// The first view once untimed, then each; the structure alone, without the walk over cells that may follow it.
void walk(Frames& frames, std::size_t setting, std::size_t views, SweepMeasurement& m) {
  for (std::size_t n = 0; n <= views; ++n) {
    Renderer::Request request = frames.request(setting, n == 0 ? 0 : n - 1);
    request.scene.stub_sampling = true;
    request.skip.cell_test = false;
    request.count_costs = n > 0;
    const RenderStats stats = frames.render(request);
    if (n == 0) continue;
    m.traversal_ms.push_back(stats.trace_ms.front());
    m.traversal_intervals += stats.intervals;
  }
}

/// One timed frame of each view.
std::vector<double> time_views(Frames& frames, std::size_t setting, std::size_t views) {
  std::vector<double> ms;
  for (std::size_t view = 0; view < views; ++view)
    ms.push_back(frames.render(frames.request(setting, view)).trace_ms.front());
  return ms;
}

SweepMeasurement first_round(Frames& frames, const SweepPlan& plan, std::size_t setting) {
  SweepMeasurement m;
  measure_stages(frames, plan, setting, m);
  if (plan.details) {
    for (std::size_t view = 0; view < plan.views.size(); ++view) count(frames, setting, view, m);
    walk(frames, setting, plan.views.size(), m);
  }
  m.cost.frame_ms = time_views(frames, setting, plan.views.size());
  return m;
}

}  // namespace

void measure_sweep(Renderer& renderer, const SweepPlan& plan, std::vector<SweepMeasurement>& measured,
                   const Progress& progress) {
  Frames frames(renderer, plan, progress);
  for (std::size_t s = 0; s < plan.settings.size(); ++s) measured.push_back(first_round(frames, plan, s));
  for (int round = 1; round < plan.rounds; ++round) {
    for (std::size_t s = 0; s < plan.settings.size(); ++s) {
      frames.render(frames.request(s, 0));
      const std::vector<double> ms = time_views(frames, s, plan.views.size());
      std::vector<double>& all = measured[s].cost.frame_ms;
      all.insert(all.end(), ms.begin(), ms.end());
    }
  }
}

SkipConfig chosen_skip(Renderer& renderer, const Renderer::Request& view, const Progress& progress) {
  Renderer::Request request = view;
  request.skip = SkipConfig{};
  request.scene.width = request.scene.height = 8;  // a choice needs no picture
  RenderStats stats;
  renderer.render(request, stats, progress);
  return stats.skip;
}

}  // namespace quincunx
