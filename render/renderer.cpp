#include "render/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "gpu/gpu.h"
#include "lattice/error.h"
#include "lattice/memory.h"
#include "render/coefficient_texels.h"
#include "render/device_renderer.h"
#include "render/reference_renderer.h"

namespace quincunx {

namespace {

/// `wanted` with the name of its spline, which is one of the volume's lattice and has the prefilter, and with a storage that goes with its precision.
Renderer::Config checked(Renderer::Config wanted, LatticeKind lattice) {
  check_storage(wanted.storage, wanted.precision);
  const std::unique_ptr<Spline> spline = make_spline(wanted.spline, lattice);
  spline->filter(wanted.prefilter);
  wanted.spline = spline->name();
  return wanted;
}

std::shared_ptr<KernelCache> open_kernels(const std::string& device, const Renderer::Config& config) {
  gpu::DeviceConfig choice;
  choice.select = device;
  choice.validation = choice.gpu_assisted = config.validation;
  return std::make_shared<KernelCache>(gpu::open_device(choice));
}

gpu::DeviceInfo device_meant(const std::string& device) {
  const std::vector<gpu::DeviceInfo> devices = gpu::list_devices();
  return devices[gpu::choose_device(devices, device)];
}

double gib(std::uint64_t bytes) { return double(bytes) / double(1 << 30); }

}  // namespace

std::string why_not_whole(const std::string& device, const Volume& header, const Renderer::Config& wanted) {
  const Renderer::Config config = checked(wanted, header.lattice);
  if (device == "cpu") return "";
  const gpu::DeviceInfo info = device_meant(device);
  const std::uint64_t numbers = coefficient_count(header.lattice, header.extents, make_spline(config.spline)->apron());
  const std::uint64_t most = most_coefficients(info.max_texel_buffer_elements);
  if (numbers > most) return fmt::format("{} coefficients are more than the {} that {} takes", numbers, most, info.name);

  // Samples; coefficients as floats, as what kernels read too where that is another format, and a second time on a CPU's device; bounds of cells: two 16-bit numbers each.
  const glm::i64vec3 cells = domain_max(header.lattice, header.extents);
  const CoefficientFormat format{.precision = config.precision, .storage = config.storage};
  const std::uint64_t on_device = numbers * format.bytes(), on_host = numbers * sizeof(float) + (format == CoefficientFormat{} ? 0 : on_device);
  const std::uint64_t bytes = std::uint64_t(coset_count(header.lattice) * header.extents.x * header.extents.y * header.extents.z) * sample_type_bytes(header.type()) +
                              on_host + (info.type == "CPU" ? on_device : 0) + std::uint64_t(cells.x * cells.y * cells.z) * 2 * sizeof(std::uint16_t);
  const std::uint64_t memory = memory_bytes();
  if (bytes > memory) return fmt::format("it needs {:.1f} GiB of this machine's memory, {:.1f} GiB", gib(bytes), gib(memory));
  if (info.type != "CPU" && on_device > info.memory_bytes)
    return fmt::format("{:.1f} GiB of coefficients are more than the {:.1f} GiB of {}", gib(on_device), gib(info.memory_bytes), info.name);
  return "";
}

Intersect default_intersect(const std::string& device, const Spline& spline) {
  return device == "cpu" || spline.polynomial() ? Intersect::exact : Intersect::march;
}

std::uint64_t default_pool_bytes(const std::string& device) {
  return std::min(std::uint64_t(1) << 30, device_meant(device).memory_bytes / 2);
}

std::unique_ptr<Renderer> make_renderer(const std::string& device, const Volume& volume, const Renderer::Config& wanted) {
  check_volume(volume, "volume");
  const Renderer::Config config = checked(wanted, volume.lattice);
  if (device == "cpu") return std::make_unique<ReferenceRenderer>(volume, config);
  return std::make_unique<DeviceRenderer>(open_kernels(device, config), volume, config);
}

std::unique_ptr<Renderer> make_renderer(const std::string& device, std::shared_ptr<const SampleSource> source, const std::string& what,
                                        const Renderer::Config& wanted) {
  const Renderer::Config config = checked(wanted, source->header().lattice);
  if (device == "cpu") throw InputError("--pool: found --device cpu, expected a Vulkan device: the reference holds the whole volume");
  return std::make_unique<DeviceRenderer>(open_kernels(device, config), std::move(source), what, config);
}

}  // namespace quincunx
