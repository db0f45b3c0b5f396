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
  if (device.empty()) return machine;
  for (const gpu::DeviceInfo& info : gpu::list_devices()) {
    if (info.name == device) machine.driver = info.driver;
  }
  return machine;
}

std::string machine_text(const Machine& machine) {
  const std::string processor = fmt::format("on {} cores of {}", machine.cores, machine.processor);
  if (machine.device.empty()) return processor;
  return fmt::format("{}{}{}, {}", machine.device, machine.driver.empty() ? "" : ", ", machine.driver, processor);
}

}  // namespace quincunx
