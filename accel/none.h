// No skipping: the whole ray may hold a surface.
#pragma once

#include "accel/structure.h"

namespace quincunx {

/// The structure that skips nothing and has no buffers: what every other one is compared with.
class None final : public SkippingStructure {
 public:
  std::string_view name() const override { return "none"; }
  std::string_view shader() const override { return "skip_none.glsl"; }
  Needs needs() const override { return Needs::nothing; }
  void build(const Classification&, const Thresholds&) override {}
  std::vector<StructureBuffer> buffers() const override { return {}; }
  StructureReport report() const override { return {}; }
};

}  // namespace quincunx
