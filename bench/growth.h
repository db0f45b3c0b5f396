// quincunx-bench growth: how frame times grow with the volume, for every way to skip.
#pragma once

#include "app/command.h"

namespace quincunx {

Command growth_command(CLI::App& program);

}  // namespace quincunx
