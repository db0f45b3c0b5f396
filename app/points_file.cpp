#include "app/points_file.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "app/values.h"
#include "lattice/error.h"
#include "lattice/quote.h"

namespace quincunx {
namespace {

constexpr std::size_t kLongestLine = 4096;  // bytes
constexpr std::string_view blanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

bool is_header(std::string_view line) {
  std::string letters;
  for (const char c : line) {
    if (blanks.find(c) == std::string_view::npos) letters += c;
  }
  return letters == "x,y,z" || letters == "X,Y,Z";
}

}  // namespace

PointsFile::PointsFile(const std::string& path) : path_(path) {
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
    line = trimmed(line);
    if (line.empty() || (number_ == 1 && is_header(line))) continue;
    return parse(line);
  }
  if (!file_.bad() && !file_.eof())
    throw InputError(fmt::format("{}:{}: found a line of more than {} bytes, expected three numbers x,y,z", path_, number_ + 1, kLongestLine));
  if (file_.bad()) throw InputError(fmt::format("{}: cannot be read after line {}", path_, number_));
  return std::nullopt;
}

glm::dvec3 PointsFile::parse(std::string_view line) const {
  const std::string place = fmt::format("{}:{}", path_, number_);
  const std::size_t first = line.find(','), second = line.find(',', first + 1);
  const bool three = first != std::string_view::npos && second != std::string_view::npos &&
                     line.find(',', second + 1) == std::string_view::npos;
  if (!three) {
    throw InputError(fmt::format("{}: found {}, expected three numbers x,y,z", place, in_quotes(line)));
  }
  return {parse_number(trimmed(line.substr(0, first)), place),
          parse_number(trimmed(line.substr(first + 1, second - first - 1)), place),
          parse_number(trimmed(line.substr(second + 1)), place)};
}

}  // namespace quincunx
