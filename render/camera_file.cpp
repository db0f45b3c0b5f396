#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "lattice/error.h"
#include "render/camera.h"

namespace quincunx {
namespace {

using Json = nlohmann::json;

std::string read_text(const std::string& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw InputError(fmt::format("{}: {}; expected a camera file (JSON)", path,
                                 std::filesystem::is_directory(status) ? "a folder" : "a special file"));
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(fmt::format("{}: cannot be opened; expected a camera file (JSON)", path));
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (file.bad()) throw InputError(fmt::format("{}: cannot be read; expected a camera file (JSON)", path));
  return text;
}

/// The file as JSON in which no object has a key twice.
Json parse(const std::string& path) {
  std::vector<std::set<std::string>> keys;
  const auto watch = [&](int, Json::parse_event_t event, Json& value) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second)
      throw InputError(fmt::format("{}: key {} stands twice; expected it once", path, value.dump()));
    return true;
  };
  try {
    return Json::parse(read_text(path), watch);
  } catch (const Json::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 1 ...": the part in brackets tells a user nothing.
    const std::string message = error.what();
    const std::size_t end = message.find("] ");
    throw InputError(fmt::format("{}: not JSON: {}", path, end == std::string::npos ? message : message.substr(end + 2)));
  }
}

double number(const Json& value, const std::string& path, const std::string& key) {
  if (!value.is_number() || !std::isfinite(value.get<double>()))
    throw InputError(fmt::format("{}: \"{}\" holds {}; expected a finite number", path, key, value.dump()));
  return value.get<double>();
}

glm::dvec3 vector(const Json& value, const std::string& path, const std::string& key) {
  if (!value.is_array() || value.size() != 3)
    throw InputError(fmt::format("{}: \"{}\" is {}; expected [x, y, z]", path, key, value.dump()));
  return {number(value[0], path, key), number(value[1], path, key), number(value[2], path, key)};
}

}  // namespace

Camera read_camera(const std::string& path) {
  const Json json = parse(path);
  if (!json.is_object())
    throw InputError(fmt::format("{}: a JSON {}; expected an object with eye, target, up, fov", path, json.type_name()));
  Camera camera;
  for (const auto& [key, value] : json.items()) {
    if (key == "eye") {
      camera.eye = vector(value, path, key);
    } else if (key == "target") {
      camera.target = vector(value, path, key);
    } else if (key == "up") {
      camera.up = vector(value, path, key);
    } else if (key == "fov") {
      camera.fov = number(value, path, key);
    } else {
      throw InputError(fmt::format("{}: unknown key {}; expected eye, target, up, fov", path, Json(key).dump()));
    }
  }
  for (const char* key : {"eye", "target"})
    if (!json.contains(key)) throw InputError(fmt::format("{}: key \"{}\" is missing; expected [x, y, z]", path, key));
  camera_frame(camera, 1, 1, path);
  return camera;
}

}  // namespace quincunx
