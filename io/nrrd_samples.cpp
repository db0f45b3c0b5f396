#include "io/nrrd_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <span>
#include <stdexcept>
#include <type_traits>

#include "io/gzip_reader.h"
#include "io/nrrd_numbers.h"
#include "lattice/error.h"
#include "lattice/memory.h"
#include "lattice/quote.h"

namespace quincunx {
namespace {

constexpr std::size_t block_bytes = 1 << 20;  ///< read, unpacked and reported at a time

/// The file holds `found` (a number with its unit) where the header says `expected` bytes.
[[noreturn]] void fail_length(const InputFile& file, const std::string& found, std::uint64_t expected) {
  throw InputError(fmt::format("{}: found {} of samples, expected {} bytes from the sizes and type in the header",
                               file.path(), found, expected));
}
[[noreturn]] void fail_length(const InputFile& file, std::uint64_t found, std::uint64_t expected) {
  fail_length(file, fmt::format("{} bytes", found), expected);
}

/// Moves past `lines` newlines.
void skip_lines(InputFile& file, std::int64_t lines) {
  std::string block(4096, '\0');
  while (lines > 0) {
    const std::uint64_t start = file.size() - file.remaining();
    const std::size_t got = file.read(block.data(), block.size());
    if (got == 0)
      throw InputError(fmt::format("{}: field 'line skip': {} lines more than the file has", file.path(), lines));
    for (std::size_t n = 0; n < got && lines > 0; ++n) {
      if (block[n] == '\n' && --lines == 0) file.seek(start + n + 1);
    }
  }
}

template <class T>
void swap_bytes(std::span<T> samples) {
  if constexpr (sizeof(T) == 2) {
    for (T& s : samples) s = std::bit_cast<T>(__builtin_bswap16(std::bit_cast<std::uint16_t>(s)));
  } else if constexpr (sizeof(T) == 4) {
    // Through memory, not through a float register: the bits may be those of a signalling NaN.
    for (T& s : samples) {
      std::uint32_t bits;
      std::memcpy(&bits, &s, sizeof bits);
      bits = __builtin_bswap32(bits);
      std::memcpy(&s, &bits, sizeof bits);
    }
  }
}

/// Where samples go, block by block: into a vector that grows with what is there.
template <class T>
struct Collector {
  const NrrdHeader& header;
  std::vector<T> samples{};

  /// Room for the next `count` samples, which keep() takes as they are then.
  std::span<T> room(std::size_t count) {
    if (samples.empty()) samples.reserve(std::size_t(header.sample_count));
    samples.resize(samples.size() + count);
    return std::span(samples).last(count);
  }
  void keep(std::span<T>) {}
};

/// Or from one block of memory to somebody else.
template <class T>
struct Forwarder {
  const SampleSink& sink;
  std::vector<T> block{};

