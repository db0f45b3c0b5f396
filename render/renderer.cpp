#include "render/renderer.h"

#include <fmt/format.h>

#include "gpu/gpu.h"
#include "lattice/error.h"
#include "render/device_renderer.h"
#include "render/reference_renderer.h"

namespace quincunx {

namespace {

/// `wanted` with its spline's name, which is one of the volume's lattice.
Renderer::Config with_spline(Renderer::Config wanted, LatticeKind lattice) {
  if (wanted.spline.empty()) wanted.spline = default_spline(lattice);
  const std::unique_ptr<Spline> spline = make_spline(wanted.spline);
  if (lattice != spline->lattice())
    throw InputError(fmt::format("--spline: found a volume on the {} lattice, expected {}, the lattice of {}", lattice_name(lattice),
                                 lattice_name(spline->lattice()), wanted.spline));
  return wanted;
}

std::shared_ptr<KernelCache> open_kernels(const std::string& device, const Renderer::Config& config) {
  gpu::DeviceConfig choice;
  choice.select = device;
  choice.validation = config.validation;
  return std::make_shared<KernelCache>(gpu::open_device(choice));
}

}  // namespace

std::unique_ptr<Renderer> make_renderer(const std::string& device, const Volume& volume, const Renderer::Config& wanted) {
  check_volume(volume, "volume");
  const Renderer::Config config = with_spline(wanted, volume.lattice);
  if (device == "cpu") return std::make_unique<ReferenceRenderer>(volume, config);
  return std::make_unique<DeviceRenderer>(open_kernels(device, config), volume, config);
}

std::unique_ptr<Renderer> make_renderer(const std::string& device, std::shared_ptr<const SampleSource> source, const std::string& what,
                                        const Renderer::Config& wanted) {
  const Renderer::Config config = with_spline(wanted, source->header().lattice);
  if (device == "cpu") throw InputError("--pool: found --device cpu, expected a Vulkan device: the reference holds the whole volume");
  return std::make_unique<DeviceRenderer>(open_kernels(device, config), std::move(source), what, config);
}

}  // namespace quincunx
