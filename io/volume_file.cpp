#include "io/volume_file.h"

#include "io/input_file.h"
#include "io/nrrd_header.h"
#include "io/nrrd_samples.h"

namespace quincunx {

Volume read_volume(const std::string& path, const Progress& progress) {
  InputFile file(path);
  const NrrdHeader header = interpret_nrrd(read_nrrd_text(file));

  Volume volume;
  volume.lattice = header.lattice;
  volume.extents = header.extents;
  volume.world = header.world;
  volume.notes = header.notes;
  if (header.data_file.empty()) {
    volume.samples = read_nrrd_samples(file, header, progress);
  } else {
    InputFile data(header.data_file);
    volume.samples = read_nrrd_samples(data, header, progress);
  }
  check_volume(volume, path);
  return volume;
}

}  // namespace quincunx
