// The samples of a volume file, read box by box: for volumes larger than memory.
#pragma once

#include <memory>
#include <string>

#include "io/input_file.h"
#include "lattice/sample_source.h"

namespace quincunx {

/// An NRRD file as read_volume understands it, with the same checks, whose samples stay where they are. Those of encoding raw are read from
/// the file itself; of gzip and ascii they are unpacked once to a scratch file.
///
/// Read, not mapped: a file that becomes shorter is an error, where a mapping would end the program, and pages of the file do not count as
/// the program's memory.
class SampleFile final : public SampleSource {
 public:
  struct Config {
    std::string scratch;  ///< folder of the scratch file; empty: TMPDIR or /tmp
  };

  /// `progress` is that of unpacking. Throws InputError naming the file, what was found and what was expected, or --scratch where the
  /// unpacked samples do not fit there.
  SampleFile(const std::string& path, const Config& config, const Progress& progress = {});

  const Volume& header() const override { return header_; }
  Volume read_box(const glm::i64vec3& low, const glm::i64vec3& high) const override;

  /// Bytes of the scratch file; 0 where there is none.
  std::uint64_t scratch_bytes() const { return scratch_bytes_; }

 private:
  Volume header_;
  std::unique_ptr<InputFile> samples_;
  std::uint64_t begin_ = 0;  ///< of the first sample in samples_
  std::uint64_t scratch_bytes_ = 0;
  bool swap_bytes_ = false;
};

}  // namespace quincunx
