#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "lattice/error.h"
#include "render/camera.h"
#include "render/json_file.h"

namespace quincunx {
namespace {

using Json = nlohmann::json;

double number(const Json& value, const std::string& path, const std::string& key) {
  if (!value.is_number() || !std::isfinite(value.get<double>()))
    throw InputError(fmt::format("{}: \"{}\" holds {}; expected a finite number", path, key, brief(value)));
  return value.get<double>();
}

glm::dvec3 vector(const Json& value, const std::string& path, const std::string& key) {
  if (!value.is_array() || value.size() != 3)
    throw InputError(fmt::format("{}: \"{}\" is {}; expected [x, y, z]", path, key, brief(value)));
  return {number(value[0], path, key), number(value[1], path, key), number(value[2], path, key)};
}

}  // namespace

Camera read_camera(const std::string& path) {
  const Json json = read_json(path, "a camera file");
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
      throw InputError(fmt::format("{}: unknown key {}; expected eye, target, up, fov", path, brief(key)));
    }
  }
  for (const char* key : {"eye", "target"})
    if (!json.contains(key)) throw InputError(fmt::format("{}: key \"{}\" is missing; expected [x, y, z]", path, key));
  camera_frame(camera, 1, 1, path);
  return camera;
}

}  // namespace quincunx
