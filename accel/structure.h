// The plug-in point of skipping structures, and the one list of them.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "accel/classification.h"

namespace quincunx {

/// What a structure hands to the renderer: bytes for one buffer of its GLSL twin, and the buffer's name there.
struct StructureBuffer {
  std::string name;
  std::span<const std::byte> bytes;
};

/// A skipping structure. On the device it answers one question: the next interval of the ray that may hold a
/// surface (the contract of its GLSL twin is in shaders/skip.glsl).
class SkippingStructure {
 public:
  virtual ~SkippingStructure() = default;

  virtual std::string_view name() const = 0;
  /// The GLSL twin, a file of shaders/.
  virtual std::string_view shader() const = 0;
  /// True where the structure reads a classification (none does not: no bounds are computed for it).
  virtual bool needs_classification() const = 0;
  /// Builds from the classification; replaces what was built before.
  virtual void build(const Classification& classification) = 0;
  /// The buffers to upload; valid until the next build.
  virtual std::vector<StructureBuffer> buffers() const = 0;
};

/// The names make_structure knows.
const std::vector<std::string_view>& structure_names();

/// The structure of that name; throws InputError naming the choices.
std::unique_ptr<SkippingStructure> make_structure(std::string_view name);

}  // namespace quincunx
