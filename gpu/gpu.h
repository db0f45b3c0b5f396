// Vulkan compute as plain structs and free functions. Knows nothing of volumes.
//
// Errors: DeviceError for a device that is not there or cannot do what is asked (a user's to mend);
// std::runtime_error with the call's text for any Vulkan call that fails, and for a caller's mistakes with names and
// sizes; ShaderError for GLSL that does not compile.
#pragma once

#include "gpu/buffer.h"
#include "gpu/device.h"
#include "gpu/dispatch.h"
#include "gpu/error.h"
#include "gpu/pipeline.h"
#include "gpu/reflection.h"
#include "gpu/shader.h"
