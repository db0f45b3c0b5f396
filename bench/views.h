// The views that measurements are made from.
#pragma once

#include <vector>

#include "render/renderer.h"

namespace quincunx {

/// Where an orbit begins: as `quincunx render` looks at a volume.
inline constexpr Orbit kFirstView{30.0, 10.0, 1.0};

/// `count` requests, each `request` with a camera of an orbit: the volume framed as `quincunx render` does it, and from azimuths
/// that part the circle equally, beginning with `first`. Throws InputError where the scene is none (check_scene).
std::vector<Renderer::Request> orbit_views(const Renderer::Request& request, const Volume& volume, int count, const Orbit& first = kFirstView);

}  // namespace quincunx
