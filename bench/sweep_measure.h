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
  double moved = 0.0;        ///< what is added to isovalues and to the transfer function's values to learn what other ones cost
};

/// What one setting cost.
struct SweepMeasurement {
  Cost cost;                                  ///< rays, hits and evaluations over one frame of each view, as the next two
  std::uint64_t steps = 0, intervals = 0;
  std::vector<double> traversal_ms;           ///< of each view: the structure walked to the end of all rays, nothing evaluated
  std::uint64_t traversal_intervals = 0;      ///< of those walks together
  RenderStats stages;                         ///< times of all that had to be made for the setting; moved values
  std::vector<double> segments_ms;            ///< as cost.frame_ms, of which they are parts: lists of segments; empty where there are none
  RenderStats scene;                          ///< bytes and counts; times of what other values made necessary
  double change_ms() const;                   ///< these together: classify, cluster, build, table and upload
  std::uint64_t differing_pixels = 0;         ///< of the frames of all views, against those of the first setting, bit for bit
};

/// A frame's pixels that are not, bit for bit, those of another one of its size: colour, depth or normal.
std::uint64_t differing_pixels(const Frame& a, const Frame& b);

/// `scene` with all isovalues and all of the transfer function's values greater by `by`.
Scene moved_scene(Scene scene, double by);

/// Measures all settings round by round, and appends a measurement to `measured` as soon as a setting's first round is
/// complete: when this throws (Interrupted), `measured` holds the complete ones, with the rounds that are whole. In a round a setting
/// renders the first view untimed (structure and kernels are ready then; drivers may have dropped kernels that were compiled long ago),
/// then each view once timed. The first round begins with moved values, which tells all stages, and with each view counted and
/// walked; the counted frames are compared with those of the first setting.
void measure_sweep(Renderer& renderer, const SweepPlan& plan, std::vector<SweepMeasurement>& measured,
                   const Progress& progress = {});

/// What `--skip auto` takes for a scene.
SkipConfig chosen_skip(Renderer& renderer, const Renderer::Request& view, const Progress& progress = {});

}  // namespace quincunx
