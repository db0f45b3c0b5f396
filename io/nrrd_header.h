// What an NRRD header means for a volume.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/nrrd_text.h"
#include "lattice/volume.h"

namespace quincunx {

/// How the samples are packed in the file.
enum class NrrdEncoding { raw, gzip, ascii };

/// Everything a header says about a volume and where its samples are.
///
/// Ignored, being of no consequence to the samples or their places: block size, number, min, max, old min, old max,
/// sample units, thicknesses, axis mins, axis maxs, centerings, labels, units, space units, measurement frame.
struct NrrdHeader {
  LatticeKind lattice = LatticeKind::cartesian;
  Extents extents{0};
  std::uint64_t sample_count = 0;
  World world;
  SampleType type = SampleType::uint8;
  /// Key/value pairs without `lattice`; the fields `content` and `space` come first under these keys.
  std::vector<std::pair<std::string, std::string>> notes;

  NrrdEncoding encoding = NrrdEncoding::raw;
  bool swap_bytes = false;     ///< the file's byte order is not this machine's
  std::string data_file;       ///< path of a detached header's data, empty for an attached header
  std::int64_t line_skip = 0;  ///< lines before the data
  std::int64_t byte_skip =
      0;  ///< bytes before the samples after that (of the unpacked stream for gzip); -1: all but the last
  std::uint64_t data_offset = 0;  ///< of an attached header's data in the file
};

/// The header as a volume without samples.
Volume volume_of(const NrrdHeader& header);

/// Interprets a header. Throws InputError naming the file, the field, what was found and what was expected.
NrrdHeader interpret_nrrd(const NrrdText& text);

/// The header of `volume`, attached and little endian, with its empty line. `encoding` is "raw" or "gzip".
/// Throws InputError, naming `path`, where the volume has something that NRRD cannot hold (a note's key, a singular
/// world, no samples).
std::string format_nrrd(const Volume& volume, std::string_view encoding, const std::string& path);

}  // namespace quincunx
