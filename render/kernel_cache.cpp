#include "render/kernel_cache.h"

#include "lattice/stopwatch.h"

namespace quincunx {
namespace {

gpu::Pipeline make_pipeline(gpu::Device& device, const KernelVariant& variant, Pass pass) {
  return gpu::create_pipeline(device, gpu::compile(device, kernel_files(variant), kernel_source(variant, pass)));
}

}  // namespace

const Kernels& KernelCache::kernels(const KernelVariant& variant, double& compile_ms) {
  const auto found = kernels_.find(variant);
  if (found != kernels_.end()) return found->second;
  const Stopwatch watch;
  Kernels made;
  for (const Pass pass : passes(variant)) made.push_back({pass, make_pipeline(*device_, variant, pass)});
  compile_ms += watch.ms();
  return kernels_.emplace(variant, std::move(made)).first->second;
}

}  // namespace quincunx
