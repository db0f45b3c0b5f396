#include "io/nrrd_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "io/nrrd_numbers.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

/// A vector of three finite numbers "(x,y,z)", white space allowed around each.
std::optional<glm::dvec3> parse_vector(std::string_view text) {
  if (text.size() < 2 || text.front() != '(' || text.back() != ')') return {};
  text = text.substr(1, text.size() - 2);
  glm::dvec3 vector;
  for (int component = 0; component < 3; ++component) {
    const std::size_t comma = component < 2 ? text.find(',') : text.size();
    if (comma == std::string_view::npos) return {};
    const std::optional<double> number = parse_number<double>(trimmed(text.substr(0, comma)));
    if (!number || !std::isfinite(*number)) return {};
    vector[component] = *number;
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return vector;
}

/// The vectors "(..)" and words ("none") of a field.
std::vector<std::string_view> split_vectors(std::string_view text) {
  std::vector<std::string_view> items;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    const std::size_t end = text.front() == '(' ? text.find(')') : text.find_first_of(" \t(");
    const std::size_t length = end == std::string_view::npos ? text.size() : text.front() == '(' ? end + 1 : end;
    items.push_back(text.substr(0, length));
    text.remove_prefix(length);
  }
  return items;
}

/// The steps of one grid from `space directions`: three vectors, and none for the coset axis.
glm::dmat3 directions(const NrrdText& text, int dimension) {
  const std::string name = "space directions";
  const std::vector<std::string_view> items = split_vectors(text.required(name));
  const bool complete = items.size() == std::size_t(dimension) && (dimension == 3 || lower_case(items[3]) == "none");
  glm::dmat3 steps;
  for (int axis = 0; axis < 3; ++axis) {
    const auto step = complete ? parse_vector(items[std::size_t(axis)]) : std::nullopt;
    if (!step) {
      text.refuse(name, dimension == 3 ? "three vectors (x,y,z) of finite numbers"
                                       : "three vectors (x,y,z) of finite numbers and none");
    }
    steps[axis] = *step;
  }
  return steps;
}

/// The steps of one grid from `spacings`: a number for each axis; that of the coset axis means nothing.
glm::dmat3 spacings(const NrrdText& text, int dimension) {
  const std::string name = "spacings";
  const std::vector<std::string_view> items = split_words(text.required(name));
  glm::dmat3 steps(1.0);
  for (int axis = 0; axis < dimension; ++axis) {
    const auto number =
        items.size() == std::size_t(dimension) ? parse_number<double>(items[std::size_t(axis)]) : std::nullopt;
    const bool usable = number && (axis == 3 || (std::isfinite(*number) && *number != 0.0));
    if (!usable) text.refuse(name, fmt::format("{} numbers, the first three finite and not 0", dimension));
    if (axis < 3) steps[axis][axis] = *number;
  }
  return steps;
}

/// The space, where one is named, has three dimensions.
void check_space(const NrrdText& text) {
  if (text.optional("space") != nullptr && !is_space_name(*text.optional("space"))) {
    text.refuse("space", "a three-dimensional space of the NRRD format, such as left-posterior-superior");
  }
  if (text.optional("space dimension") != nullptr && *text.optional("space dimension") != "3") {
    text.refuse("space dimension", "3");
  }
}

}  // namespace

bool is_space_name(std::string_view name) {
  constexpr std::array<std::string_view, 9> names{"right-anterior-superior",
                                                  "ras",
                                                  "left-anterior-superior",
                                                  "las",
                                                  "left-posterior-superior",
                                                  "lps",
                                                  "scanner-xyz",
                                                  "3d-right-handed",
                                                  "3d-left-handed"};
  return std::find(names.begin(), names.end(), lower_case(name)) != names.end();
}

void check_world(const World& world, const std::string& what) {
  // The determinant of unit vectors: its size does not depend on the units.
  double determinant = 1.0;
  glm::dmat3 unit = world.axes;
  for (int axis = 0; axis < 3; ++axis) {
    const double length = std::hypot(unit[axis].x, unit[axis].y, unit[axis].z);
    determinant = std::isfinite(length) && length > 0.0 ? determinant : 0.0;
    unit[axis] /= length;
  }
  constexpr double flattest = 1e-9;
  const bool spans = determinant != 0.0 && std::abs(glm::determinant(unit)) > flattest;
  // What is computed with them must be finite as well: their product, and its inverse.
  const double volume = glm::determinant(world.axes);
  if (!spans || !std::isnormal(volume) || !std::isnormal(1.0 / volume)) {
    throw InputError(
        fmt::format("{}: steps ({:g},{:g},{:g}) ({:g},{:g},{:g}) ({:g},{:g},{:g}) found, expected three finite "
                    "vectors that span the space",
                    what, world.axes[0].x, world.axes[0].y, world.axes[0].z, world.axes[1].x, world.axes[1].y,
                    world.axes[1].z, world.axes[2].x, world.axes[2].y, world.axes[2].z));
  }
  const glm::dvec3& o = world.origin;
  if (!std::isfinite(o.x) || !std::isfinite(o.y) || !std::isfinite(o.z)) {
    throw InputError(fmt::format("{}: origin ({:g},{:g},{:g}) found, expected finite numbers", what, o.x, o.y, o.z));
  }
}

World interpret_world(const NrrdText& text, LatticeKind lattice, int dimension) {
  check_space(text);
  const bool has_directions = text.optional("space directions") != nullptr;
  if (has_directions && text.optional("spacings") != nullptr) {
    text.refuse("spacings", "none beside 'space directions'");
  }
  World world;
  if (has_directions) {
    world.axes = directions(text, dimension);
  } else if (text.optional("spacings") != nullptr) {
    world.axes = spacings(text, dimension);
  }
  if (text.optional("space origin") != nullptr) {
    const std::optional<glm::dvec3> origin = parse_vector(*text.optional("space origin"));
    if (!origin) text.refuse("space origin", "one vector (x,y,z) of finite numbers");
    world.origin = *origin;
  }
  // The header gives the steps of one grid; e_a is a step of the lattice coordinate.
  world.axes /= double(lattice_step(lattice));
  check_world(world, text.path);
  return world;
}

}  // namespace quincunx
