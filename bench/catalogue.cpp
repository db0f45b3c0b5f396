#include "bench/catalogue.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cassert>
#include <cmath>
#include <cstdint>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <type_traits>

#include "lattice/error.h"

namespace quincunx {
namespace {

using Vec = glm::dvec3;
constexpr double kDegreesPerRadian = 180.0 / glm::pi<double>();

const Vec kMiddle(15.5);
const Vec kTilted = glm::normalize(Vec(0.36, 0.48, 0.8));

/// Distance from a tilted plane a little off the middle.
double plane(const Vec& u) { return glm::dot(kTilted, u - kMiddle) + 0.21; }
/// Positive inside a ball; a quadratic, which splines of order 3 and more reproduce away from the border.
double ball(const Vec& u, const Vec& centre, double radius) {
  const Vec d = u - centre;
  return radius * radius - glm::dot(d, d);
}
/// Noise in [0,1): the top bits of a hash of the coordinates.
double noise(const Vec& u) {
  std::uint64_t h = std::uint64_t(std::int64_t(u.x)) * 0x9e3779b97f4a7c15u ^ std::uint64_t(std::int64_t(u.y)) * 0xbf58476d1ce4e5b9u ^
                    std::uint64_t(std::int64_t(u.z)) * 0x94d049bb133111ebu;
  h = (h ^ h >> 31) * 0xd6e8feb86659fd93u;
  return double((h ^ h >> 32) >> 11) * 0x1p-53;
}

/// A camera that looks from `eye` at `target`; up is the axis that it looks along least.
Camera look(const Vec& eye, const Vec& target, double fov) {
  const Vec d = glm::abs(target - eye);
  return {eye, target, d.z <= d.x && d.z <= d.y ? Vec(0, 0, 1) : d.y <= d.x ? Vec(0, 1, 0) : Vec(1, 0, 0), fov};
}
/// A picture `height` high at `target`.
double fov_of(double height, double distance) { return 2.0 * std::atan(0.5 * height / distance) * kDegreesPerRadian; }

StabilityCase make(std::string name, std::function<double(const Vec&)> field, double isovalue) {
  StabilityCase c;
  c.name = std::move(name);
  c.field = std::move(field);
  c.isovalue = isovalue;
  return c;
}

std::vector<StabilityCase> stiff() {
  std::vector<StabilityCase> all;
  for (const double width : {0.01, 0.1, 1.0})
    all.push_back(make(fmt::format("a step {} cells wide", width), [width](const Vec& u) { return glm::clamp(plane(u) / width + 0.5, 0.0, 1.0); }, 0.5));
  for (const double slope : {1e2, 1e4, 1e6})
    all.push_back(make(fmt::format("a sigmoid of slope {:g}", slope),
                       [slope](const Vec& u) { return 1.0 / (1.0 + std::exp(-slope * (9.3 - glm::distance(u, kMiddle)))); }, 0.5));
  // +1 on the even coset, -1 on the odd one: at u the parity of x, all three being alike. On the Cartesian lattice, signs that alternate along each axis.
  const auto cosets = [](const Vec& u) { return std::cos(glm::pi<double>() * u.x); };
  // Signs that alternate within each coset; on the Cartesian lattice in pairs.
  const auto pairs = [](const Vec& u) { return std::sqrt(2.0) * std::cos(0.5 * glm::pi<double>() * (u.x + u.y + u.z - 0.5)); };
  const auto checkers = [](const Vec& u) { return std::cos(glm::pi<double>() * (u.x + u.y + u.z)); };
  all.push_back(make("alternating along x", cosets, 0.0));
  all.push_back(make("a checkerboard of samples", checkers, 0.0));
  all.push_back(make("signs that alternate within each coset", pairs, 0.0));
  all.push_back(make("a checkerboard, isovalue near its top", checkers, 0.1));
  const auto spike = [](const Vec& u) { return u == Vec(16, 14, 12) ? 1e6 : 1.0; };
  all.push_back(make("a spike of 1e6 in a field of 1, seen at 2", spike, 2.0));
  all.push_back(make("a spike of 1e6 in a field of 1, seen at 1e5", spike, 1e5));
  const auto edge = [](const Vec& u) { return plane(u) < 0.0 ? 0.0 : 1.0; };
  all.push_back(make("what a prefilter overshoots, above", edge, 1.03));
  all.push_back(make("what a prefilter overshoots, below", edge, -0.03));
  all.push_back(make("noise", noise, 0.5));
  return all;
}

std::vector<StabilityCase> scale() {
  std::vector<StabilityCase> all;
  for (const double size : {1e-42, 1e-38, 1e-20, 1e20, 3e38})
    all.push_back(make(fmt::format("values of magnitude {:g}", size), [size](const Vec& u) { return size * ball(u, kMiddle, 10.0) / 700.0; }, 0.02 * size));
  for (const double offset : {1e6, 1e7, -1e7})
    all.push_back(make(fmt::format("a signal of 1 on an offset of {:g}", offset), [offset](const Vec& u) { return offset + ball(u, kMiddle, 10.0) / 700.0; },
                       offset + 0.0625));
  // Samples a unit apart, as floats of this size are.
  all.push_back(make("a signal of 60 on an offset of 1e7", [](const Vec& u) { return 1e7 + std::rint(ball(u, kMiddle, 10.0) / 10.0); }, 1e7 + 2.25));
  StabilityCase full = make("int16 at full scale", [](const Vec& u) { return glm::clamp(ball(u, kMiddle, 11.0) * 300.0, -32768.0, 32767.0); }, 12.5);
  full.type = SampleType::int16;
  all.push_back(full);
  full = make("uint16 at full scale", [](const Vec& u) { return glm::clamp(ball(u, kMiddle, 11.0) * 600.0, 0.0, 65535.0); }, 65000.0);
  full.type = SampleType::uint16;
  all.push_back(full);
  return all;
}

std::vector<StabilityCase> flat() {
  std::vector<StabilityCase> all;
  const double value = 0.7f, next = std::nextafter(0.7f, 1.0f);
  const auto constant = [value](const Vec&) { return value; };
  all.push_back(make("constant, at the isovalue", constant, value));
  all.push_back(make("constant, above the isovalue", constant, value - 1e-3));
  all.push_back(make("constant, below the isovalue", constant, value + 1e-3));
  all.push_back(make("constant, the isovalue between it and the next float", constant, 0.5 * (value + next)));
  for (const double level : {0.25, double(0.3f)}) {
    const auto plateau = [level](const Vec& u) { return std::min(level, 0.1 * ball(u, kMiddle, 11.0)); };
    all.push_back(make(fmt::format("a plateau at the isovalue, {:.2g}", level), plateau, level));
  }
  const auto pit = [](const Vec& u) { return std::max(0.25, -0.1 * ball(u, kMiddle, 8.0)); };
  all.push_back(make("a pit at the isovalue", pit, 0.25));
  const auto smooth = [](const Vec& u) { return float(ball(u, Vec(16, 16, 16), 10.0)); };
  all.push_back(make("isovalue equal to the data's maximum", smooth, 100.0));
  const auto bowl = [](const Vec& u) { return float(-ball(u, Vec(16, 16, 16), 10.0)); };
  all.push_back(make("isovalue equal to the data's minimum", bowl, -100.0));
  all.push_back(make("isovalue between two adjacent floats", [](const Vec& u) { return 0.02 * ball(u, kMiddle, 10.0); }, 0.5 * (value + next)));
  return all;
}

std::vector<StabilityCase> tangency() {
  std::vector<StabilityCase> all;
  const Vec top = kMiddle + Vec(0, 0, 10);
  for (const double height : {1e-2, 1e-4, 2e-6}) {
    StabilityCase c = make(fmt::format("a sphere grazed within {:g} cells", 0.5 * height), [](const Vec& u) { return ball(u, kMiddle, 10.0); }, 0.0);
    c.cameras = {look(top - Vec(60, 0, 0), top, fov_of(height, 60.0)), look(top - Vec(40, 40, 0), top, fov_of(height, std::hypot(40.0, 40.0)))};
    all.push_back(c);
  }
  for (const double height : {1e-3, 2e-6}) {
    StabilityCase c = make(fmt::format("a sheet grazed within {:g} cells", 0.5 * height), [](const Vec& u) { return u.z - 15.25; }, 0.0);
    const Vec at(15.5, 15.5, 15.25);
    c.cameras = {look(at - Vec(60, 0, 0), at, fov_of(height, 60.0)), look(at - Vec(50, 33, 0), at, fov_of(height, 60.0))};
    all.push_back(c);
  }
  // A saddle, which every spline here reproduces: along (1,-1,0) its double root is at (17.25, 17.25).
  for (const double height : {1e-2, 1e-4, 2e-6}) {
    StabilityCase c = make(fmt::format("a saddle grazed within {:g} cells", 0.5 * height), [](const Vec& u) { return (u.x - 15.25) * (u.y - 15.25); }, 4.0);
    const Vec at(17.25, 17.25, 15.5);
    c.cameras = {look(at - Vec(40, -40, 0), at, fov_of(height, std::hypot(40.0, 40.0))), look(at + Vec(40, -40, 30), at, fov_of(height, 64.0))};
    all.push_back(c);
  }
  const auto along = [](const Vec& u) { return plane(u); };
  all.push_back(make("double roots, touched from above", [along](const Vec& u) { return along(u) * along(u); }, 0.0));
  all.push_back(make("double roots, touched from below", [along](const Vec& u) { return -along(u) * along(u); }, 0.0));
  all.push_back(make("triple roots", [along](const Vec& u) { return std::pow(along(u), 3.0); }, 0.0));
  for (const double apart : {0.001, 0.01, 0.1, 1.0})
    all.push_back(make(fmt::format("two sheets {} cells apart", apart), [along, apart](const Vec& u) { return along(u) * (along(u) - apart); }, 0.0));
  return all;
}

/// Cameras around a ball about (16,16,16) that look along the directions, and against them, through places that rounding likes to break.
std::vector<Camera> along(const std::vector<Vec>& directions) {
  std::vector<Camera> cameras;
  for (const Vec& d : directions)
    for (const double way : {1.0, -1.0})
      for (const Vec& through : {Vec(16), Vec(15), Vec(16.5), Vec(16, 15.5, 16)}) cameras.push_back(look(through - way * 60.0 * glm::normalize(d), through, 8.0));
  return cameras;
}

std::vector<StabilityCase> rays() {
  std::vector<StabilityCase> all;
  const auto sphere = [](const Vec& u) { return ball(u, Vec(16), 9.0); };
  const auto seen = [&](const std::string& name, const std::vector<Camera>& cameras, int size) {
    StabilityCase c = make(name, sphere, 0.0);
    c.cameras = cameras;
    c.size = size;
    all.push_back(c);
  };
  // The middle ray of an odd picture runs exactly along the direction; rows and columns through it lie in planes.
  seen("along the axes", along({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), 15);
  seen("along the diagonals of faces, in knot planes", along({{1, 1, 0}, {1, -1, 0}, {0, 1, 1}, {0, 1, -1}, {1, 0, 1}, {1, 0, -1}}), 15);
  seen("along the diagonals of cells, through lattice points", along({{1, 1, 1}, {-1, 1, 1}, {1, -1, 1}, {1, 1, -1}}), 15);
  seen("components of 1e-30", along({{1, 1e-30, 0}, {1e-30, 1, -1e-30}, {-0.0, 1e-30, 1}}), 15);
  seen("components of 1e-9 to 1e-6", along({{1, 1e-9, 1e-6}, {1e-8, 1, -1e-7}, {-1e-6, 1e-9, 1}}), 15);

  std::vector<Camera> inside;
  for (const Vec& d : {Vec(1, 0, 0), Vec(0, -1, 0), Vec(0, 0, 1), Vec(1, 1, 1), Vec(-3, 1, 2)}) inside.push_back(look(Vec(16), Vec(16) + d, 100.0));
  seen("eye inside, at a lattice point", inside, 33);
  seen("eye on the domain's boundary", {look(Vec(0, 16, 16), Vec(16), 60.0), look(Vec(0), Vec(16), 50.0), look(Vec(31, 31, 16), Vec(16), 50.0)}, 33);
  seen("eye on the surface", {look(Vec(7, 16, 16), Vec(16), 90.0), look(Vec(7, 16, 16), Vec(0, 16, 16), 90.0), look(Vec(7, 16, 16), Vec(7, 30, 16), 90.0)}, 33);
  for (const double sizes : {1e3, 1e5, 1e7}) {
    const double distance = 31.0 * sizes;
    seen(fmt::format("eye {:g} volume sizes away", sizes),
         {look(Vec(16) + distance * glm::normalize(Vec(0.3, -0.8, 0.5)), Vec(16), fov_of(16.0, distance)),
          look(Vec(16) + distance * glm::normalize(Vec(-1, 0.01, 0.0)), Vec(16), fov_of(20.0, distance))},
         48);
  }
  seen("a field of view of 0.001 degrees", {look(Vec(-40, 10, 20), Vec(16), 0.001), look(Vec(16, -16, 16), Vec(16, 16, 25), 0.001)}, 33);
  seen("a field of view of 179 degrees", {look(Vec(16, 5, 16), Vec(16), 179.0), look(Vec(16, 16, 16), Vec(0), 179.0)}, 65);
  return all;
}

std::vector<StabilityCase> geometry() {
  std::vector<StabilityCase> all;
  for (const glm::i64vec3& cells : {glm::i64vec3(0), {1, 1, 79}, {0, 0, 40}, {3, 3, 3}, {5, 5, 5}, {1, 3, 5}, {41, 1, 3}}) {
    StabilityCase c = make(fmt::format("{} x {} x {} cells", cells.x, cells.y, cells.z), noise, 0.5);
    c.cells = cells;
    all.push_back(c);
  }
  const auto sphere = [](const Vec& u) { return ball(u, kMiddle, 10.0); };
  const auto placed = [&](const std::string& name, const World& world, const std::vector<Camera>& cameras = {}) {
    StabilityCase c = make(name, sphere, 0.0);
    c.world = world;
    c.cameras = cameras;
    all.push_back(c);
  };
  // Along the long axis, and so near that a part of the surface fills the picture.
  placed("cells stretched 1 : 1000", {Vec(0), glm::dmat3(1, 0, 0, 0, 1, 0, 0, 0, 1000)},
         {look(Vec(15.5, 15.5, -1e5), Vec(15.5, 15.5, 15500), fov_of(31.0, 115500)), look(Vec(15.5, -30, 14000), Vec(15.5, 15.5, 15500), 20.0), look(Vec(-20, 15.5, 8000), Vec(15.5, 15.5, 9000), 10.0)});
  const World stretched{Vec(1, 2, 3), glm::dmat3(1000, 0, 0, 0.5, 1, 0, 0, 0.3, 1)};
  const Vec middle = stretched.to_world(kMiddle);
  placed("cells stretched 1000 : 1, sheared", stretched, {look(middle - Vec(2e5, 0, 0), middle, fov_of(31.0, 2e5)), look(middle - Vec(100, 40, 3), middle, 20.0)});
  placed("sheared", {Vec(3, -7, 11), glm::dmat3(1, 0.2, 0, -0.3, 0.8, 0.1, 0, 0.4, 1.3)});
  placed("mirrored", {Vec(0), glm::dmat3(-1, 0, 0, 0, 1, 0, 0, 0, 1)});
  placed("sheared and mirrored", {Vec(3, -7, 11), glm::dmat3(1, 0.2, 0, -0.3, 0.8, 0.1, 0, 0.4, -1.3)});
  placed("cells of 1e-3 near 1e6", {Vec(1e6, -1e6, 1e6), glm::dmat3(1e-3)});
  placed("cells of 1e-12", {Vec(0), glm::dmat3(1e-12)});
  placed("cells of 1e12", {Vec(0), glm::dmat3(1e12)});
  return all;
}

/// Samples that are not finite, in a ball's field and about its surface, and what is made of them.
std::vector<StabilityCase> data() {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const auto sphere = [](const Vec& u) { return ball(u, kMiddle, 10.0); };
  const NanPolicy empty{NanPolicy::Kind::empty, 0.0}, fill{NanPolicy::Kind::fill, -20.0};
  std::vector<StabilityCase> all;
  const auto add = [&](const std::string& name, const std::function<double(const Vec&)>& field, const std::vector<NanPolicy>& policies) {
    for (const NanPolicy& policy : policies) {
      const char* how = policy.kind == NanPolicy::Kind::refuse ? "refused" : policy.kind == NanPolicy::Kind::empty ? "empty" : "filled";
      StabilityCase c = make(fmt::format("{}, {}", name, how), field, 0.0);
      c.nan = policy;
      all.push_back(c);
    }
  };
  // Near the surface, on either side of it.
  const auto spot = [](const Vec& u) { return u == Vec(10, 8, 20) || u == Vec(22, 22, 20); };
  add("two NaN samples", [=](const Vec& u) { return spot(u) ? nan : sphere(u); }, {{}, empty, fill});
  add("two infinite samples", [=](const Vec& u) { return spot(u) ? (u.x < 16 ? inf : -inf) : sphere(u); }, {{}, empty, fill});
  add("a ball of NaN that cuts the surface", [=](const Vec& u) { return glm::distance(u, Vec(8, 10, 22)) < 6.0 ? nan : sphere(u); }, {empty});
  add("a plane of NaN", [=](const Vec& u) { return std::abs(u.z - 16.0) <= 1.0 ? nan : sphere(u); }, {empty});
  add("NaN all around the ball", [=](const Vec& u) { return glm::distance(u, kMiddle) > 13.5 ? nan : sphere(u); }, {empty});
  add("one sample of 50 NaN or infinite", [=](const Vec& u) { return noise(u) < 0.02 ? (noise(u) < 0.01 ? nan : -inf) : sphere(u); }, {empty, fill});
  add("nothing but NaN", [=](const Vec&) { return nan; }, {empty});
  return all;
}

struct Group {
  std::string_view name;
  std::vector<StabilityCase> (*cases)();
};
/// The one list of them.
constexpr Group kGroups[] = {{"stiff", stiff}, {"scale", scale}, {"flat", flat}, {"tangency", tangency}, {"rays", rays}, {"geometry", geometry}, {"data", data}};

template <class T>
T rounded(double x) {
  if constexpr (std::is_floating_point_v<T>) return T(x);
  return T(std::rint(glm::clamp(x, double(std::numeric_limits<T>::lowest()), double(std::numeric_limits<T>::max()))));
}

template <class T>
std::vector<T> samples_of(const StabilityCase& c, LatticeKind lattice, const Extents& n) {
  std::vector<T> samples;
  const double step = lattice_step(lattice);
  for (int coset = 0; coset < coset_count(lattice); ++coset)
    for (std::int64_t k = 0; k < n.z; ++k)
      for (std::int64_t j = 0; j < n.y; ++j)
        for (std::int64_t i = 0; i < n.x; ++i) samples.push_back(rounded<T>(c.field(step * Vec(i, j, k) + double(coset))));
  return samples;
}

}  // namespace

Volume StabilityCase::sampled(LatticeKind lattice) const {
  Volume volume;
  volume.lattice = lattice;
  volume.world = world;
  volume.extents = lattice == LatticeKind::bcc ? (cells + std::int64_t(2)) / std::int64_t(2) : cells + std::int64_t(1);
  switch (type) {
    case SampleType::uint8: volume.samples = samples_of<std::uint8_t>(*this, lattice, volume.extents); break;
    case SampleType::int16: volume.samples = samples_of<std::int16_t>(*this, lattice, volume.extents); break;
    case SampleType::uint16: volume.samples = samples_of<std::uint16_t>(*this, lattice, volume.extents); break;
    case SampleType::float32: volume.samples = samples_of<float>(*this, lattice, volume.extents); break;
  }
  return volume;
}

std::vector<Camera> StabilityCase::views(LatticeKind lattice) const {
  if (!cameras.empty()) return cameras;
  const Extents extents = lattice == LatticeKind::bcc ? (cells + std::int64_t(2)) / std::int64_t(2) : cells + std::int64_t(1);
  std::vector<Camera> views;
  for (const Orbit& orbit : {Orbit{30.0, 20.0, 1.0}, Orbit{200.0, -35.0, 1.0}}) views.push_back(framing_camera(lattice, extents, world, orbit, size, size));
  return views;
}

const std::vector<std::string_view>& stability_groups() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const Group& group : kGroups) all.push_back(group.name);
    return all;
  }();
  return names;
}

std::vector<StabilityCase> stability_cases(std::string_view name) {
  for (const Group& group : kGroups) {
    if (group.name != name) continue;
    std::vector<StabilityCase> cases = group.cases();
    for (StabilityCase& c : cases) c.group = group.name;
    return cases;
  }
  throw InputError(fmt::format("--groups: found {}, expected one of {}", name, fmt::join(stability_groups(), ", ")));
}

}  // namespace quincunx
