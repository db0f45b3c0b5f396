// The bytes inside a gzip stream.
#pragma once

#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/input_file.h"

namespace quincunx {

/// Inflates what a file holds from its position to its end: one or several gzip members and nothing else.
/// Checksums are verified. Every error is an InputError naming the file.
class GzipReader {
 public:
  /// No stream of `packed` bytes holds more: deflate codes at most 258 bytes in 2 bits.
  static std::uint64_t max_unpacked(std::uint64_t packed) { return packed * 1032; }

  explicit GzipReader(InputFile& file);
  ~GzipReader();
  GzipReader(const GzipReader&) = delete;
  GzipReader& operator=(const GzipReader&) = delete;

  /// Inflates up to `bytes`; fewer only where the last member ends.
  /// Throws where the stream is damaged, ends early or is followed by something else.
  std::size_t read(void* to, std::size_t bytes);

 private:
  InputFile& file_;
  std::vector<Bytef> packed_;
  z_stream stream_{};
  bool between_members_ = true;
};

}  // namespace quincunx
