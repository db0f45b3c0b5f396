// What each ray cost, as a heat picture (`quincunx render --heat`).
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "io/heat_image.h"
#include "render/renderer.h"

namespace quincunx {

/// What a heat picture shows of each ray. The first three are the cost channels; depth is the depth complexity of the
/// skipping structure: the intervals (leaves of a tree) that the whole ray meets, over the numbers of blocks along the three
/// axes together (D. Ganter, M. Manzke, "An analysis of region clustered BVH volume rendering on GPU", Computer Graphics Forum
/// 38(8), 2019, doi:10.1111/cgf.13756).
enum class HeatKind { none, evaluations, steps, intervals, depth };

/// The kinds by their names on the command line; without none.
const std::vector<std::pair<std::string, HeatKind>>& heat_kinds();

/// Throws InputError naming --heat where there is nothing of this kind to count: `scene` evaluates nothing, or `structure` (a
/// name of --skip) has no intervals.
void check_heat(HeatKind kind, const Scene& scene, const std::string& structure);

/// The map of a frame with cost channels, and `stats` of the same call; `kind` is not none. The title says what the
/// numbers are, their mean and their maximum.
HeatMap make_heat(HeatKind kind, const Frame& frame, const Scene& scene, const RenderStats& stats);

/// kind, max, mean, p99 of the map.
nlohmann::ordered_json heat_json(HeatKind kind, const HeatMap& map);

}  // namespace quincunx
