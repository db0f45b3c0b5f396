// The errors of the gpu folder that are not a Vulkan call's own.
#pragma once

#include <stdexcept>

namespace quincunx::gpu {

/// A device that is not there or cannot do what is asked: a user's to mend.
class DeviceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// GLSL that does not compile; the message begins with file:line.
class ShaderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace quincunx::gpu
