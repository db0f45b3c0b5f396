// Points in a CSV file, read one after another.
#pragma once

#include <cstdint>
#include <fstream>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace quincunx {

/// A CSV file of three finite numbers a line: x,y,z. The first line may be the header "x,y,z"; blanks around numbers,
/// blank lines and the line ends of Windows are allowed. Only one line is held at a time, of at most 4096 bytes.
/// Where the reader knows more columns, the header may name some of them behind x,y,z, in any order: each line has their numbers too.
class PointsFile {
 public:
  /// `known`: the names of further columns, lower case. Throws InputError where the file cannot be opened or is no regular file (a pipe could not be read twice).
  explicit PointsFile(const std::string& path, std::vector<std::string> known = {});

  /// The next point, or nothing at the end. Throws InputError naming file and line for any other line.
  std::optional<glm::dvec3> next();

  /// What the point read last has in the column known[n]; nothing where the file has no such column.
  std::optional<double> column(std::size_t n) const { return values_[n]; }

 private:
  /// Whether the line is a header; notes the columns that it names.
  bool read_header(std::string_view line);
  /// "three numbers x,y,z".
  std::string expected() const;
  glm::dvec3 parse(std::string_view line);

  std::string path_;
  std::vector<std::string> known_;
  std::vector<std::size_t> columns_;             ///< of `known`, as they stand behind z
  std::vector<std::optional<double>> values_;    ///< by known
  std::ifstream file_;
  std::uint64_t number_ = 0;  ///< of the line read last, from 1
};

}  // namespace quincunx