  std::span<T> room(std::size_t count) {
    block.resize(count);
    return block;
  }
  void keep(std::span<T> samples) { sink(std::as_bytes(samples)); }
};

/// How many samples follow number `begin` in the next block.
template <class T>
std::size_t block_count(const NrrdHeader& header, std::uint64_t begin) {
  return std::size_t(std::min<std::uint64_t>(block_bytes / sizeof(T), header.sample_count - begin));
}

/// Hands the samples on block by block: `source(to, bytes)` gives the next bytes of the file, fewer at its end.
template <class T, class Source, class Sink>
void read_blocks(const InputFile& file, const NrrdHeader& header, Source source, Sink& sink, const Progress& progress) {
  for (std::uint64_t begin = 0; begin < header.sample_count;) {
    report(progress, double(begin) / double(header.sample_count));
    const std::span<T> block = sink.room(block_count<T>(header, begin));
    const std::size_t got = source(block.data(), block.size_bytes());
    if (got < block.size_bytes()) fail_length(file, begin * sizeof(T) + got, header.sample_count * sizeof(T));
    if (header.swap_bytes) swap_bytes(block);
    sink.keep(block);
    begin += block.size();
  }
}

/// Where raw samples begin in `file`, whose position is before what is to be skipped: it holds just as many bytes.
std::uint64_t raw_begin(const InputFile& file, const NrrdHeader& header) {
  const std::uint64_t expected = header.sample_count * sample_type_bytes(header.type);
  const std::uint64_t present = file.remaining();
  if (header.byte_skip >= 0 && present < std::uint64_t(header.byte_skip)) {
    throw InputError(fmt::format("{}: field 'byte skip': found {}, expected at most the {} bytes that there are",
                                 file.path(), header.byte_skip, present));
  }
  const std::uint64_t found =
      header.byte_skip >= 0 ? present - std::uint64_t(header.byte_skip) : std::min(present, expected);
  if (found != expected) fail_length(file, found, expected);
  return file.size() - expected;
}

template <class T, class Sink>
void read_raw(InputFile& file, const NrrdHeader& header, Sink& sink, const Progress& progress) {
  file.seek(raw_begin(file, header));
  read_blocks<T>(
      file, header, [&](void* to, std::size_t bytes) { return file.read(to, bytes); }, sink, progress);
}

/// Reads and forgets `bytes` of the unpacked stream.
void skip_unpacked(GzipReader& reader, const InputFile& file, std::uint64_t bytes) {
  std::vector<char> block(block_bytes);
  for (std::uint64_t left = bytes; left > 0;) {
    const std::size_t got = reader.read(block.data(), std::size_t(std::min<std::uint64_t>(left, block.size())));
    if (got == 0) {
      throw InputError(fmt::format("{}: field 'byte skip': found {}, expected at most the {} bytes that there are",
                                   file.path(), bytes, bytes - left));
    }
    left -= got;
  }
}

template <class T, class Sink>
void read_gzip(InputFile& file, const NrrdHeader& header, Sink& sink, const Progress& progress) {
  const std::uint64_t expected = header.sample_count * sizeof(T);
  const std::uint64_t most = GzipReader::max_unpacked(file.remaining());
  if (expected > most) fail_length(file, fmt::format("a gzip stream of at most {} bytes", most), expected);

  GzipReader reader(file);
  skip_unpacked(reader, file, std::uint64_t(header.byte_skip));
  read_blocks<T>(
      file, header, [&](void* to, std::size_t bytes) { return reader.read(to, bytes); }, sink, progress);
  // One more read: it finds the end, verifies the checksum, and must find nothing.
  char beyond;
  if (reader.read(&beyond, 1) != 0) fail_length(file, fmt::format("more than {} bytes", expected), expected);
}

/// The sample that `word` writes; nothing where it is none of type T.
template <class T>
std::optional<T> parse_sample(std::string_view word) {
  if (const auto sample = parse_number<T>(word)) return sample;
  if constexpr (std::is_floating_point_v<T>) {
    // A number too small for a float is 0 or the smallest; one too large is an error.
    const auto number = parse_number<double>(word);
    if (number && std::abs(*number) < 1.0) return T(*number);
  }
  return {};
}

/// Cuts a stream of text into words; commas separate as white space does.
class WordReader {
 public:
  explicit WordReader(InputFile& file) : file_(file) {}

  /// The next word, empty at the end; valid until the next call.
  std::string_view next() {
    constexpr std::string_view separators = " \t\r\n\v\f,";
    for (;;) {
      const std::size_t begin = std::min(text_.find_first_not_of(separators, position_), text_.size());
      const std::size_t end = std::min(text_.find_first_of(separators, begin), text_.size());
      const bool cut = end == text_.size() && file_.remaining() > 0;
      if (!cut || end - begin > longest) {
        position_ = end;
        return std::string_view(text_).substr(begin, end - begin);
      }
      // The word may go on in the next block.
      text_.erase(0, begin);
      position_ = 0;
      const std::size_t kept = text_.size();
      text_.resize(kept + block_bytes);
      text_.resize(kept + file_.read(text_.data() + kept, block_bytes));
    }
  }

