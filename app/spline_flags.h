// --spline, --prefilter and --storage: how a volume is reconstructed.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "spline/spline.h"
#include "spline/storage.h"

namespace quincunx {

/// "--spline": a name of spline_names(); empty beforehand and afterwards where it was not given: default_spline of the volume's lattice.
CLI::Option* add_spline(CLI::App& app, std::string& spline);

/// "--prefilter".
CLI::Option* add_prefilter(CLI::App& app, Spline::Prefilter& prefilter);

/// "--storage".
CLI::Option* add_storage(CLI::App& app, Storage& storage);

}  // namespace quincunx
