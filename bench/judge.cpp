#include "bench/judge.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "render/camera.h"

namespace quincunx {
namespace {

constexpr double kSameSheet = 0.5;     // cells
constexpr double kFloatSlip = 0x1p-23;  // of a depth kept in a float, relative, with room to spare
constexpr double kFarSlip = 1e-3;       // cells
/// A surface is grazed where the value changes along the ray by less than this many bands a cell: depths are then the roots of their errors.
constexpr double kGrazing = 1e3;
constexpr double kTwoFloats = 0x1p-44;    // of rays kept in two floats, relative
constexpr double kNormalRounding = 2e-6;  // radians: a unit vector made and stored in floats
constexpr double kDegrees = 180.0 / glm::pi<double>();

double angle(const glm::dvec3& a, const glm::dvec3& b) { return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)); }

bool finite_pixel(const Frame& frame, std::size_t p) {
  bool finite = !std::isnan(frame.depth[p]);
  for (int c = 0; c < 4; ++c) finite = finite && std::isfinite(frame.color[4 * p + c]);
  for (int a = 0; a < 3; ++a) finite = finite && std::isfinite(frame.normal[3 * p + a]);
  return finite;
}

}  // namespace

Verdict& Verdict::operator+=(const Verdict& other) {
  rays += other.rays;
  expected += other.expected;
  hits += other.hits;
  holes += other.holes;
  wrong += other.wrong;
  undecided += other.undecided;
  not_finite += other.not_finite;
  depth = std::max(depth, other.depth);
  residual = std::max(residual, other.residual);
  normal = std::max(normal, other.normal);
  normal_part = std::max(normal_part, other.normal_part);
  return *this;
}

double local_magnitude(const Coefficients<double>& c, const glm::dvec3& u, double offset) {
  // A cell X and its neighbours are reached from X - 3 to X + 4, of bcc8 and bcc12, whose apron is 2, from X - 4 to X + 5, on the Cartesian lattice
  // from X - 2 to X + 3.
  const bool bcc = c.lattice == LatticeKind::bcc;
  const int below = bcc ? 2 + c.apron : 2, above = below + 1, step = lattice_step(c.lattice);
  double largest = 0.0;
  for (int coset = 0; coset < coset_count(c.lattice); ++coset) {
    glm::i64vec3 low, high;
    for (int a = 0; a < 3; ++a) {
      const double cell = std::floor(u[a]);
      low[a] = std::clamp<std::int64_t>(std::int64_t(std::ceil((cell - below - coset) / step)), -c.apron, c.extents[a] + c.apron - 1);
      high[a] = std::clamp<std::int64_t>(std::int64_t(std::floor((cell + above - coset) / step)), -c.apron, c.extents[a] + c.apron - 1);
    }
    for (std::int64_t k = low.z; k <= high.z; ++k)
      for (std::int64_t j = low.y; j <= high.y; ++j)
        for (std::int64_t i = low.x; i <= high.x; ++i) largest = std::max(largest, std::abs(c.data[c.number(coset, {i, j, k})] - offset));
  }
  return largest;
}

/// A place on a ray where a picture, or the reference, has a hit.
struct Judge::Place {
  double s = 0.0;        ///< along the ray
  Jet jet;               ///< there
  double slip = 0.0;     ///< cells: how far along the ray the picture's depth can tell a place
  double band = 0.0;     ///< within which a value may be taken for the isovalue
  double turn = 0.0;     ///< radians: by how much a normal may be off
};

