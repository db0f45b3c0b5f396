#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

namespace quincunx {

/// [x, y, z].
inline nlohmann::ordered_json vector_json(const glm::dvec3& v) { return nlohmann::ordered_json::array({v.x, v.y, v.z}); }

}  // namespace quincunx
