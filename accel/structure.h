// The plug-in point of skipping structures, and the one list of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "accel/classification.h"
#include "accel/skip_config.h"
#include "accel/thresholds.h"

namespace quincunx {

/// Elements of a buffer of a GLSL twin: unsigned integers, by channels and bits.
enum class TexelFormat { r8, rg16, rg32, rgba32 };

/// What a structure hands to the renderer: bytes for one buffer of its GLSL twin, and the buffer's name there.
struct StructureBuffer {
  std::string name;
  TexelFormat format = TexelFormat::r8;
  std::span<const std::byte> bytes;  ///< never empty
  std::uint64_t version = 0;         ///< another one whenever the bytes have changed
};

/// What a structure consists of, and what making it took. Milliseconds of the last prepare and build together.
struct StructureReport {
  std::uint64_t leaves = 0;     ///< boxes or blocks that may hold a surface, as rays meet them
  std::uint64_t nodes = 0;      ///< of a tree, leaves included; 0 where there is none
  std::uint64_t one_child = 0;  ///< nodes with one child, where a tree has such
  int depth = 0;                ///< of a tree: nodes from the root to the deepest leaf
  double cluster_ms = 0.0;      ///< blocks to larger boxes
  double build_ms = 0.0;        ///< all else
};

/// How a structure lists, before the rays of a picture enter, the segments of each that may matter: a pass of its own (shaders/segments.comp), from
/// what its buffers hold. Its twin reads the lists; parameters().x is their capacity.
struct SegmentPass {
  std::string_view shader;  ///< a file of shaders/ that defines list_segments
  int capacity = 1;         ///< segments of a ray, 1 or more
};

/// A skipping structure. On the device it answers one question: the next interval of the ray that may hold a
/// surface (the contract of its GLSL twin is in shaders/skip.glsl).
class SkippingStructure {
 public:
  /// What has to be known before it can be built; each includes the ones before.
  enum class Needs { nothing, bounds, classification };

  virtual ~SkippingStructure() = default;

  virtual std::string_view name() const = 0;
  /// The GLSL twin, a file of shaders/.
  virtual std::string_view shader() const = 0;
  virtual Needs needs() const { return Needs::classification; }

  /// Builds what depends on the volume and the block size alone.
  virtual void prepare(const BlockBounds&) {}
  /// Builds what depends on the isovalues, after prepare for the same blocks; replaces what was built before.
  /// `blocks`: which of them may hold a surface; empty where needs() is less than classification.
  virtual void build(const Classification& blocks, const Thresholds& thresholds) = 0;
  /// Takes over what kernels compare bounds with, after a build for the same blocks with the same ones active; nothing where they compare none.
  virtual void compare(const Thresholds&) {}
  /// Orders what depends on where rays come from. `eye` in lattice coordinates.
  virtual void arrange(const glm::dvec3& /*eye*/) {}

  /// The buffers to upload; valid until the next prepare, build, compare or arrange.
  virtual std::vector<StructureBuffer> buffers() const = 0;
  /// parameters.structure of the GLSL twin; what it means is written there.
  virtual glm::ivec4 parameters() const { return glm::ivec4(0); }
  virtual StructureReport report() const = 0;
  /// Of a structure that has one.
  virtual std::optional<SegmentPass> segment_pass() const { return std::nullopt; }
};

/// The names make_structure knows, for SkipConfig::structure.
const std::vector<std::string_view>& structure_names();

/// The structure that `config` names; throws InputError naming the choices.
std::unique_ptr<SkippingStructure> make_structure(const SkipConfig& config);

/// Every way to skip that can be compared, by label: the names, with the choices that some of them have ("bvh:boxes",
/// "kdtree:shallow").
const std::vector<std::string_view>& skip_labels();
/// The configuration a label stands for, block size and cell test as in `base`; throws InputError naming the choices.
SkipConfig labelled_skip(std::string_view label, SkipConfig base = {});
/// The label of a configuration.
std::string skip_label(const SkipConfig& config);

}  // namespace quincunx