Judge::Judge(const Spline& spline, const Coefficients<double>& coefficients, const Scene& scene, const CellBounds* cells, const VoidCells* voids)
    : spline_(spline), coefficients_(coefficients), voids_(voids && voids->count > 0 ? voids : nullptr), isovalue_(scene.isosurfaces.front().isovalue), rounding_(kernel_rounding(spline)),
      width_(scene.width), height_(scene.height) {
  assert(scene.isosurfaces.size() == 1);
  const CameraFrame camera = camera_frame(scene.camera, width_, height_);
  const RaySpace space = ray_space(coefficients.lattice, coefficients.extents, coefficients.world, scene.camera.eye);
  normals_ = glm::transpose(space.inverse_axes);
  far_ = space.far;
  const std::array<double, 1> isovalues{isovalue_};
  const Tracer tracer(spline, coefficients, isovalues, cells, {}, voids_);
  rays_.resize(std::size_t(width_) * std::size_t(height_));
  tbb::parallel_for(0, height_, [&](int j) {
    Tracer::Workspace work;
    RayCost cost;
    for (int i = 0; i < width_; ++i) {
      const glm::dvec3 direction = pixel_direction(camera, width_, height_, i, j);
      const std::optional<LatticeRay> ray = clip_ray(space, direction);
      if (!ray) continue;
      std::optional<double> first;
      tracer.trace(*ray, work, cost, [&](const Crossing& crossing) {
        first = crossing.s;
        return false;
      });
      rays_[std::size_t(j) * std::size_t(width_) + std::size_t(i)] = Ray{*ray, direction, first};
    }
  });
}

double Judge::displacement(const Config& config) const {
  const glm::i64vec3 own = cell_count(coefficients_.lattice, coefficients_.extents);
  return ray_displacement(glm::max(own, config.cells)) * (config.epsilon / 0x1p-24);
}

Jet Judge::jet(const LatticeRay& ray, double s, const glm::dvec3& aside) const {
  const glm::dvec3 u = glm::clamp(ray.point(std::clamp(s, 0.0, ray.length)) + aside, glm::dvec3(0.0), far_);
  return spline_.evaluate(coefficients_, u);
}

Judge::Place Judge::place(const Ray& ray, double s, bool told, const Config& config) const {
  Place p;
  p.s = std::clamp(s, 0.0, ray.lattice.length);
  p.jet = jet(ray.lattice, p.s);
  const double distance = std::abs(ray.lattice.distance(p.s)) / ray.lattice.scale;  // cells
  p.slip = told ? kFloatSlip * distance : 0.0;
  const double aside = displacement(config) + kTwoFloats * distance;
  const double rounding = config.epsilon * local_magnitude(coefficients_, ray.lattice.point(p.s), config.offset);

  // The places that may be meant by this one.
  const glm::dvec3 g = normals_ * p.jet.gradient;
  double slope = glm::length(p.jet.gradient), along = 0.0;
  const double gradient_rounding = spline_.degree() * rounding_ * rounding;
  const auto meant = [&](const Jet& other) {
    const double size = glm::length(other.gradient);
    slope = std::max(slope, size);
    // A piece that is level here has no direction to tell.
    p.turn = std::max(p.turn, size > gradient_rounding ? angle(g, normals_ * other.gradient) : glm::pi<double>());
  };
  for (const double side : {-1.0, 1.0}) {
    const Jet beside = jet(ray.lattice, p.s + side * (p.slip + aside));
    along = std::max(along, std::abs(beside.value - p.jet.value));
    meant(beside);
  }
  for (int n = 0; n < 27; ++n) meant(jet(ray.lattice, p.s, aside * glm::dvec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1)));
  p.band = rounding_ * rounding + slope * aside + along + config.shift;
  double norm = 0.0;
  for (int a = 0; a < 3; ++a) norm += glm::length(normals_[a]);
  const double size = glm::length(g), off = norm * gradient_rounding;
  p.turn += (off < size ? std::asin(off / size) : glm::pi<double>()) + kNormalRounding;
  return p;
}

std::optional<double> Judge::decided(const Ray& ray, double band) const {
  const std::array<double, 2> levels{isovalue_ - band, isovalue_ + band};
  if (voids_ || !(levels[0] < levels[1])) return ray.expected;
  const Tracer tracer(spline_, coefficients_, levels, nullptr, {});
  const double begin = jet(ray.lattice, 0.0).value;
  int side = begin < levels[0] ? -1 : begin >= levels[1] ? 1 : 0;  // that the ray certainly was on last
  bool between = side == 0;
  std::optional<double> first;
  Tracer::Workspace work;
  RayCost cost;
  tracer.trace(ray.lattice, work, cost, [&](const Crossing& crossing) {
    // From outside the band a crossing leads into it; from inside it leads out, at the level that is crossed.
    between = !between;
    if (between) return true;
    const int now = crossing.surface == 0 ? -1 : 1;
    if (side != 0 && now != side) first = crossing.s;
    side = now;
    return !first.has_value();
  });
  return first;
}

