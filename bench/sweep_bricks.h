// Brick pools with bricks of several sizes beside the whole volume on the device.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/timing.h"
#include "lattice/progress.h"
#include "lattice/volume.h"
#include "render/renderer.h"

namespace quincunx {

/// What is to be measured.
struct BricksPlan {
  std::vector<int> bricks;              ///< edges in cells, ascending
  std::uint64_t pool_bytes = 1u << 30;  ///< of each pool
  std::string device;                   ///< as make_renderer takes it
  Renderer::Config config;              ///< of the renderer of the whole volume, and of the pools' but for their pool
  SkipConfig skip;                      ///< complete; cells are never tested, for those of a pool's volume are not bounded
  std::vector<Renderer::Request> views;
  int rounds = 1;
};

/// What one of them cost.
struct BricksMeasurement {
  int brick = 0;                ///< edge in cells; 0: the whole volume
  BrickStats first;             ///< of the pool when every view has been seen once
  double first_ms = 0.0;        ///< of the passes of these frames
  std::vector<double> frame_ms; ///< of the rounds, number round * views + view: the passes, without loading
  std::uint64_t loads = 0;      ///< of the rounds, bricks: 0 where the pool holds all that the views need
  std::uint64_t device_bytes = 0;      ///< coefficients, or the pool and its page table
  std::uint64_t differing_pixels = 0;  ///< of all views, against the whole volume's, bit for bit
};

/// Throws InputError naming --pool where a pool holds not even one brick of some size, or more than can be numbered, and --nan where void cells
/// were asked for, which bricks do not have: before anything is measured.
void check_bricks(const BricksPlan& plan, const Volume& volume);

/// Renders each view once untimed, the whole volume by `whole` (of plan.config) and through a pool of each kind of brick, compares the
/// frames, and then times `rounds` frames of each view in turns. The first measurement is that of the whole volume. Throws InputError
/// as make_renderer does.
std::vector<BricksMeasurement> measure_bricks(const BricksPlan& plan, const Volume& volume, Renderer& whole, const Progress& progress = {});

}  // namespace quincunx
