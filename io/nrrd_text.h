// The text of an NRRD header: which fields and key/value pairs it has. What they mean is nrrd_header.h's.
//
// Format: http://teem.sourceforge.net/nrrd/format.html, NRRD0001 to NRRD0005.
//
// Why not Teem's own reader (1.12): it allocates and clears what the sizes say before it looks at the file's length (4
// GB for a file of 60 bytes), accepts data that go on after the last sample and gzip streams cut off inside their
// checksum, wraps ascii samples that do not fit their type, prints warnings on stderr, and overflows a buffer and
// aborts on a header line of some megabytes.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/input_file.h"

namespace quincunx {

/// The lines of a header, their syntax checked.
struct NrrdText {
  static constexpr std::size_t max_bytes = 1 << 20;  ///< of a header: anything longer is refused

  std::string path;                                        ///< for messages
  std::map<std::string, std::string> fields;               ///< by canonical name ("byte skip", not "byteskip"); trimmed
  std::vector<std::pair<std::string, std::string>> pairs;  ///< key/value, escapes undone, in file order
  std::size_t data_offset = 0;                             ///< first byte after the empty line
  bool ended = false;                                      ///< by an empty line, not by the file's end

  /// The value of a field; throws InputError where it is missing.
  const std::string& required(const std::string& name) const;
  /// The value of a field or null.
  const std::string* optional(const std::string& name) const;
  /// Throws InputError "PATH: field 'name': found 'value', expected ...".
  [[noreturn]] void refuse(const std::string& name, std::string_view expected) const;
};

/// Parses the beginning of `bytes` up to the first empty line or the end; `path` is for messages. Throws InputError
/// unless it is a header: magic, known fields, none and no key twice, at most NrrdText::max_bytes.
NrrdText parse_nrrd_text(std::string_view bytes, const std::string& path);

/// Reads and parses the header at the beginning of `file`. The file's position is undefined afterwards.
NrrdText read_nrrd_text(InputFile& file);

/// A key or value as it stands in a header: newline and backslash escaped.
std::string escape_nrrd(std::string_view text);

/// `text` without white space at its ends, and in lower case.
std::string_view trimmed(std::string_view text);
std::string lower_case(std::string_view text);

}  // namespace quincunx