void Judge::judge_hit(const Frame& frame, std::size_t pixel, const Ray& ray, const Place& hit, Verdict& verdict) const {
  const double off = std::abs(hit.jet.value - isovalue_);
  verdict.residual = std::max(verdict.residual, off == 0.0 ? 0.0 : off / hit.band);
  const glm::dvec3 n(frame.normal[3 * pixel], frame.normal[3 * pixel + 1], frame.normal[3 * pixel + 2]);
  if (std::abs(glm::length(n) - 1.0) > 1e-5) ++verdict.not_finite;
  if (hit.turn >= 0.25 * glm::pi<double>()) return;  // any direction is as good
  glm::dvec3 g = normals_ * hit.jet.gradient;
  if (glm::dot(g, ray.direction) > 0.0) g = -g;  // facing the viewer
  double off_normal = angle(n, g);
  // Seen from the side, either face may be meant.
  if (std::abs(glm::dot(glm::normalize(g), ray.direction)) < std::sin(hit.turn)) off_normal = std::min(off_normal, glm::pi<double>() - off_normal);
  verdict.normal = std::max(verdict.normal, off_normal * kDegrees);
  verdict.normal_part = std::max(verdict.normal_part, off_normal / hit.turn);
}

Verdict Judge::judge_pixel(const Frame& frame, std::size_t pixel, const std::optional<Ray>& ray, const Config& config) const {
  Verdict v;
  v.rays = 1;
  if (!finite_pixel(frame, pixel)) {
    v.not_finite = 1;
    return v;
  }
  const double depth = frame.depth[pixel];
  const bool hit = std::isfinite(depth);
  v.hits = hit;
  if (!ray) {  // past the domain, or so near its edge that rounding may decide
    v.undecided = hit;
    return v;
  }
  v.expected = ray->expected.has_value();
  if (!hit && !ray->expected) return v;

  const double s = hit ? (depth - ray->lattice.entry) / ray->lattice.scale : *ray->expected;
  // A depth from so far away that it tells no place: the reference's hit stands for it, if it may be that.
  const double slip = kFloatSlip * std::abs(depth) / ray->lattice.scale;
  const bool stands = hit && ray->expected && slip > kFarSlip && std::abs(s - *ray->expected) <= slip;
  const Place here = place(*ray, stands ? *ray->expected : s, hit && !stands, config);
  const bool grazed = std::abs(glm::dot(here.jet.gradient, ray->lattice.direction)) < kGrazing * here.band;
  const bool same = hit && ray->expected && std::abs(s - *ray->expected) <= std::max(kSameSheet, 2.0 * slip);
  if (hit) judge_hit(frame, pixel, *ray, here, v);
  if (same) {
    if (!grazed && !stands) v.depth = std::abs(s - *ray->expected);
    return v;
  }
  double band = here.band;
  if (hit && ray->expected) band = std::max(band, place(*ray, *ray->expected, false, config).band);
  const std::optional<double> certain = decided(*ray, band);
  if (!hit && certain) {
    v.holes = 1;
  } else if (hit && (v.residual > 1.0 || (voids_ && !certain) || (certain && s > *certain + here.slip + 2.0 * displacement(config)))) {
    v.wrong = 1;
  } else {
    v.undecided = 1;
  }
  return v;
}

Verdict Judge::judge(const Frame& frame, const Config& config) const {
  assert(frame.depth.size() == rays_.size());
  std::vector<Verdict> rows(static_cast<std::size_t>(height_));
  tbb::parallel_for(0, height_, [&](int j) {
    for (int i = 0; i < width_; ++i) {
      const std::size_t pixel = std::size_t(j) * std::size_t(width_) + std::size_t(i);
      rows[std::size_t(j)] += judge_pixel(frame, pixel, rays_[pixel], config);
    }
  });
  Verdict all;
  for (const Verdict& row : rows) all += row;
  return all;
}

}  // namespace quincunx
