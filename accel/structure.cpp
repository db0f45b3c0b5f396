#include "accel/structure.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "accel/grid.h"
#include "accel/none.h"
#include "lattice/error.h"

namespace quincunx {

const std::vector<std::string_view>& structure_names() {
  static const std::vector<std::string_view> names = {"none", "grid"};
  return names;
}

std::unique_ptr<SkippingStructure> make_structure(std::string_view name) {
  if (name == "none") return std::make_unique<None>();
  if (name == "grid") return std::make_unique<Grid>();
  throw InputError(fmt::format("--skip: found {}, expected one of {}", name, fmt::join(structure_names(), ", ")));
}

}  // namespace quincunx
