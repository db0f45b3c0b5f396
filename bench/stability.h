// quincunx stability: stiff and extreme cases, judged by the double-precision reference.
#pragma once

#include "app/command.h"

namespace quincunx {

Command stability_command(CLI::App& program);

}  // namespace quincunx
