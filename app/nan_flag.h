// --nan: what becomes of samples that are NaN or infinite.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>

#include "lattice/not_finite.h"

namespace quincunx {

/// "refuse", "empty", or "fill=V", V a finite number that a 32-bit float holds. Throws InputError naming `flag`.
NanPolicy parse_nan_policy(std::string_view text, std::string_view flag);

/// "--nan".
CLI::Option* add_nan(CLI::App& app, NanPolicy& policy);

}  // namespace quincunx
