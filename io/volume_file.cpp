#include "io/volume_file.h"

#include "io/input_file.h"
#include "io/nrrd_header.h"
#include "io/nrrd_samples.h"

namespace quincunx {

Volume read_volume(const std::string& path, const Progress& progress) {
  InputFile file(path);
  const NrrdHeader header = interpret_nrrd(read_nrrd_text(file));

  Volume volume = volume_of(header);
  if (header.data_file.empty()) {
    volume.samples = read_nrrd_samples(file, header, progress);
  } else {
    InputFile data(header.data_file);
    volume.samples = read_nrrd_samples(data, header, progress);
  }
  check_volume(volume, path);
  return volume;
}

Volume read_volume_header(const std::string& path) {
  InputFile file(path);
  return volume_of(interpret_nrrd(read_nrrd_text(file)));
}

}  // namespace quincunx
