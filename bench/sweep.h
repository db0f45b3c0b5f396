// quincunx sweep: every way to skip, with every block size, on one volume.
#pragma once

#include "app/command.h"

namespace quincunx {

Command sweep_command(CLI::App& program);

}  // namespace quincunx
