// A volume made ready to be rendered again and again: the one interface of `--device cpu` and of Vulkan devices.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "accel/skip_config.h"
#include "lattice/not_finite.h"
#include "lattice/progress.h"
#include "lattice/sample_source.h"
#include "render/precision.h"
#include "render/scene.h"
#include "render/voxel_stats.h"
#include "spline/spline.h"
#include "spline/storage.h"

namespace quincunx {

/// The brick pool of a renderer, since it was made.
struct BrickStats {
  int edge = 0;  ///< cells; 0: there is no pool
  std::uint64_t count = 0, slots = 0, resident = 0;
  std::uint64_t loads = 0, evictions = 0, loaded_bytes = 0;
  std::uint64_t rounds = 0;  ///< of loading what rays waited for
  double load_ms = 0.0;
};

/// Lists of segments that a structure makes for each ray of a frame before it enters (accel/structure.h, SegmentPass).
struct SegmentStats {
  int capacity = 0;        ///< of a list; 0: there are none
  std::vector<double> ms;  ///< what making them took, one entry a frame; a part of trace_ms
  std::uint64_t steps = 0, listed = 0, full = 0;  ///< of one frame: steps of making them, segments, lists that are full
};

/// What one call of Renderer::render cost. Milliseconds; 0 for what did not have to be done (again).
struct RenderStats {
  std::string device;
  SkipConfig skip;  ///< as it was used
  Precision precision = Precision::float32;  ///< likewise
  std::string storage;                       ///< of coefficients: float64, or as --storage names it
  double prefilter_ms = 0, upload_ms = 0, compile_ms = 0;
  double table_ms = 0;     ///< of the transfer function, for the kernel
  double bounds_ms = 0;    ///< of cells and blocks, and what a structure makes of them alone: once a volume and block size
  double classify_ms = 0;  ///< blocks, and cells where they are tested
  double cluster_ms = 0, build_ms = 0;  ///< of the structure for the isovalues
  std::vector<double> trace_ms;  ///< one entry a frame, timestamp queries where the device has them
  std::vector<std::pair<std::string, std::uint64_t>> device_bytes;  ///< by purpose: coefficients, structure, occupancy, frame
  std::uint64_t blocks = 0, active_blocks = 0, active_cells = 0;
  glm::i64vec3 block_extents{0};                  ///< blocks per axis
  std::uint64_t leaves = 0, nodes = 0, one_child = 0;  ///< see StructureReport
  int depth = 0;
  std::uint64_t void_cells = 0;                   ///< of NanPolicy::empty
  std::uint64_t rays = 0, hits = 0;
  BrickStats bricks;
  SegmentStats segments;
  std::uint64_t evaluations = 0, steps = 0, intervals = 0;  ///< of all rays; only where asked for
  std::optional<VoxelStats> voxels;  ///< of pictures of voxels
};

/// One thing a kernel can contain, whether it does, and why (`--explain`).
struct Feature {
  std::string name;
  bool compiled = false;
  std::string why;
};

class Renderer {
 public:
  struct Config {
    std::string spline;  ///< a name of spline_names(); empty: default_spline of the volume's lattice
    Spline::Prefilter prefilter = Spline::Prefilter::automatic;
    NanPolicy nan;       ///< what becomes of samples that are not finite
    Precision precision = Precision::float32;  ///< of the kernels; float64 not with a pool. "cpu" computes in doubles in any case
    /// Of coefficients on the device, in one unit or, with a pool, in one a brick; float32 with Precision::float64. "cpu" takes the others as the device
    /// would decode them, and doubles in place of float32.
    Storage storage = Storage::float32;
    std::optional<std::uint64_t> pool_bytes;  ///< of coefficients on the device at a time, in bricks; none: all of them
    int brick = 32;           ///< edge of a brick in cells, a power of two, 4..256
    bool validation = false;  ///< Vulkan validation layers; any message throws
  };
  struct Request {
    Scene scene;
    SkipConfig skip;
    int repeat = 1;                  ///< frames to trace and time, all alike; when more than one, an untimed one warms up before
    bool count_costs = false;  ///< one more, untimed pass that counts evaluations, steps and intervals
  };

  virtual ~Renderer() = default;
  /// Renders. What does not depend on a changed part of the request is kept from the call before: the coefficients
  /// and cell bounds always, the block bounds while the block size stays, pipelines while the variant stays.
  /// Throws InputError for a bad request (flag named).
  virtual Frame render(const Request& request, RenderStats& stats, const Progress& progress = {}) = 0;
  /// What the kernel for `request` contains and what it leaves out. Empty for the CPU.
  virtual std::vector<Feature> explain(const Request& request) = 0;
};

/// How `device` finds first roots of that spline where nothing is asked for: exact, and march where the spline's pieces are no polynomials, of
/// which Vulkan devices cannot find them so.
Intersect default_intersect(const std::string& device, const Spline& spline);

/// Why the volume of which `header` tells lattice, extents and type cannot be rendered whole, its samples and coefficients in this machine's memory
/// and on `device`, as half a sentence; empty where it can, and for "cpu". Throws InputError for a device that is not there or a spline of
/// another lattice.
std::string why_not_whole(const std::string& device, const Volume& header, const Renderer::Config& config);

/// Bytes of a pool for such a volume, where none is asked for: 1 GiB, or half of the device's memory where that is less.
std::uint64_t default_pool_bytes(const std::string& device);

/// Makes a volume ready for the device chosen by `device`: "cpu" (double precision), "" (a GPU where there is one, else
/// a CPU implementation of Vulkan), an index or part of a name as `quincunx devices` lists them.
/// Throws InputError for a volume of another lattice than the spline's or one that has NaN or infinite samples where config.nan refuses them,
/// or for config.storage with Precision::float64, DeviceError for a device that is not there, cannot compute in config.precision or cannot read config.storage.
std::unique_ptr<Renderer> make_renderer(const std::string& device, const Volume& volume, const Renderer::Config& config);

/// The same for samples that stay where they are and are read brick by brick into a pool of config.pool_bytes, which is set. `what` names
/// them in errors. Not for "cpu". Throws InputError also for what a pool of bricks cannot show: marching, central differences, void cells, float64.
std::unique_ptr<Renderer> make_renderer(const std::string& device, std::shared_ptr<const SampleSource> source, const std::string& what,
                                        const Renderer::Config& config);

}  // namespace quincunx
