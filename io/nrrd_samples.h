// The samples in an NRRD file.
#pragma once

#include "io/input_file.h"
#include "io/nrrd_header.h"
#include "lattice/progress.h"

namespace quincunx {

/// Reads the samples that `header` describes from `file` (the header's own, or its data file).
/// Before anything is allocated the sizes are checked against the file's length: exactly for raw, by the
/// most that deflate can expand to for gzip, by two bytes a sample for ascii; after that memory grows with what is
/// really there. Throws InputError unless the file holds just as many samples as the header says, and ends there.
Volume::Samples read_nrrd_samples(InputFile& file, const NrrdHeader& header, const Progress& progress);

}  // namespace quincunx
