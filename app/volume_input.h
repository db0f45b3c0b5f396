// Volumes as the sub-commands want them: checked, and refused with the way out.
#pragma once

#include <string>

#include "lattice/progress.h"
#include "lattice/volume.h"

namespace quincunx {

/// Reads a BCC volume of finite samples. Throws InputError naming the file: for a Cartesian volume with the command
/// that makes a BCC one of it, for NaN or infinite samples with their number and the first one's place.
/// A volume whose samples are all finite. Throws InputError, naming the file, otherwise.
Volume read_finite_volume(const std::string& path, const Progress& progress);

Volume read_bcc_volume(const std::string& path, const Progress& progress);

/// `word` as a POSIX shell reads it back.
std::string shell_quoted(const std::string& word);

}  // namespace quincunx
