// Drawings by gnuplot, which need not be there.
#pragma once

#include <string>

namespace quincunx {

enum class Drawn { yes, no_gnuplot, failed };

/// Runs gnuplot with `script` on its standard input, and makes what it writes to standard output the file `path`, whole or not at all.
/// Nothing else comes through; no shell is involved. Throws InputError where `path` cannot be written.
Drawn draw_with_gnuplot(const std::string& script, const std::string& path);

}  // namespace quincunx
