// quincunx-bench ranges: ways to ask whether an interval of values meets one with opacity.
#pragma once

#include "app/command.h"

namespace quincunx {

Command ranges_command(CLI::App& program);

}  // namespace quincunx
