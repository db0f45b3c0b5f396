#include "bench/sweep_bricks.h"

#include <memory>

#include "accel/bricks.h"
#include "bench/sweep_measure.h"
#include "lattice/error.h"
#include "lattice/sample_source.h"

namespace quincunx {
namespace {

std::uint64_t coefficient_bytes(const RenderStats& stats) {
  std::uint64_t bytes = 0;
  for (const auto& [purpose, count] : stats.device_bytes)
    if (purpose == "coefficients" || purpose == "brick pool" || purpose == "page table") bytes += count;
  return bytes;
}

/// The renderers that take turns.
class Turns {
 public:
  Turns(const BricksPlan& plan, const Volume& volume, Renderer& whole, const Progress& progress) : plan_(plan), progress_(progress) {
    const auto source = std::make_shared<VolumeSource>(volume);
    renderers_.push_back(&whole);
    for (const int brick : plan.bricks) {
      Renderer::Config config = plan.config;
      config.pool_bytes = plan.pool_bytes;
      config.brick = brick;
      pools_.push_back(make_renderer(plan.device, source, "volume", config));
      renderers_.push_back(pools_.back().get());
    }
    all_ = double(renderers_.size() * plan.views.size()) * double(plan.rounds + 1);
  }

  std::size_t count() const { return renderers_.size(); }
  Frame render(std::size_t renderer, std::size_t view, RenderStats& stats) {
    Renderer::Request request = plan_.views[view];
    request.skip = plan_.skip;
    request.skip.cell_test = false;
    request.repeat = 1;
    report(progress_, done_ / all_);
    Frame frame = renderers_[renderer]->render(request, stats, [this](double part) { report(progress_, (done_ + part) / all_); });
    done_ += 1.0;
    return frame;
  }

 private:
  const BricksPlan& plan_;
  const Progress& progress_;
  std::vector<std::unique_ptr<Renderer>> pools_;
  std::vector<Renderer*> renderers_;
  double done_ = 0.0, all_ = 1.0;
};

/// Each view once.
void see_all(Turns& turns, std::size_t views, std::vector<BricksMeasurement>& measured) {
  for (std::size_t view = 0; view < views; ++view) {
    Frame truth;
    for (std::size_t n = 0; n < turns.count(); ++n) {
      RenderStats stats;
      Frame frame = turns.render(n, view, stats);
      BricksMeasurement& m = measured[n];
      m.first = stats.bricks;
      m.first_ms += stats.trace_ms.front();
      m.device_bytes = coefficient_bytes(stats);
      if (n == 0) {
        truth = std::move(frame);
      } else {
        m.differing_pixels += differing_pixels(frame, truth);
      }
    }
  }
}

void time_round(Turns& turns, std::size_t views, std::vector<BricksMeasurement>& measured) {
  for (std::size_t view = 0; view < views; ++view) {
    for (std::size_t n = 0; n < turns.count(); ++n) {
      RenderStats stats;
      turns.render(n, view, stats);
      measured[n].frame_ms.push_back(stats.trace_ms.front());
      measured[n].loads = stats.bricks.loads - measured[n].first.loads;
    }
  }
}

}  // namespace

void check_bricks(const BricksPlan& plan, const Volume& volume) {
  if (plan.bricks.empty()) return;
  if (plan.config.nan.kind == NanPolicy::Kind::empty && may_not_be_finite(volume))
    throw InputError("--nan: found empty for bricks (--bricks), expected fill=V or refuse");
  const std::string spline = plan.config.spline.empty() ? std::string(default_spline(volume.lattice)) : plan.config.spline;
  for (const int brick : plan.bricks) BrickLayout(volume.lattice, volume.extents, make_spline(spline)->apron(), brick).slots(plan.pool_bytes);
}

std::vector<BricksMeasurement> measure_bricks(const BricksPlan& plan, const Volume& volume, Renderer& whole, const Progress& progress) {
  Turns turns(plan, volume, whole, progress);
  std::vector<BricksMeasurement> measured(turns.count());
  for (std::size_t n = 1; n < measured.size(); ++n) measured[n].brick = plan.bricks[n - 1];
  see_all(turns, plan.views.size(), measured);
  for (int round = 0; round < plan.rounds; ++round) time_round(turns, plan.views.size(), measured);
  return measured;
}

}  // namespace quincunx
