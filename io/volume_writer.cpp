#define ZLIB_CONST
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <new>
#include <span>
#include <vector>

#include "io/atomic_file.h"
#include "io/nrrd_header.h"
#include "io/volume_file.h"

namespace quincunx {
namespace {

static_assert(std::endian::native == std::endian::little, "samples are written as they lie in memory");

constexpr std::size_t block_bytes = 1 << 20;  ///< packed, written and reported at a time

/// Packs bytes as one gzip member without a time or a name: the same bytes always pack alike.
class GzipWriter {
 public:
  explicit GzipWriter(AtomicFile& file) : file_(file), packed_(1 << 18) {
    constexpr int gzip = 16, memory_level = 8;
    if (deflateInit2(&stream_, Z_DEFAULT_COMPRESSION, Z_DEFLATED, MAX_WBITS + gzip, memory_level, Z_DEFAULT_STRATEGY) !=
        Z_OK) {
      throw std::bad_alloc();
    }
  }
  ~GzipWriter() { deflateEnd(&stream_); }
  GzipWriter(const GzipWriter&) = delete;
  GzipWriter& operator=(const GzipWriter&) = delete;

  void write(std::span<const std::byte> bytes) { pack(bytes, Z_NO_FLUSH); }
  void finish() { pack({}, Z_FINISH); }

 private:
  void pack(std::span<const std::byte> bytes, int flush) {
    stream_.next_in = reinterpret_cast<const Bytef*>(bytes.data());
    stream_.avail_in = uInt(bytes.size());
    do {
      stream_.next_out = packed_.data();
      stream_.avail_out = uInt(packed_.size());
      deflate(&stream_, flush);
      file_.write(std::as_bytes(std::span(packed_).first(packed_.size() - stream_.avail_out)));
    } while (stream_.avail_out == 0);
  }

  AtomicFile& file_;
  std::vector<Bytef> packed_;
  z_stream stream_{};
};

std::span<const std::byte> sample_bytes(const Volume& volume) {
  return std::visit([](const auto& s) { return std::as_bytes(std::span(s)); }, volume.samples);
}

/// Hands the samples on block by block.
template <class Sink>
void write_blocks(std::span<const std::byte> bytes, Sink& sink, const Progress& progress) {
  for (std::size_t done = 0; done < bytes.size(); done += block_bytes) {
    report(progress, double(done) / double(bytes.size()));
    sink.write(bytes.subspan(done, std::min(block_bytes, bytes.size() - done)));
  }
}

}  // namespace

void write_volume(const Volume& volume, const std::string& path, Encoding encoding, const Progress& progress) {
  const std::string header = format_nrrd(volume, encoding == Encoding::gzip ? "gzip" : "raw", path);
  AtomicFile file(path);
  file.write(std::as_bytes(std::span(header)));
  if (encoding == Encoding::gzip) {
    GzipWriter packer(file);
    write_blocks(sample_bytes(volume), packer, progress);
    packer.finish();
  } else {
    write_blocks(sample_bytes(volume), file, progress);
  }
  report(progress, 1.0);
  file.commit();
}

}  // namespace quincunx
