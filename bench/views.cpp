#include "bench/views.h"

namespace quincunx {

std::vector<Renderer::Request> orbit_views(const Renderer::Request& request, const Volume& volume, int count, const Orbit& first) {
  std::vector<Renderer::Request> views;
  for (int view = 0; view < count; ++view) {
    Orbit at = first;
    at.azimuth += 360.0 * view / count;
    Renderer::Request seen = request;
    Scene& scene = seen.scene;
    scene.camera = framing_camera(volume.lattice, volume.extents, volume.world, at, scene.width, scene.height);
    check_scene(scene);
    views.push_back(std::move(seen));
  }
  return views;
}

}  // namespace quincunx
