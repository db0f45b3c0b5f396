#include "render/renderer.h"

#include <fmt/format.h>

#include "gpu/gpu.h"
#include "lattice/error.h"
#include "render/device_renderer.h"
#include "render/reference_renderer.h"

namespace quincunx {

std::unique_ptr<Renderer> make_renderer(const std::string& device, const Volume& volume, const Renderer::Config& wanted) {
  check_volume(volume, "volume");
  Renderer::Config config = wanted;
  if (config.spline.empty()) config.spline = default_spline(volume.lattice);
  const std::unique_ptr<Spline> spline = make_spline(config.spline);
  if (volume.lattice != spline->lattice())
    throw InputError(fmt::format("--spline: found a volume on the {} lattice, expected {}, the lattice of {}", lattice_name(volume.lattice),
                                 lattice_name(spline->lattice()), config.spline));
  if (device == "cpu") return std::make_unique<ReferenceRenderer>(volume, config);
  gpu::DeviceConfig choice;
  choice.select = device;
  choice.validation = config.validation;
  return std::make_unique<DeviceRenderer>(std::make_shared<KernelCache>(gpu::open_device(choice)), volume, config);
}

}  // namespace quincunx
