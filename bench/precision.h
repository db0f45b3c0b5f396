// quincunx-bench precision: first hits in 32-bit and 64-bit floats, their error against their time.
#pragma once

#include "app/command.h"

namespace quincunx {

Command precision_command(CLI::App& program);

}  // namespace quincunx
