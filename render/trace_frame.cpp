#include "render/trace_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "lattice/error.h"
#include "render/transfer_table.h"

namespace quincunx {
namespace {

/// Nearer than this many radii of the domain's bounding sphere, rays start at the eye itself.
constexpr double kNear = 1.5;
/// Stretches that a kernel can count along a ray, in floats.
constexpr double kMostStretches = 1 << 23;

float high(double x) { return float(x); }
// volatile: GCC 12 takes the difference for 0 where it makes a vector of several.
float low(double x) {
  const volatile float hi = float(x);
  return float(x - double(hi));
}

void store(const glm::dvec3& x, double w, vec4& hi, vec4& lo) {
  hi = vec4(high(x.x), high(x.y), high(x.z), high(w));
  lo = vec4(low(x.x), low(x.y), low(x.z), low(w));
}

vec4 narrow(const glm::dvec3& x, double w = 0.0) { return vec4(glm::vec3(x), float(w)); }

void store(const glm::dvec3& x, vec4& hi, vec4& lo) {
  hi = narrow(x);
  lo = vec4(low(x.x), low(x.y), low(x.z), 0.0f);
}

/// The inverse of the world's axes; throws where there is none.
glm::dmat3 inverse_axes(const World& world) {
  const glm::dmat3 inverse = glm::inverse(world.axes);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (!std::isfinite(inverse[i][j])) throw InputError("space directions: they do not span space; expected three independent vectors");
  return inverse;
}

/// Half the longest diagonal of the domain, world units.
double domain_radius(const World& world, const glm::dvec3& centre) {
  double radius = 0.0;
  for (int i = 0; i < 4; ++i) {  // the four diagonals
    const glm::dvec3 corner(centre.x, i & 1 ? -centre.y : centre.y, i & 2 ? -centre.z : centre.z);
    radius = std::max(radius, glm::length(world.axes * corner));
  }
  return radius;
}

/// How far along the view (world units) rays start: at the plane through the centre, or at an eye that is near or past it.
double start_plane(const Camera& camera, const glm::dvec3& forward, const World& world, const glm::dvec3& centre) {
  const glm::dvec3 to_centre = world.to_world(centre) - camera.eye;
  const double radius = domain_radius(world, centre);
  return glm::length(to_centre) < kNear * radius ? 0.0 : std::max(0.0, glm::dot(to_centre, forward));
}

/// Throws where a ray through a domain of this radius may have more stretches than can be counted.
void check_stretches(const DirectVolume& volume, double cell, double radius) {
  const double least = 2.0 * radius / cell / kMostStretches;
  if (volume.step < least) throw InputError(fmt::format("--step: found {}, expected at least {:.3g} for a volume as large as this", volume.step, 1.01 * least));
}

/// What a volume's kernels are told but for its table. `scale`: by how much world gradients, in the coefficients' unit, are more than normal_x..
/// makes of them.
void store_volume(const DirectVolume& volume, double cell, double scale, const ValueUnit& unit, TraceParameters& p) {
  p.sampling = vec4(high(volume.step * cell), low(volume.step * cell), float(volume.termination), std::bit_cast<float>(volume.jitter.value_or(0)));
  const double last = volume.table_entries() - 1;
  const double lowest = float_below(volume.function.low()), highest = float_above(volume.function.high());
  const double entries = last / (highest - lowest) * unit.scale;
  p.transfer = vec4(float(unit.number(lowest)), high(entries), float(last), low(entries));
  if (volume.modulated())
    p.modulation = vec4(float(volume.modulate_from), float(1.0 / (volume.modulate_to - volume.modulate_from)), float(scale * unit.scale), 0.0f);
  p.modulation.w = float(volume.finest * last);
}

}  // namespace

TraceParameters trace_parameters(const Scene& scene, const Coefficients<float>& coefficients) {
  const World& world = coefficients.world;
  const glm::dmat3 to_lattice = inverse_axes(world);
  const CameraFrame frame = camera_frame(scene.camera, scene.width, scene.height);
  const glm::dvec3 cells(domain_max(coefficients.lattice, coefficients.extents));
  const glm::dvec3 centre = cells / 2.0;

  TraceParameters p{};
  const glm::dvec3 forward = to_lattice * frame.forward, right = to_lattice * frame.right, up = to_lattice * frame.up;
  store(forward, 0.0, p.forward_hi, p.forward_lo);
  store(right, 0.0, p.right_hi, p.right_lo);
  store(up, 0.0, p.up_hi, p.up_lo);

  const double plane = start_plane(scene.camera, frame.forward, world, centre);
  const glm::dvec3 base = to_lattice * (scene.camera.eye - world.origin + plane * frame.forward) - centre;
  store(base, plane, p.base_hi, p.base_lo);
  store(plane * right, 0.0, p.base_right_hi, p.base_right_lo);
  store(plane * up, 0.0, p.base_up_hi, p.base_up_lo);

  const double tangent_x = glm::length(frame.right), tangent_y = glm::length(frame.up);
  p.tangent = vec4(high(tangent_x), low(tangent_x), high(tangent_y), low(tangent_y));
  store(frame.forward, p.world_forward, p.world_forward_lo);
  store(frame.right, p.world_right, p.world_right_lo);
  store(frame.up, p.world_up, p.world_up_lo);

  // Only the direction of a normal matters: scale the matrix into the middle of the floats.
  glm::dmat3 normal = glm::transpose(to_lattice);
  double largest = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) largest = std::max(largest, std::abs(normal[i][j]));
  normal /= largest;
  if (scene.volume) {
    check_stretches(*scene.volume, cell_length(world), domain_radius(world, centre));
    store_volume(*scene.volume, cell_length(world), largest, coefficients.unit, p);
  }
  store(normal[0], p.normal_x, p.normal_x_lo);
  store(normal[1], p.normal_y, p.normal_y_lo);
  store(normal[2], p.normal_z, p.normal_z_lo);

  p.background = narrow(scene.background, scene.ambient);
  const double delta = difference_step(scene, coefficients.lattice);
  p.march = vec4(high(scene.step), high(delta), low(scene.step), low(delta));
  p.cells = ivec4(glm::ivec3(cells), int(scene.isosurfaces.size()));
  p.strides = ivec4(int(coefficients.stride_y()), int(coefficients.stride_z()), int(coefficients.stride_coset()),
                    int(coefficients.number(0, glm::i64vec3(0))));
  p.picture = ivec4(scene.width, scene.height, 0, scene.height);
  return p;
}

}  // namespace quincunx
