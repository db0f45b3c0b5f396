#include "bench/views.h"

namespace quincunx {
namespace {

constexpr Orbit kFirstView{30.0, 10.0, 1.0};  // that of `quincunx render`

}  // namespace

std::vector<Renderer::Request> orbit_views(const Renderer::Request& request, const Volume& volume, int count) {
  std::vector<Renderer::Request> views;
  for (int view = 0; view < count; ++view) {
    Orbit at = kFirstView;
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
