// quincunx-bench cluster: ways to merge active blocks to larger boxes, their leaves against their time.
#pragma once

#include "app/command.h"

namespace quincunx {

Command cluster_command(CLI::App& program);

}  // namespace quincunx
