#include "app/points_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "app/values.h"
#include "lattice/error.h"
#include "lattice/quote.h"

namespace quincunx {
namespace {

constexpr std::size_t kLongestLine = 4096;  // bytes
constexpr std::string_view blanks = " \t\r";

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

}  // namespace

PointsFile::PointsFile(const std::string& path, std::vector<std::string> known) : path_(path), known_(std::move(known)), values_(known_.size()) {
  // A pipe has nothing left when the points are read for the second time, and may keep its reader waiting.
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw InputError(fmt::format("{}: found {}, expected a regular file (CSV) of points", path,
                                 std::filesystem::is_directory(status) ? "a folder" : "a special file"));
  }
  file_.open(path);
  if (!file_) throw InputError(fmt::format("{}: cannot be opened: {}", path, std::strerror(errno)));
}

std::optional<glm::dvec3> PointsFile::next() {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  // A getline of bounded length: a file without line ends may be larger than memory.
  std::array<char, kLongestLine + 2> text;
  while (file_.getline(text.data(), text.size())) {
    ++number_;
    std::string_view line(text.data(), std::size_t(file_.gcount()) - (file_.eof() ? 0 : 1));
    if (number_ == 1 && line.starts_with(byte_order_mark)) line.remove_prefix(byte_order_mark.size());
    line = without_blanks(line);
    if (line.empty() || (number_ == 1 && read_header(line))) continue;
    return parse(line);
  }
  if (!file_.bad() && !file_.eof())
    throw InputError(fmt::format("{}:{}: found a line of more than {} bytes, expected {}", path_, number_ + 1, kLongestLine, expected()));
  if (file_.bad()) throw InputError(fmt::format("{}: cannot be read after line {}", path_, number_));
  return std::nullopt;
}

bool PointsFile::read_header(std::string_view line) {
  std::string letters;
  for (const char c : line) {
    if (blanks.find(c) == std::string_view::npos) letters += c;
  }
  const std::vector<std::string_view> names = split_list(letters);
  const auto are = [&](std::string_view x, std::string_view y, std::string_view z) { return names.size() >= 3 && names[0] == x && names[1] == y && names[2] == z; };
  if (!are("x", "y", "z") && !are("X", "Y", "Z")) return false;
  std::vector<std::size_t> columns;
  for (std::size_t n = 3; n < names.size(); ++n) {
    const auto found = std::find(known_.begin(), known_.end(), names[n]);
    const auto number = std::size_t(found - known_.begin());
    if (found == known_.end() || std::find(columns.begin(), columns.end(), number) != columns.end()) return false;
    columns.push_back(number);
  }
  columns_ = std::move(columns);
  return true;
}

std::string PointsFile::expected() const {
  constexpr std::array<std::string_view, 3> counts{"three", "four", "five"};
  std::string names = "x,y,z";
  for (const std::size_t n : columns_) names += "," + known_[n];
  return fmt::format("{} numbers {}", columns_.size() < counts.size() ? counts[columns_.size()] : "some", names);
}

glm::dvec3 PointsFile::parse(std::string_view line) {
  const std::string place = fmt::format("{}:{}", path_, number_);
  const std::vector<std::string_view> fields = split_list(line);
  if (fields.size() != 3 + columns_.size()) throw InputError(fmt::format("{}: found {}, expected {}", place, in_quotes(line), expected()));
  for (std::size_t n = 0; n < columns_.size(); ++n) values_[columns_[n]] = parse_number(without_blanks(fields[3 + n]), place);
  return {parse_number(without_blanks(fields[0]), place), parse_number(without_blanks(fields[1]), place), parse_number(without_blanks(fields[2]), place)};
}

}  // namespace quincunx
