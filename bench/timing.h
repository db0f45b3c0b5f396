// Frames of several settings, timed in turns.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "bench/setting.h"
#include "lattice/progress.h"
#include "render/renderer.h"

namespace quincunx {

/// What a setting's frames cost.
struct Cost {
  std::vector<double> frame_ms;                       ///< number round * views + view
  std::uint64_t rays = 0, hits = 0, evaluations = 0;  ///< over one frame of each view
};

/// What is to be timed.
struct TimingPlan {
  std::vector<Setting> settings;
  std::vector<Renderer::Request> views;  ///< alike in size; a setting is applied to each
  int rounds = 3;
};

/// Called with each untimed frame: number of the setting, of the view, and the frame.
using FrameListener = std::function<void(std::size_t setting, std::size_t view, const Frame& frame)>;

/// Traces every setting from every view once untimed, which also compiles and counts evaluations, then `rounds` times
/// timed. The settings take turns frame by frame, so that a machine that slows down favours none.
/// One Cost for each setting. `device`: name of the device, as RenderStats has it.
std::vector<Cost> time_in_turns(Renderer& renderer, const TimingPlan& plan, const FrameListener& listen,
                                std::string& device, const Progress& progress = {});

/// How many times as fast as `baseline` the frames are: median, 5th and 95th percentile of the ratios of the two frames
/// of one round and view. Both have the same number of frames, at least one.
struct Spread {
  double median = 0.0, p5 = 0.0, p95 = 0.0;
};
Spread speedup(const Cost& cost, const Cost& baseline);

/// Median, 5th and 95th percentile of at least one value.
Spread spread(const std::vector<double>& values);
/// {"median":..,"p5":..,"p95":..}.
nlohmann::ordered_json spread_json(const Spread& spread);

}  // namespace quincunx
