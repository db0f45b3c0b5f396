// Volumes in files: NRRD, Cartesian and BCC.
#pragma once

#include <string>

#include "lattice/progress.h"
#include "lattice/volume.h"

namespace quincunx {

/// Reads an NRRD file: attached (.nrrd) or detached (.nhdr) header, raw, gzip or ascii encoding, either endian.
///   Cartesian: 3-D; `spacings` or `space directions` + `space origin`, neither meaning unit steps.
///   BCC: 4-D, sizes nx ny nz 2, key/value lattice:=bcc, directions those of one coset grid and none.
/// Sizes are checked against the file's length before anything is allocated.
/// Throws InputError naming the file, what was found and what was expected.
Volume read_volume(const std::string& path, const Progress& progress = {});

/// The volume without its samples (`samples` is empty but of their type), of which only the header is read. Throws as read_volume does of headers.
Volume read_volume_header(const std::string& path);

/// How write_volume packs the samples.
enum class Encoding { raw, gzip };

/// Writes an attached-header NRRD (BCC in the layout above), whole or not at all: beside, then renamed.
/// Throws InputError where the place cannot be written.
void write_volume(const Volume& volume, const std::string& path, Encoding encoding = Encoding::gzip,
                  const Progress& progress = {});

}  // namespace quincunx
