#include "render/camera.h"

#include <cmath>

#include "tests/fuzz/expect.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/targets.h"

namespace quincunx::fuzz {

void feed_camera(std::string_view input) {
  static MemoryFile file(900);
  file.write(input);
  accepts(file.path(), [&] {
    const Camera camera = read_camera(file.path());
    const CameraFrame frame = camera_frame(camera, 4, 3);
    for (const int pixel : {0, 2}) {
      const glm::dvec3 d = pixel_direction(frame, 4, 3, pixel, pixel);
      expect(std::abs(glm::length(d) - 1.0) < 1e-9, "unit directions");
    }
  });
}

}  // namespace quincunx::fuzz
