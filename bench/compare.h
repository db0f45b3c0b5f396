// quincunx compare: error against time of splines, ways to the hit, gradients and skipping.
#pragma once

#include "app/command.h"

namespace quincunx {

Command compare_command(CLI::App& program);

}  // namespace quincunx
