// Points in a CSV file, read one after another.
#pragma once

#include <cstdint>
#include <fstream>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace quincunx {

/// A CSV file of three finite numbers a line: x,y,z. The first line may be the header "x,y,z"; blanks around numbers,
/// blank lines and the line ends of Windows are allowed. Only one line is held at a time, of at most 4096 bytes.
class PointsFile {
 public:
  /// Throws InputError where the file cannot be opened or is no regular file (a pipe could not be read twice).
  explicit PointsFile(const std::string& path);

  /// The next point, or nothing at the end. Throws InputError naming file and line for any other line.
  std::optional<glm::dvec3> next();

 private:
  glm::dvec3 parse(std::string_view line) const;

  std::string path_;
  std::ifstream file_;
  std::uint64_t number_ = 0;  ///< of the line read last, from 1
};

}  // namespace quincunx
