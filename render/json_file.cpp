#include "render/json_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <vector>

#include "lattice/error.h"

namespace quincunx {
namespace {

using Json = nlohmann::json;

constexpr std::uintmax_t kMostBytes = std::uintmax_t(64) << 20;
constexpr std::size_t kMostValues = std::size_t(1) << 20;
constexpr int kMostLevels = 16;
constexpr std::size_t kMessage = 200;  // characters of a parser's message, which quotes what it read

std::string read_text(const std::string& path, std::string_view expected) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw InputError(fmt::format("{}: {}; expected {} (JSON)", path,
                                 std::filesystem::is_directory(status) ? "a folder" : "a special file", expected));
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(fmt::format("{}: cannot be opened; expected {} (JSON)", path, expected));
  if (const std::uintmax_t bytes = std::filesystem::file_size(path, ignored); !ignored && bytes > kMostBytes)
    throw InputError(fmt::format("{}: {} bytes; expected {} of at most {}", path, bytes, expected, kMostBytes));
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (file.bad()) throw InputError(fmt::format("{}: cannot be read; expected {} (JSON)", path, expected));
  return text;
}

/// "[json.exception.parse_error.101] parse error at line 1 ...": without the part in brackets, which tells a user nothing.
std::string readable(const Json::exception& error) {
  const std::string message = error.what();
  const std::size_t end = message.find("] ");
  const std::string rest = end == std::string::npos ? message : message.substr(end + 2);
  return rest.size() > kMessage ? rest.substr(0, kMessage) + " ..." : rest;
}

}  // namespace

std::string brief(const Json& json) {
  constexpr std::size_t kLength = 60;
  const std::string text = json.dump(-1, ' ', true);
  return text.size() > kLength ? text.substr(0, kLength) + " ..." : text;
}

Json read_json(const std::string& path, std::string_view expected) {
  std::vector<std::set<std::string>> keys;
  std::size_t values = 0;
  const auto watch = [&](int level, Json::parse_event_t event, Json& value) {
    using Event = Json::parse_event_t;
    if (level > kMostLevels) throw InputError(fmt::format("{}: lists in lists over {} levels; expected {}", path, kMostLevels, expected));
    if (++values > kMostValues) throw InputError(fmt::format("{}: more than {} values; expected {}", path, kMostValues, expected));
    if (event == Event::object_start) keys.emplace_back();
    if (event == Event::object_end) keys.pop_back();
    if (event == Event::key && !keys.back().insert(value.get<std::string>()).second)
      throw InputError(fmt::format("{}: key {} stands twice; expected it once", path, brief(value)));
    return true;
  };
  try {
    return Json::parse(read_text(path, expected), watch);
  } catch (const Json::parse_error& error) {
    throw InputError(fmt::format("{}: not JSON from byte {} on: {}", path, error.byte, readable(error)));
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("{}: not JSON: {}", path, readable(error)));
  }
}

}  // namespace quincunx
