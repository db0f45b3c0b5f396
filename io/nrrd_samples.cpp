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

/// Appends the samples block by block: `source(to, bytes)` gives the next bytes of the file, fewer at its end.
template <class T, class Source>
std::vector<T> read_blocks(const InputFile& file, const NrrdHeader& header, Source source, const Progress& progress) {
  std::vector<T> samples;
  samples.reserve(std::size_t(header.sample_count));
  while (samples.size() < header.sample_count) {
    report(progress, double(samples.size()) / double(header.sample_count));
    const std::size_t begin = samples.size();
    const std::size_t count =
        std::size_t(std::min<std::uint64_t>(block_bytes / sizeof(T), header.sample_count - begin));
    samples.resize(begin + count);
    const std::size_t got = source(samples.data() + begin, count * sizeof(T));
    if (got < count * sizeof(T)) fail_length(file, begin * sizeof(T) + got, header.sample_count * sizeof(T));
    if (header.swap_bytes) swap_bytes(std::span<T>(samples).subspan(begin));
  }
  return samples;
}

template <class T>
std::vector<T> read_raw(InputFile& file, const NrrdHeader& header, const Progress& progress) {
  const std::uint64_t expected = header.sample_count * sizeof(T);
  const std::uint64_t present = file.remaining();
  if (header.byte_skip >= 0 && present < std::uint64_t(header.byte_skip)) {
    throw InputError(fmt::format("{}: field 'byte skip': found {}, expected at most the {} bytes that there are",
                                 file.path(), header.byte_skip, present));
  }
  const std::uint64_t found =
      header.byte_skip >= 0 ? present - std::uint64_t(header.byte_skip) : std::min(present, expected);
  if (found != expected) fail_length(file, found, expected);
  file.seek(file.size() - expected);
  return read_blocks<T>(
      file, header, [&](void* to, std::size_t bytes) { return file.read(to, bytes); }, progress);
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

template <class T>
std::vector<T> read_gzip(InputFile& file, const NrrdHeader& header, const Progress& progress) {
  const std::uint64_t expected = header.sample_count * sizeof(T);
  const std::uint64_t most = GzipReader::max_unpacked(file.remaining());
  if (expected > most) fail_length(file, fmt::format("a gzip stream of at most {} bytes", most), expected);

  GzipReader reader(file);
  skip_unpacked(reader, file, std::uint64_t(header.byte_skip));
  std::vector<T> samples = read_blocks<T>(
      file, header, [&](void* to, std::size_t bytes) { return reader.read(to, bytes); }, progress);
  // One more read: it finds the end, verifies the checksum, and must find nothing.
  char beyond;
  if (reader.read(&beyond, 1) != 0) fail_length(file, fmt::format("more than {} bytes", expected), expected);
  return samples;
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

template <class T>
std::vector<T> read_ascii(InputFile& file, const NrrdHeader& header, const Progress& progress) {
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
  std::vector<T> samples;
  samples.reserve(std::size_t(header.sample_count));
  while (samples.size() < header.sample_count) {
    if (samples.size() % (1 << 16) == 0) report(progress, double(samples.size()) / double(header.sample_count));
    const std::string_view word = words.next();
    if (word.empty()) fail_count(fmt::format("{} numbers", samples.size()));
    const std::optional<T> sample = parse_sample<T>(word);
    if (!sample) {
      throw InputError(fmt::format("{}: sample {} is {}, expected a number of type {}", file.path(), samples.size(),
                                   quoted(word), sample_type_name(header.type)));
    }
    samples.push_back(*sample);
  }
  if (!words.next().empty()) fail_count("more numbers");
  return samples;
}

template <class T>
std::vector<T> read_type(InputFile& file, const NrrdHeader& header, const Progress& progress) {
  switch (header.encoding) {
    case NrrdEncoding::raw:
      return read_raw<T>(file, header, progress);
    case NrrdEncoding::gzip:
      return read_gzip<T>(file, header, progress);
    case NrrdEncoding::ascii:
      break;
  }
  return read_ascii<T>(file, header, progress);
}

Volume::Samples read_any(InputFile& file, const NrrdHeader& header, const Progress& progress) {
  switch (header.type) {
    case SampleType::uint8:
      return read_type<std::uint8_t>(file, header, progress);
    case SampleType::int16:
      return read_type<std::int16_t>(file, header, progress);
    case SampleType::uint16:
      return read_type<std::uint16_t>(file, header, progress);
    case SampleType::float32:
      break;
  }
  return read_type<float>(file, header, progress);
}

}  // namespace

Volume::Samples read_nrrd_samples(InputFile& file, const NrrdHeader& header, const Progress& progress) {
  file.seek(header.data_file.empty() ? header.data_offset : 0);
  skip_lines(file, header.line_skip);
  try {
    Volume::Samples samples = read_any(file, header, progress);
    report(progress, 1.0);
    return samples;
  } catch (const std::bad_alloc&) {
    const std::uint64_t bytes = header.sample_count * sample_type_bytes(header.type);
    throw InputError(fmt::format("{}: not enough memory for {} bytes of samples", file.path(), bytes));
  }
}

}  // namespace quincunx
