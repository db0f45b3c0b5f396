// The pipelines of a device, by variant: made once, however many renderers use them.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "gpu/gpu.h"
#include "render/kernel.h"

namespace quincunx {

/// A pass of a picture, ready to run.
struct KernelPass {
  Pass pass;
  gpu::Pipeline pipeline;
};
/// Those of a variant, in order.
using Kernels = std::vector<KernelPass>;

class KernelCache {
 public:
  explicit KernelCache(std::shared_ptr<gpu::Device> device) : device_(std::move(device)) {}

  gpu::Device& device() const { return *device_; }
  /// The kernels of `variant`, compiled where they have not been; adds the milliseconds that took to `compile_ms`.
  const Kernels& kernels(const KernelVariant& variant, double& compile_ms);

 private:
  std::shared_ptr<gpu::Device> device_;
  std::map<KernelVariant, Kernels> kernels_;
};

}  // namespace quincunx
