#include "bench/machine.h"

#include <fmt/format.h>

#include <fstream>
#include <thread>

#include "gpu/gpu.h"

namespace quincunx {
namespace {

/// The first "model name : X" of /proc/cpuinfo.
std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

}  // namespace

Machine this_machine(const std::string& device) {
  Machine machine{device, "", processor_name(), std::thread::hardware_concurrency()};
  for (const gpu::DeviceInfo& info : gpu::list_devices()) {
    if (info.name == device) machine.driver = info.driver;
  }
  return machine;
}

std::string machine_text(const Machine& machine) {
  return fmt::format("{}{}{}, on {} cores of {}", machine.device, machine.driver.empty() ? "" : ", ", machine.driver,
                     machine.cores, machine.processor);
}

}  // namespace quincunx
