// Both ways to read a volume: at once, and box by box.
#pragma once

#include <string>

#include "lattice/volume.h"

namespace quincunx {

/// Reads the file as a whole and all of it through a SampleFile, and expects the same volume to the last bit or the same
/// InputError, which it lets through.
Volume read_twice(const std::string& path);

}  // namespace quincunx
