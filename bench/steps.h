// quincunx-bench steps: volume rendering against a closed form, by the length of steps.
#pragma once

#include "app/command.h"

namespace quincunx {

Command steps_command(CLI::App& program);

}  // namespace quincunx
