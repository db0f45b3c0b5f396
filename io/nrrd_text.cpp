#include "io/nrrd_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "lattice/error.h"
#include "lattice/quote.h"

namespace quincunx {
namespace {

/// Every field of the format: the name used here, then how else it may be spelt.
constexpr std::array<std::array<std::string_view, 2>, 30> field_spellings{{
    {"dimension"},
    {"type"},
    {"sizes"},
    {"encoding"},
    {"endian"},
    {"content"},
    {"number"},
    {"block size", "blocksize"},
    {"min"},
    {"max"},
    {"old min", "oldmin"},
    {"old max", "oldmax"},
    {"data file", "datafile"},
    {"line skip", "lineskip"},
    {"byte skip", "byteskip"},
    {"sample units", "sampleunits"},
    {"spacings"},
    {"thicknesses"},
    {"axis mins", "axismins"},
    {"axis maxs", "axismaxs"},
    {"centerings", "centers"},
    {"labels"},
    {"units"},
    {"kinds"},
    {"space"},
    {"space dimension", "spacedimension"},
    {"space units", "spaceunits"},
    {"space origin", "spaceorigin"},
    {"space directions", "spacedirections"},
    {"measurement frame", "measurementframe"},
}};

/// The name used here for the field spelt `text`, or nothing where there is no such field.
std::string_view canonical_field(std::string_view text) {
  const std::string name = lower_case(text);
  for (const auto& spellings : field_spellings) {
    for (const std::string_view spelling : spellings) {
      if (!spelling.empty() && name == spelling) return spellings[0];
    }
  }
  return {};
}

std::string unescape(std::string_view text) {
  std::string plain;
  for (std::size_t n = 0; n < text.size(); ++n) {
    if (text[n] == '\\' && n + 1 < text.size() && (text[n + 1] == 'n' || text[n + 1] == '\\')) {
      plain += text[++n] == 'n' ? '\n' : '\\';
    } else {
      plain += text[n];
    }
  }
  return plain;
}

/// Adds one line that is neither empty nor a comment: "field: value" or "key:=value"; `keys` are those seen so far.
void add_line(NrrdText& text, std::set<std::string>& keys, std::string_view line, std::size_t line_number) {
  const auto refuse_line = [&](std::string_view what) {
    throw InputError(fmt::format("{}: header line {}: {}", text.path, line_number, what));
  };
  const std::size_t colon = std::min(line.find(':'), line.size());
  const std::string_view after = line.substr(std::min(colon + 1, line.size()));
  if (colon < line.size() && (after.empty() || after.front() == ' ' || after.front() == '\t')) {
    const std::string_view name = canonical_field(line.substr(0, colon));
    if (!name.empty()) {
      const bool added = text.fields.emplace(name, trimmed(line.substr(colon + 1))).second;
      if (!added) refuse_line(fmt::format("field '{}' for the second time, expected it once", name));
      return;
    }
  }
  const std::size_t assignment = line.find(":=");
  if (assignment == std::string_view::npos || assignment == 0) {
    refuse_line(fmt::format("found {}, expected 'field: value' with a field of the NRRD format, or 'key:=value'",
                            in_quotes(line)));
  }
  std::string key = unescape(line.substr(0, assignment));
  if (!keys.insert(key).second) {
    refuse_line(fmt::format("key {} for the second time, expected it once", in_quotes(key)));
  }
  text.pairs.emplace_back(std::move(key), unescape(line.substr(assignment + 2)));
}

void check_magic(std::string_view line, const std::string& path) {
  if (line.size() == 8 && line.substr(0, 7) == "NRRD000" && line[7] >= '1' && line[7] <= '5') return;
  throw InputError(fmt::format("{}: found {} at the beginning, expected NRRD0001 to NRRD0005", path, in_quotes(line)));
}

}  // namespace

const std::string& NrrdText::required(const std::string& name) const {
  const auto found = fields.find(name);
  if (found == fields.end()) throw InputError(fmt::format("{}: no field '{}', expected one", path, name));
  return found->second;
}

const std::string* NrrdText::optional(const std::string& name) const {
  const auto found = fields.find(name);
  return found == fields.end() ? nullptr : &found->second;
}

void NrrdText::refuse(const std::string& name, std::string_view expected) const {
  throw InputError(fmt::format("{}: field '{}': found {}, expected {}", path, name, in_quotes(required(name)), expected));
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view space = " \t\r\v\f\n";
  const std::size_t first = text.find_first_not_of(space);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(space) - first + 1);
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return lower;
}

std::string escape_nrrd(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\n') {
      escaped += "\\n";
    } else if (c == '\\') {
      escaped += "\\\\";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

NrrdText parse_nrrd_text(std::string_view bytes, const std::string& path) {
  NrrdText text;
  text.path = path;
  std::set<std::string> keys;
  std::size_t line_number = 0;
  while (!text.ended && text.data_offset < bytes.size()) {
    // Take the next line, which ends with a newline (or carriage return and newline) or with the bytes.
    const std::size_t newline = std::min(bytes.find('\n', text.data_offset), bytes.size());
    std::string_view line = bytes.substr(text.data_offset, newline - text.data_offset);
    text.data_offset = std::min(newline + 1, bytes.size());
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);

    if (++line_number == 1) {
      check_magic(line, path);
    } else if (text.data_offset > NrrdText::max_bytes) {
      throw InputError(
          fmt::format("{}: a header of more than {} bytes, expected an empty line before", path, NrrdText::max_bytes));
    } else if (line.empty()) {
      text.ended = true;
    } else if (line.front() != '#') {
      add_line(text, keys, line, line_number);
    }
  }
  if (line_number == 0) throw InputError(fmt::format("{}: the file is empty, expected an NRRD header", path));
  return text;
}

NrrdText read_nrrd_text(InputFile& file) {
  // One byte more than a header may have, so that a longer one is known as such.
  std::string bytes(std::size_t(std::min<std::uint64_t>(file.size(), NrrdText::max_bytes + 1)), '\0');
  file.seek(0);
  file.read(bytes.data(), bytes.size());
  return parse_nrrd_text(bytes, file.path());
}

}  // namespace quincunx
