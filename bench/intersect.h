// quincunx-bench intersect: ways to find the first hit, their error against their time.
#pragma once

#include "app/command.h"

namespace quincunx {

Command intersect_command(CLI::App& program);

}  // namespace quincunx
