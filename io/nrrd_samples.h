// The samples in an NRRD file.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "io/input_file.h"
#include "io/nrrd_header.h"
#include "lattice/progress.h"

namespace quincunx {

/// Reads the samples that `header` describes from `file` (the header's own, or its data file).
/// Before anything is allocated the sizes are checked against the file's length: exactly for raw, by the
/// most that deflate can expand to for gzip, by two bytes a sample for ascii; after that memory grows with what is
/// really there. Throws InputError unless the file holds just as many samples as the header says, and ends there.
Volume::Samples read_nrrd_samples(InputFile& file, const NrrdHeader& header, const Progress& progress);

/// Takes the next samples, in this machine's byte order.
using SampleSink = std::function<void(std::span<const std::byte> samples)>;

/// Hands the same samples on a block at a time, with the same checks and errors; the last ones come after the sink was called.
void unpack_nrrd_samples(InputFile& file, const NrrdHeader& header, const SampleSink& sink, const Progress& progress);

/// Where in `file` the samples of encoding raw begin, which end with it; nothing is read. Throws the same errors.
std::uint64_t raw_nrrd_begin(InputFile& file, const NrrdHeader& header);

/// Reverses the bytes of each sample.
void swap_sample_bytes(Volume::Samples& samples);

}  // namespace quincunx
