// quincunx-bench convergence: how fast the errors of values and gradients fall with the spacing.
#pragma once

#include "app/command.h"

namespace quincunx {

Command convergence_command(CLI::App& program);

}  // namespace quincunx
