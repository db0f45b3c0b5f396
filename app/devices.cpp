// quincunx devices: what there is to render on.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/values.h"
#include "gpu/gpu.h"

namespace quincunx {
namespace {

using Json = nlohmann::ordered_json;

struct DevicesFlags {
  bool json = false;
};

std::string version_text(std::uint32_t version) {
  return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                     VK_API_VERSION_PATCH(version));
}

Json to_json(const gpu::DeviceInfo& device) {
  return {{"index", device.index},
          {"name", device.name},
          {"type", device.type},
          {"driver", device.driver},
          {"vulkan", version_text(device.api_version)},
          {"memory_bytes", device.memory_bytes},
          {"max_storage_buffer_range", device.max_storage_buffer_range},
          {"max_texel_buffer_elements", device.max_texel_buffer_elements},
          {"usable", device.usable}};
}

void devices(const DevicesFlags& flags) {
  const std::vector<gpu::DeviceInfo> list = gpu::list_devices();
  if (flags.json) {
    Json json = Json::array();
    for (const gpu::DeviceInfo& device : list) json.push_back(to_json(device));
    fmt::print("{}\n", json.dump(2));
    return;
  }
  for (const gpu::DeviceInfo& device : list) {
    fmt::print("{:>3}  {}\n     {}, Vulkan {}, {}, {} of memory{}\n", device.index, device.name, device.type,
               version_text(device.api_version), device.driver, readable_bytes(double(device.memory_bytes)),
               device.usable ? "" : "; not usable: needs Vulkan 1.2, a compute queue and timestamps");
  }
  fmt::print("cpu  the reference in double precision, always there, slow\n");
}

}  // namespace

Command devices_command(CLI::App& program) {
  auto flags = std::make_shared<DevicesFlags>();
  CLI::App* app = program.add_subcommand("devices", "List the devices that --device of render takes");
  app->footer("--device takes an index, a part of a name, or cpu.");
  app->add_flag("--json", flags->json, "Print the Vulkan devices as JSON");
  return {app, [flags] { devices(*flags); }};
}

}  // namespace quincunx
