// The one table of what a ray caster kernel can contain, and how a kernel is composed from it.
#pragma once

#include <string>
#include <vector>

#include "accel/structure.h"
#include "gpu/gpu.h"
#include "render/renderer.h"

namespace quincunx {

/// What one kernel is for.
struct KernelVariant {
  std::string spline_shader = "bcc7.glsl";
  std::string structure = "none";  ///< a name of structure_names()
  std::string structure_shader = "skip_none.glsl";
  std::string segments_shader = "";  ///< of the structure's SegmentPass; empty where it has none
  bool cell_test = false;
  Intersect intersect = Intersect::exact;
  Normal normal = Normal::analytic;  ///< samples are central differences with another step: not told apart here
  bool surfaces = true;         ///< there are isosurfaces
  bool many_isovalues = false;  ///< more than one
  bool composite = false;       ///< a surface lets something through
  bool cost = false;            ///< counts evaluations, steps and intervals
  bool volume = false;          ///< a volume is seen through a transfer function
  bool pre_integrated = false, adaptive = false, lit = false, modulated = false, jitter = false;  ///< how
  bool stub = false;            ///< walks the structure and evaluates nothing
  bool bricks = false;          ///< coefficients are in a brick pool
  bool brick_units = false;     ///< and each brick's in a unit of its own
  bool voids = false;           ///< there are void cells
  Precision precision = Precision::float32;  ///< of what decides a picture; float64 not with `bricks`
  int coefficient_buffers = 1;  ///< 1..8 texel buffers
  int coefficient_shift = 0;    ///< log2 of the elements of each, where there are several

  auto operator<=>(const KernelVariant&) const = default;
};

/// Makes `variant` one of that structure.
void set_structure(KernelVariant& variant, const SkippingStructure& structure);

/// The passes of a picture. Where the structure has lists of segments, they are made (segments). Rays go to their first cell that may matter (enter). Those that have one are traced: by one pass
/// (trace); or, where their first root is all there is to find, by one that finds it (seek) and one that shades it; or
/// the volume along them is integrated (volume); or they only walk on (traverse).
enum class Pass { segments, enter, trace, seek, shade, volume, traverse };

/// Those that `variant` has, in order.
std::vector<Pass> passes(const KernelVariant& variant);

/// What compiling it needs. The includes structure.glsl, segments.glsl, spline.glsl and intersect.glsl are the variant's own.
gpu::KernelSource kernel_source(const KernelVariant& variant, Pass pass);
gpu::ShaderFiles kernel_files(const KernelVariant& variant);

/// The parts that are the skipping structure, first roots of polynomials, and normals of differences.
inline constexpr const char* kSkipPart = "skipping structure";
inline constexpr const char* kDifferencesPart = "central differences";
inline constexpr const char* kExactPart = "exact intersection";

/// A part of the table, as it stands in the SPIR-V: the name of a function or of a buffer that is there exactly if the
/// part is compiled into a pass.
struct KernelPart {
  Feature feature;
  std::string witness;
};
std::vector<KernelPart> kernel_parts(const KernelVariant& variant);

}  // namespace quincunx
