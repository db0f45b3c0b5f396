// Where a measurement was made.
#pragma once

#include <string>

namespace quincunx {

struct Machine {
  std::string device, driver;  ///< of Vulkan; driver empty for the CPU reference
  std::string processor;       ///< as Linux names it, or "unknown processor"
  unsigned cores = 0;          ///< that this process may use
};

/// `device` as RenderStats names it.
Machine this_machine(const std::string& device);

/// "llvmpipe (LLVM 15.0.6, 256 bits), llvmpipe Mesa 22.3.6, on 2 cores of AMD EPYC".
std::string machine_text(const Machine& machine);

}  // namespace quincunx
