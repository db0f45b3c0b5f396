#include "io/nrrd_header.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <filesystem>

#include "io/nrrd_numbers.h"
#include "io/nrrd_world.h"
#include "lattice/error.h"
#include "lattice/memory.h"

namespace quincunx {
namespace {

SampleType interpret_type(const NrrdText& text) {
  static const std::array<std::vector<std::string_view>, 4> spellings{{
      {"uint8", "uint8_t", "uchar", "unsigned char"},
      {"int16", "int16_t", "short", "short int", "signed short", "signed short int"},
      {"uint16", "uint16_t", "ushort", "unsigned short", "unsigned short int"},
      {"float"},
  }};
  const std::string name = lower_case(fmt::format("{}", fmt::join(split_words(text.required("type")), " ")));
  for (std::size_t type = 0; type < spellings.size(); ++type) {
    const auto& known = spellings[type];
    if (std::find(known.begin(), known.end(), name) != known.end()) return SampleType(type);
  }
  text.refuse("type", "uint8 (uchar), int16 (short), uint16 (ushort) or float");
}

NrrdEncoding interpret_encoding(const NrrdText& text) {
  const std::string name = lower_case(text.required("encoding"));
  if (name == "raw") return NrrdEncoding::raw;
  if (name == "gzip" || name == "gz") return NrrdEncoding::gzip;
  if (name == "ascii" || name == "text" || name == "txt") return NrrdEncoding::ascii;
  text.refuse("encoding", "raw, gzip (gz) or ascii (text, txt)");
}

bool interpret_endian(const NrrdText& text, const NrrdHeader& header) {
  const bool matters = sample_type_bytes(header.type) > 1 && header.encoding != NrrdEncoding::ascii;
  if (!matters && text.optional("endian") == nullptr) return false;
  const std::string name = lower_case(text.required("endian"));
  if (name != "little" && name != "big") text.refuse("endian", "little or big");
  return matters && (name == "little") != (std::endian::native == std::endian::little);
}

std::vector<std::int64_t> interpret_sizes(const NrrdText& text) {
  const auto dimension = parse_number<int>(text.required("dimension"));
  if (!dimension || (*dimension != 3 && *dimension != 4)) {
    text.refuse("dimension", "3, or 4 for a BCC volume");
  }
  const std::vector<std::string_view> words = split_words(text.required("sizes"));
  std::vector<std::int64_t> sizes;
  for (const std::string_view word : words) {
    const auto size = parse_number<std::int64_t>(word);
    if (size && *size >= 1) sizes.push_back(*size);
  }
  if (sizes.size() != words.size() || sizes.size() != std::size_t(*dimension)) {
    text.refuse("sizes", fmt::format("{} whole numbers, each at least 1", *dimension));
  }
  return sizes;
}

/// The lattice that the key `lattice` names; the sizes have the shape it wants.
LatticeKind interpret_lattice(const NrrdText& text, const std::vector<std::int64_t>& sizes) {
  const auto pair =
      std::find_if(text.pairs.begin(), text.pairs.end(), [](const auto& p) { return p.first == "lattice"; });
  const bool given = pair != text.pairs.end();
  LatticeKind lattice = LatticeKind::cartesian;
  if (given) lattice = parse_lattice(trimmed(pair->second), fmt::format("{}: key 'lattice'", text.path));
  if (lattice == LatticeKind::bcc && (sizes.size() != 4 || sizes[3] != 2)) {
    text.refuse("sizes", "nx ny nz 2, the two cosets slowest, because the file says lattice:=bcc");
  }
  if (lattice == LatticeKind::cartesian && sizes.size() != 3) {
    text.refuse("sizes", given ? "nx ny nz, because the file says lattice:=cartesian"
                               : "nx ny nz, or nx ny nz 2 together with the line lattice:=bcc for a BCC volume");
  }
  return lattice;
}

/// Refuses axes that are no axes of space, such as the components of a vector.
void check_kinds(const NrrdText& text, std::size_t dimension) {
  if (text.optional("kinds") == nullptr) return;
  const std::vector<std::string_view> kinds = split_words(*text.optional("kinds"));
  bool usable = kinds.size() == dimension;
  for (std::size_t axis = 0; usable && axis < dimension; ++axis) {
    const std::string kind = lower_case(kinds[axis]);
    const bool unknown = kind == "???" || kind == "none";
    usable = unknown || (axis < 3 ? kind == "domain" || kind == "space" : kind == "list" || kind == "point");
  }
  if (!usable) text.refuse("kinds", dimension == 3 ? "domain domain domain" : "domain domain domain list");
}

std::string interpret_data_file(const NrrdText& text) {
  const std::string& name = text.required("data file");
  const std::vector<std::string_view> words = split_words(name);
  const bool list = !words.empty() && words[0] == "LIST";
  const bool pattern = words.size() >= 4 && words[0].find('%') != std::string_view::npos;
  // A name that holds a zero byte would open the file of a shorter name.
  const bool printable = std::none_of(name.begin(), name.end(), [](char c) { return (c >= 0 && c < ' ') || c == '\x7f'; });
  if (name.empty() || list || pattern || !printable) text.refuse("data file", "the name of one file, without control characters");
  return (std::filesystem::path(text.path).parent_path() / name).string();
}

void interpret_place(const NrrdText& text, NrrdHeader& header) {
  if (text.optional("data file") != nullptr) {
    header.data_file = interpret_data_file(text);
  } else if (!text.ended) {
    throw InputError(
        fmt::format("{}: the file ends inside the header, expected an empty line and the samples, or a field "
                    "'data file'",
                    text.path));
  }
  header.data_offset = text.data_offset;
  const auto skip = [&](const std::string& name, std::int64_t least, std::string_view expected) {
    if (text.optional(name) == nullptr) return std::int64_t(0);
    const auto number = parse_number<std::int64_t>(*text.optional(name));
    if (!number || *number < least) text.refuse(name, expected);
    return *number;
  };
  header.line_skip = skip("line skip", 0, "a whole number, at least 0");
  const bool raw = header.encoding == NrrdEncoding::raw;
  header.byte_skip =
      skip("byte skip", raw ? -1 : 0, raw ? "a whole number, at least -1" : "a whole number, at least 0");
}

std::string format_vector(const glm::dvec3& v) { return fmt::format("({},{},{})", v.x, v.y, v.z); }

/// A note as a line of the header: the field it came from, or a key/value pair.
std::string format_note(const std::string& key, const std::string& value) {
  const bool one_line = !value.empty() && value == trimmed(value) && value.find('\n') == std::string::npos;
  const bool field = (key == "content" && one_line) || (key == "space" && is_space_name(value));
  return field ? fmt::format("{}: {}\n", key, value) : fmt::format("{}:={}\n", escape_nrrd(key), escape_nrrd(value));
}

}  // namespace

Volume volume_of(const NrrdHeader& header) {
  Volume volume{header.lattice, header.extents, header.world, {}, header.notes};
  switch (header.type) {
    case SampleType::uint8: volume.samples = std::vector<std::uint8_t>(); break;
    case SampleType::int16: volume.samples = std::vector<std::int16_t>(); break;
    case SampleType::uint16: volume.samples = std::vector<std::uint16_t>(); break;
    case SampleType::float32: volume.samples = std::vector<float>(); break;
  }
  return volume;
}

NrrdHeader interpret_nrrd(const NrrdText& text) {
  NrrdHeader header;
  header.type = interpret_type(text);
  header.encoding = interpret_encoding(text);
  header.swap_bytes = interpret_endian(text, header);

  const std::vector<std::int64_t> sizes = interpret_sizes(text);
  header.lattice = interpret_lattice(text, sizes);
  header.extents = {sizes[0], sizes[1], sizes[2]};
  header.sample_count =
      checked_sample_count(header.lattice, header.extents, header.type, fmt::format("{}: field 'sizes'", text.path));
  check_kinds(text, sizes.size());
  header.world = interpret_world(text, header.lattice, int(sizes.size()));
  interpret_place(text, header);

  for (const char* field : {"content", "space"}) {
    if (text.optional(field) != nullptr) header.notes.emplace_back(field, *text.optional(field));
  }
  for (const auto& pair : text.pairs) {
    if (pair.first != "lattice") header.notes.push_back(pair);
  }
  return header;
}

std::string format_nrrd(const Volume& volume, std::string_view encoding, const std::string& path) {
  check_volume(volume, path);
  check_world(volume.world, path);
  constexpr std::array<std::string_view, 4> types{"uint8", "int16", "uint16", "float"};
  const bool bcc = volume.lattice == LatticeKind::bcc;
  const glm::dmat3 steps = double(lattice_step(volume.lattice)) * volume.world.axes;
  const Extents& n = volume.extents;
  std::string fields, pairs;
  for (const auto& [key, value] : volume.notes) {
    const std::string line = format_note(key, value);
    (line.starts_with(key + ": ") ? fields : pairs) += line;
  }
  const bool named_space = fields.find("space: ") != std::string::npos;

  std::string text = "NRRD0004\n" + fields;
  text += fmt::format("type: {}\ndimension: {}\n", types[std::size_t(volume.type())], bcc ? 4 : 3);
  if (!named_space) text += "space dimension: 3\n";
  text += fmt::format("sizes: {} {} {}{}\n", n.x, n.y, n.z, bcc ? " 2" : "");
  text += fmt::format("space directions: {} {} {}{}\n", format_vector(steps[0]), format_vector(steps[1]),
                      format_vector(steps[2]), bcc ? " none" : "");
  text += fmt::format("kinds: domain domain domain{}\nendian: little\n", bcc ? " list" : "");
  text += fmt::format("encoding: {}\nspace origin: {}\n", encoding, format_vector(volume.world.origin));
  text += fmt::format("lattice:={}\n{}\n", lattice_name(volume.lattice), pairs);

  // Whatever was in the volume must come out again; notes are the part that a format of lines may not hold.
  const NrrdHeader again = interpret_nrrd(parse_nrrd_text(text, path));
  auto expected = volume.notes;
  auto found = again.notes;
  std::sort(expected.begin(), expected.end());
  std::sort(found.begin(), found.end());
  if (found != expected || again.data_offset != text.size() || again.world.axes != volume.world.axes) {
    throw InputError(
        fmt::format("{}: the volume's notes do not fit an NRRD header, expected one-line keys without ':='", path));
  }
  return text;
}

}  // namespace quincunx
