#include "io/gzip_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <new>

#include "lattice/error.h"

namespace quincunx {

GzipReader::GzipReader(InputFile& file) : file_(file), packed_(1 << 18) {
  constexpr int gzip_only = 16;
  if (inflateInit2(&stream_, MAX_WBITS + gzip_only) != Z_OK) throw std::bad_alloc();
}

GzipReader::~GzipReader() { inflateEnd(&stream_); }

std::size_t GzipReader::read(void* to, std::size_t bytes) {
  const std::size_t wanted = std::min<std::size_t>(bytes, std::numeric_limits<uInt>::max());
  stream_.next_out = static_cast<Bytef*>(to);
  stream_.avail_out = uInt(wanted);
  while (stream_.avail_out > 0) {
    if (stream_.avail_in == 0) {
      stream_.next_in = packed_.data();
      stream_.avail_in = uInt(file_.read(packed_.data(), packed_.size()));
      if (stream_.avail_in == 0 && between_members_) break;
      if (stream_.avail_in == 0) {
        throw InputError(fmt::format("{}: the file ends inside the gzip stream, expected more bytes", file_.path()));
      }
    }
    between_members_ = false;
    const int status = inflate(&stream_, Z_NO_FLUSH);
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    if (status == Z_STREAM_END) {
      inflateReset(&stream_);
      between_members_ = true;
    } else if (status != Z_OK && status != Z_BUF_ERROR) {
      throw InputError(fmt::format("{}: found {} before byte {} of the file, expected a gzip stream", file_.path(),
                                   stream_.msg != nullptr ? stream_.msg : "damaged data",
                                   file_.size() - file_.remaining() - stream_.avail_in));
    }
  }
  return wanted - stream_.avail_out;
}

}  // namespace quincunx
