// quincunx-bench voxels: voxels in a bounding interval hierarchy against ordinary volume rendering, memory against quality against time.
#pragma once

#include "app/command.h"

namespace quincunx {

Command voxels_command(CLI::App& program);

}  // namespace quincunx
