// Frames and stages of ways to skip, measured in turns.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/sweep_settings.h"
#include "bench/timing.h"
#include "lattice/progress.h"
#include "render/renderer.h"

namespace quincunx {

/// What is to be measured.
struct SweepPlan {
  std::vector<SweepSetting> settings;    ///< the first one is what the others are compared with: none
  std::vector<Renderer::Request> views;  ///< alike but for the camera; a setting is applied to each
  int rounds = 1;
  bool details = true;       ///< all that SweepMeasurement has; else frame times and counts of blocks alone
  double moved_isovalue = 0.0;  ///< what is added to the isovalues to learn what other ones cost
};

/// What one setting cost.
struct SweepMeasurement {
  Cost cost;                                  ///< rays, hits and evaluations over one frame of each view, as the next two
  std::uint64_t steps = 0, intervals = 0;
  std::vector<double> traversal_ms;           ///< of each view: the structure walked to the end of all rays, nothing evaluated
  std::uint64_t traversal_intervals = 0;      ///< of those walks together
  RenderStats stages;                         ///< times of all that had to be made for the setting; moved isovalues
  RenderStats scene;                          ///< bytes and counts
  double new_isovalue_ms = 0.0;               ///< classify, cluster, build and upload when the isovalues change
};

/// Measures all settings round by round, and appends a measurement to `measured` as soon as a setting's first round is
/// complete: when this throws (Interrupted), `measured` holds the complete ones, with the rounds that are whole. In a round a setting
/// renders the first view untimed (structure and kernels are ready then; drivers may have dropped kernels that were compiled long ago),
/// then each view once timed. The first round begins with moved isovalues, which tells all stages, and with each view counted and
/// walked.
void measure_sweep(Renderer& renderer, const SweepPlan& plan, std::vector<SweepMeasurement>& measured,
                   const Progress& progress = {});

/// What `--skip auto` takes for a scene.
SkipConfig chosen_skip(Renderer& renderer, const Renderer::Request& view, const Progress& progress = {});

}  // namespace quincunx
