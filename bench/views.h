// The views that measurements are made from.
#pragma once

#include <vector>

#include "render/renderer.h"

namespace quincunx {

/// `count` requests, each `request` with a camera of an orbit: the volume framed as `quincunx render` does it, and from azimuths
/// that part the circle equally. Throws InputError where the scene is none (check_scene).
std::vector<Renderer::Request> orbit_views(const Renderer::Request& request, const Volume& volume, int count);

}  // namespace quincunx
