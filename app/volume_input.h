// Volumes as the sub-commands want them: checked, and refused with the way out.
#pragma once

#include <string>

#include "lattice/not_finite.h"
#include "lattice/progress.h"
#include "lattice/volume.h"

namespace quincunx {

/// Reads a volume. Throws InputError naming the file, also, where `nan` refuses them, for samples that are NaN or infinite, with their number
/// and the first one's place; else they stay as they are.
Volume read_finite_volume(const std::string& path, const Progress& progress, const NanPolicy& nan = {});

/// The same of a BCC volume. Throws InputError for a Cartesian one with the command that makes a BCC one of it.
Volume read_bcc_volume(const std::string& path, const Progress& progress, const NanPolicy& nan = {});

/// `word` as a POSIX shell reads it back.
std::string shell_quoted(const std::string& word);

}  // namespace quincunx
