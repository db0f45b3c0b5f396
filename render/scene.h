// What is to be rendered, and how: the same for the device's caster and the reference caster.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lattice/lattice.h"
#include "render/camera.h"
#include "render/transfer_function.h"

namespace quincunx {

/// One isosurface. Colour is linear RGB 0..1, opacity 0..1.
struct Isosurface {
  double isovalue = 0.0;
  glm::dvec3 color{0.9, 0.82, 0.7};
  double opacity = 1.0;
};

/// How a volume's samples become colours: each one by itself, or each stretch by the values at its two ends.
enum class Classify { post, pre_integrated };

/// A volume seen through a transfer function.
struct DirectVolume {
  TransferFunction function;
  Classify classify = Classify::post;
  int entries = 0;           ///< of the table, or of each side of the pre-integrated one; 0: 4096, or 512 pre-integrated
  double step = 1.0;         ///< length of a stretch in cells: world length over that of the shortest lattice step
  bool adaptive = false;     ///< stretches are parted into up to 8 where the value goes along more than `finest`; of Classify::post
  double finest = 1.0 / 64;  ///< part of the function's range of values
  bool shade = true;         ///< a light at the eye, by the gradient
  double modulate_from = 0.0, modulate_to = 0.0;  ///< gradient magnitudes, data units per world unit, between which extinctions, -ln(1 -
                                                  ///< opacity), grow from 0 to their own; equal: not modulated
  double termination = 1.0 / 512;  ///< a ray ends where less than this is let through
  std::optional<std::uint32_t> jitter;  ///< seed: shifts the stretches of each pixel by a random part of one

  bool modulated() const { return modulate_from < modulate_to; }
  int table_entries() const { return entries > 0 ? entries : classify == Classify::post ? 4096 : 512; }
};

/// The length of one cell in the world: of the shortest step of the lattice.
double cell_length(const World& world);

enum class Intersect { exact, march };
/// Of a surface: the spline's gradient; central differences of the spline, half a step `delta` away; or the classical way, central differences of the
/// coefficients along the axes of a coset, one sample to either side, interpolated by the spline. The last are the central differences of the spline with
/// half a step of the lattice's (2 cells BCC, 1 Cartesian): sum_j M(u - j) (c_{j+e} - c_{j-e}) / 2h = (s(u + e) - s(u - e)) / 2h, |e| = h. Both kinds of
/// differences end at the domain's border, where they are shorter.
enum class Normal { analytic, central, samples };

/// A picture to make.
struct Scene {
  std::vector<Isosurface> isosurfaces;  ///< any order; isovalues differ
  std::optional<DirectVolume> volume;   ///< shown together with them, in depth order; at least one of both
  Camera camera;
  int width = 512, height = 512;
  glm::dvec3 background{0.0};  ///< linear RGB behind everything; alpha there is 0
  double ambient = 0.2;        ///< the part of the colour that does not depend on the normal; headlight for the rest

  Intersect intersect = Intersect::exact;  ///< on Vulkan devices of splines with polynomial pieces alone (Spline::polynomial)
  double step = 0.25;  ///< of Intersect::march, in cells along the ray
  Normal normal = Normal::analytic;
  double delta = 0.5;  ///< of Normal::central, in cells
  bool cost = false;   ///< also the cost channels
  /// Rays only walk the skipping structure, all of it to their end, and evaluate nothing: nothing is hit, and the frame's
  /// time is that of the traversal. Counts steps and intervals whether `cost` is set or not. Not for the reference caster.
  bool stub_sampling = false;
};

/// As --normal names them.
std::string_view normal_name(Normal normal);

/// Half the step of the differences of Normal::central and Normal::samples in a volume on `lattice`, in cells.
double difference_step(const Scene& scene, LatticeKind lattice);

/// The isosurfaces that leave a trace in the picture (opacity above 0), by ascending isovalue.
std::vector<Isosurface> visible_surfaces(const Scene& scene);

/// Their isovalues.
std::vector<double> isovalues_of(const std::vector<Isosurface>& surfaces);

/// Throws InputError naming the flag where a number is out of range or not finite.
void check_scene(const Scene& scene);

/// A finished picture, float32 channels as DESIGN names them, row 0 at the top, one plane after another.
///   color[4*p ..]  R G B A (linear, alpha = 1 - transmittance, colour premultiplied over the background)
///   depth[p]       Z: distance from the eye along the ray in world units to the first hit; +inf where nothing is hit. Without
///                  isosurfaces: to the end of the stretch by which a volume hides half of what is behind it
///   normal[3*p ..] N.X N.Y N.Z: unit normal at the first hit, world space, facing the viewer; 0 where nothing is hit
///   cost[3*p ..]   evaluations, steps, intervals; empty unless asked for
struct Frame {
  int width = 0, height = 0;
  std::vector<float> color, depth, normal, cost;
};

/// Evaluations, steps and intervals of all rays together, from the cost channels; zeros where there are none.
struct CostSums {
  std::uint64_t evaluations = 0, steps = 0, intervals = 0;
};
CostSums cost_sums(const Frame& frame);

/// The number of pixels whose ray met a surface or opacity.
std::uint64_t count_hits(const Frame& frame);

}  // namespace quincunx
