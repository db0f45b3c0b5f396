#include "bench/sweep_measure.h"

#include <cassert>
#include <cstring>
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
  struct Rendered {
    Frame frame;
    RenderStats stats;
  };
  Rendered render(const Renderer::Request& request) {
    const auto within = [this](double fraction) { report(progress_, (done_ + fraction) / all_); };
    within(0.0);
    Rendered rendered;
    rendered.frame = renderer_.render(request, rendered.stats, within);
    done_ += 1.0;
    return rendered;
  }

 private:
  Renderer& renderer_;
  const SweepPlan& plan_;
  const Progress& progress_;
  double done_ = 0.0, all_ = 1.0;
};

/// Makes everything new for the setting, then for the true values.
void measure_stages(Frames& frames, const SweepPlan& plan, std::size_t setting, SweepMeasurement& m) {
  Renderer::Request request = frames.request(setting, 0);
  if (plan.details) {
    request.scene = moved_scene(std::move(request.scene), plan.moved);
    m.stages = frames.render(request).stats;
  }
  m.scene = frames.render(frames.request(setting, 0)).stats;
}

/// Counts, and gives the frame.
Frame count(Frames& frames, std::size_t setting, std::size_t view, SweepMeasurement& m) {
  Renderer::Request request = frames.request(setting, view);
  request.count_costs = true;
  Frames::Rendered rendered = frames.render(request);
  m.cost.rays += rendered.stats.rays;
  m.cost.hits += rendered.stats.hits;
  m.cost.evaluations += rendered.stats.evaluations;
  m.steps += rendered.stats.steps;
  m.intervals += rendered.stats.intervals;
  return std::move(rendered.frame);
}

/// The first view once untimed, then each; the structure alone, without the walk over cells that may follow it.
void walk(Frames& frames, std::size_t setting, std::size_t views, SweepMeasurement& m) {
  for (std::size_t n = 0; n <= views; ++n) {
    Renderer::Request request = frames.request(setting, n == 0 ? 0 : n - 1);
    request.scene.stub_sampling = true;
    request.skip.cell_test = false;
    request.count_costs = n > 0;
    const RenderStats stats = frames.render(request).stats;
    if (n == 0) continue;
    m.traversal_ms.push_back(stats.trace_ms.front());
    m.traversal_intervals += stats.intervals;
  }
}

/// Adds one timed frame of each view, or none where one is interrupted.
void time_views(Frames& frames, std::size_t setting, std::size_t views, SweepMeasurement& m) {
  std::vector<double> frame_ms, segments_ms;
  for (std::size_t view = 0; view < views; ++view) {
    const RenderStats stats = frames.render(frames.request(setting, view)).stats;
    frame_ms.push_back(stats.trace_ms.front());
    if (!stats.segments.ms.empty()) segments_ms.push_back(stats.segments.ms.front());
  }
  m.cost.frame_ms.insert(m.cost.frame_ms.end(), frame_ms.begin(), frame_ms.end());
  m.segments_ms.insert(m.segments_ms.end(), segments_ms.begin(), segments_ms.end());
}

/// `truth`: the first setting's frames, by view, which that setting's own round leaves there.
SweepMeasurement first_round(Frames& frames, const SweepPlan& plan, std::size_t setting, std::vector<Frame>& truth) {
  SweepMeasurement m;
  measure_stages(frames, plan, setting, m);
  if (plan.details) {
    for (std::size_t view = 0; view < plan.views.size(); ++view) {
      Frame frame = count(frames, setting, view, m);
      if (setting == 0) {
        truth.push_back(std::move(frame));
      } else {
        m.differing_pixels += differing_pixels(frame, truth[view]);
      }
    }
    walk(frames, setting, plan.views.size(), m);
  }
  time_views(frames, setting, plan.views.size(), m);
  return m;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b, std::size_t first, std::size_t count) {
  return std::memcmp(a.data() + first, b.data() + first, count * sizeof(float)) == 0;
}

}  // namespace

double SweepMeasurement::change_ms() const {
  return scene.classify_ms + scene.cluster_ms + scene.build_ms + scene.table_ms + scene.upload_ms;
}

std::uint64_t differing_pixels(const Frame& a, const Frame& b) {
  assert(a.width == b.width && a.height == b.height);
  std::uint64_t differing = 0;
  for (std::size_t p = 0; p < a.depth.size(); ++p) {
    if (!same_bits(a.color, b.color, 4 * p, 4) || !same_bits(a.depth, b.depth, p, 1) || !same_bits(a.normal, b.normal, 3 * p, 3)) ++differing;
  }
  return differing;
}

Scene moved_scene(Scene scene, double by) {
  for (Isosurface& surface : scene.isosurfaces) surface.isovalue += by;
  if (!scene.volume) return scene;
  for (auto& point : scene.volume->function.colors) point.value += by;
  for (auto& point : scene.volume->function.opacities) point.value += by;
  return scene;
}

void measure_sweep(Renderer& renderer, const SweepPlan& plan, std::vector<SweepMeasurement>& measured,
                   const Progress& progress) {
  Frames frames(renderer, plan, progress);
  std::vector<Frame> truth;
  for (std::size_t s = 0; s < plan.settings.size(); ++s) measured.push_back(first_round(frames, plan, s, truth));
  for (int round = 1; round < plan.rounds; ++round) {
    for (std::size_t s = 0; s < plan.settings.size(); ++s) {
      frames.render(frames.request(s, 0));
      time_views(frames, s, plan.views.size(), measured[s]);
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