 private:
  static constexpr std::size_t longest = 4096;  ///< no number is longer
  InputFile& file_;
  std::string text_;
  std::size_t position_ = 0;
};

template <class T, class Sink>
void read_ascii(InputFile& file, const NrrdHeader& header, Sink& sink, const Progress& progress) {
  if (std::uint64_t(header.byte_skip) > file.remaining()) {
    throw InputError(fmt::format("{}: field 'byte skip': found {}, expected at most the {} bytes that there are",
                                 file.path(), header.byte_skip, file.remaining()));
  }
  file.seek(file.size() - file.remaining() + std::uint64_t(header.byte_skip));
  const std::uint64_t most = (file.remaining() + 1) / 2;  // a digit and a space each
  const auto fail_count = [&](const std::string& found) {
    throw InputError(fmt::format("{}: found {}, expected {} numbers from the sizes in the header", file.path(), found,
                                 header.sample_count));
  };
  if (header.sample_count > most) fail_count(fmt::format("at most {} numbers", most));

  WordReader words(file);
  for (std::uint64_t number = 0; number < header.sample_count;) {
    report(progress, double(number) / double(header.sample_count));
    const std::span<T> block = sink.room(block_count<T>(header, number));
    for (T& to : block) {
      const std::string_view word = words.next();
      if (word.empty()) fail_count(fmt::format("{} numbers", number));
      const std::optional<T> sample = parse_sample<T>(word);
      if (!sample) {
        throw InputError(fmt::format("{}: sample {} is {}, expected a number of type {}", file.path(), number,
                                     in_quotes(word), sample_type_name(header.type)));
      }
      to = *sample;
      ++number;
    }
    sink.keep(block);
  }
  if (!words.next().empty()) fail_count("more numbers");
}

template <class T, class Sink>
void read_type(InputFile& file, const NrrdHeader& header, Sink& sink, const Progress& progress) {
  switch (header.encoding) {
    case NrrdEncoding::raw:
      return read_raw<T>(file, header, sink, progress);
    case NrrdEncoding::gzip:
      return read_gzip<T>(file, header, sink, progress);
    case NrrdEncoding::ascii:
      break;
  }
  read_ascii<T>(file, header, sink, progress);
}

/// Calls `read` with a null pointer of the samples' type.
template <class Read>
auto with_type(SampleType type, Read read) {
  switch (type) {
    case SampleType::uint8:
      return read(static_cast<std::uint8_t*>(nullptr));
    case SampleType::int16:
      return read(static_cast<std::int16_t*>(nullptr));
    case SampleType::uint16:
      return read(static_cast<std::uint16_t*>(nullptr));
    case SampleType::float32:
      break;
  }
  return read(static_cast<float*>(nullptr));
}

/// Moves to the header's data in `file`, behind the lines to be skipped.
void seek_data(InputFile& file, const NrrdHeader& header) {
  file.seek(header.data_file.empty() ? header.data_offset : 0);
  skip_lines(file, header.line_skip);
}

}  // namespace

Volume::Samples read_nrrd_samples(InputFile& file, const NrrdHeader& header, const Progress& progress) {
  seek_data(file, header);
  try {
    return with_type(header.type, [&]<class T>(T*) {
      Collector<T> collector{header};
      read_type<T>(file, header, collector, progress);
      report(progress, 1.0);
      return Volume::Samples(std::move(collector.samples));
    });
  } catch (const std::bad_alloc&) {
    const std::uint64_t bytes = header.sample_count * sample_type_bytes(header.type);
    throw InputError(fmt::format("{}: not enough memory for {} bytes of samples", file.path(), bytes));
  }
}

void unpack_nrrd_samples(InputFile& file, const NrrdHeader& header, const SampleSink& sink, const Progress& progress) {
  seek_data(file, header);
  with_type(header.type, [&]<class T>(T*) {
    Forwarder<T> forwarder{sink};
    read_type<T>(file, header, forwarder, progress);
  });
  report(progress, 1.0);
}

std::uint64_t raw_nrrd_begin(InputFile& file, const NrrdHeader& header) {
  seek_data(file, header);
  return raw_begin(file, header);
}

void swap_sample_bytes(Volume::Samples& samples) {
  std::visit([](auto& s) { swap_bytes(std::span(s)); }, samples);
}

}  // namespace quincunx
