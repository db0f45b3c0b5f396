#include <cmath>
#include <cstddef>

#include "app/points_file.h"
#include "tests/fuzz/expect.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/targets.h"

namespace quincunx::fuzz {

void feed_points(std::string_view input) {
  static MemoryFile file(900);
  file.write(input);
  accepts(file.path(), [&] {
    PointsFile points(file.path());
    std::size_t count = 0;
    while (const auto point = points.next()) {
      expect(std::isfinite(point->x) && std::isfinite(point->y) && std::isfinite(point->z), "finite points");
      ++count;
    }
    expect(6 * count <= input.size() + 1, "no more points than there are lines of x,y,z");
  });
  accepts(file.path(), [&] {
    PointsFile points(file.path(), {"radius", "density"});
    while (points.next())
      for (const std::size_t n : {std::size_t(0), std::size_t(1)}) expect(std::isfinite(points.column(n).value_or(0.0)), "finite columns");
  });
}

}  // namespace quincunx::fuzz
