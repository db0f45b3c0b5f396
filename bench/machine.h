// Where a measurement was made.
#pragma once

#include <string>

namespace quincunx {

struct Machine {
  std::string device, driver;  ///< of Vulkan, empty where none took part; driver empty for the CPU reference too
  std::string processor;       ///< as Linux names it, or "unknown processor"
  unsigned cores = 0;          ///< that this process may use
};

/// `device` as RenderStats names it; where it is empty, Vulkan is asked nothing.
Machine this_machine(const std::string& device);

/// "llvmpipe (LLVM 15.0.6, 256 bits), llvmpipe Mesa 22.3.6, on 2 cores of AMD EPYC"; without a device its second half alone.
std::string machine_text(const Machine& machine);

}  // namespace quincunx
