// Direct volume rendering: the volume along a ray, cut into stretches of one length in the world, each seen through a transfer function.
//
// Stretch k begins at `begin` + k dt, where `begin` is the ray's entry into the domain, and the last one ends with the ray: pure functions
// of the ray, whatever is skipped. What is skipped has no opacity, and adds exactly nothing (docs/exactness.md).
//
// Two loops: the outer one finds stretches that may matter, the inner one evaluates the spline, once a trip in every lane that has some,
// for as long as most lanes have. No lane leaves a loop before its subgroup does, and what it has is kept by selection
// (intersect_exact.glsl says why).
#include "transfer.glsl"
#if defined(VOIDS) && !defined(SURFACES)
#include "voids.glsl"
#endif

#if defined(SURFACES) || defined(MODULATED) || defined(JITTER) || defined(ADAPTIVE)
// Any stretch may be seen in part; otherwise the last one of a ray alone.
#define CUT_ANYWHERE
#endif

struct VolumeRay {
  Walk walk;
  real dt, inverse;      // length of a stretch, in t, and 1/dt
  real world_per_t;
  real depth;            // in the world, at t = 0
  real shift;            // by which part of a stretch the first one begins before the ray
  real k;                // the next stretch
  real reached;          // what is before has been integrated
  real through;          // all that is before, from where something was found, may matter
  real known;            // the first stretch behind it: those before need not be asked for
#ifdef PRE_INTEGRATED
  bool have;             // the value where stretch k goes on is known:
  real front;            // its place in the table
#endif
#ifdef ADAPTIVE
  int parts;             // of stretch k: 0 not known yet, else 1, 2, 4 or 8
  int part;              // the next of them
#endif
#ifdef BRICKS
  bool parked;           // the next place waits for its brick
#endif
#ifndef CUT_ANYWHERE
  rvec4 last;            // the ray's last stretch as if it were whole
  real last_part;        // of it, that the ray goes through; 0 before it is known
#endif
#ifdef COST
  uint evaluations;
#endif
};

#ifdef JITTER
// M. Jarzynski, M. Olano, Hash functions for GPU rendering, Journal of Computer Graphics Techniques 9(3), 2020 (pcg3d), first component.
real pixel_noise(ivec2 pixel) {
  uvec3 v = uvec3(pixel, floatBitsToUint(parameters.sampling.w));
  v = v * 1664525u + 1013904223u;
  v.x += v.y * v.z, v.y += v.z * v.x, v.z += v.x * v.y;
  v ^= v >> 16u;
  v.x += v.y * v.z;
  return real(v.x >> 8) * (1.0 / 16777216.0);
}
#endif

real stretch_begin(Ray ray, VolumeRay volume, real k) {
  precise real t = ray.begin + (k - volume.shift) * volume.dt;
  return t;
}
// The stretch that holds t, or the one before it.
real stretch_before(Ray ray, VolumeRay volume, real t) {
  real x = (t - ray.begin) * volume.inverse + volume.shift;
  return max(floor(x - 1e-3 - 2e-6 * x), 0.0);
}

// What is left of stretch k before `end`.
struct Stretch {
  real first, last;
  real part;   // of a whole one
  bool cut;    // by `end`
};
Stretch stretch_left(Ray ray, VolumeRay volume, real end) {
  real begin = stretch_begin(ray, volume, volume.k);
  real next = stretch_begin(ray, volume, volume.k + 1.0);
  Stretch s;
  s.first = max(begin, volume.reached);
  s.cut = next > end;
  s.last = s.cut ? end : next;
  s.part = s.cut || s.first > begin ? clamp((s.last - s.first) * volume.inverse, 0.0, 1.0) : 1.0;
  return s;
}
bool stretches_left(Ray ray, VolumeRay volume, real end) { return max(stretch_begin(ray, volume, volume.k), volume.reached) < end; }

VolumeRay begin_volume(Ray ray, ivec2 pixel, Walk walk) {
  VolumeRay volume;
  volume.walk = walk;
  real x = real(2 * pixel.x + 1 - parameters.picture.x) / real(parameters.picture.x);
  real y = real(parameters.picture.y - 2 * pixel.y - 1) / real(parameters.picture.y);
  precise real lattice = length(wide(parameters.forward_hi.xyz, parameters.forward_lo.xyz) +
                                (x * wide(parameters.right_hi.xyz, parameters.right_lo.xyz) + y * wide(parameters.up_hi.xyz, parameters.up_lo.xyz)));
  precise real world = length(wide(parameters.world_forward.xyz, parameters.world_forward_lo.xyz) +
                              x * wide(parameters.world_right.xyz, parameters.world_right_lo.xyz) + y * wide(parameters.world_up.xyz, parameters.world_up_lo.xyz));
  volume.world_per_t = world / lattice;
  volume.depth = wide(parameters.base_hi.w, parameters.base_lo.w) * world;
  volume.dt = wide(parameters.sampling.x, parameters.sampling.y) * (lattice / world);
  volume.inverse = 1.0 / volume.dt;
#ifdef JITTER
  volume.shift = pixel_noise(pixel);
#else
  volume.shift = 0.0;
#endif
  volume.reached = ray.begin;
  volume.k = stretch_before(ray, volume, walk.t);
  volume.through = ray.begin;
  volume.known = volume.k;
#ifdef PRE_INTEGRATED
  volume.have = false;
  volume.front = 0.0;
#endif
#ifdef ADAPTIVE
  volume.parts = 0;
  volume.part = 0;
#endif
#ifdef BRICKS
  volume.parked = false;
#endif
#ifndef CUT_ANYWHERE
  volume.last = rvec4(0.0);
  volume.last_part = 0.0;
#endif
#ifdef COST
  volume.evaluations = 0u;
#endif
  return volume;
}

// Nothing more is to be seen behind: early ray termination.
bool opaque(Seen seen) { return seen.transmittance <= parameters.sampling.z; }

#if defined(PRE_INTEGRATED) || defined(ADAPTIVE)
// A stretch matters where any of it may.
#define STRETCHES
#endif

// How many stretches are looked ahead, at least, as long as they may matter.
const real AHEAD = 24.0;

// Where `wanted`, moves on to the next stretch before `end` that may have opacity, and finds how many after it may too (`known`), about AHEAD
// of them. False where there is none left, or (some are left: call again) where the walk is broken off because no more than `break_at` lanes
// of the subgroup still walk.
bool find_stretch(Ray ray, inout VolumeRay volume, real end, bool wanted, uint break_at) {
#ifndef SKIP
#ifdef COST
  volume.walk.steps += wanted ? 1u : 0u;
#endif
  volume.known = NO_HIT;  // all
  return wanted && stretches_left(ray, volume, end);
#else
  bool found = false, extending = false;
  bool seeking = wanted && stretches_left(ray, volume, end);
  do {
    Stretch s = stretch_left(ray, volume, end);
#ifdef STRETCHES
    real t = extending ? volume.through : s.first;
#else
    real t = extending ? volume.through : 0.5 * (s.first + s.last);
#endif
    ivec3 cell = cell_at(ray, t);
    bool asked = (seeking || extending) && t >= volume.walk.until;
    real from, until;
    bool told = skip_step(ray, cell, t, asked, volume.walk.skip, from, until);
    volume.walk.from = told ? from : volume.walk.from;
    volume.walk.until = told ? until : volume.walk.until;
    bool answered = told || ((seeking || extending) && !asked);
    // Its last answer may be of what is ahead of the stretch.
    bool matters = answered && (t >= volume.walk.from || t < volume.through);
#ifdef COST
    volume.walk.intervals += told && from < until ? 1u : 0u;
    volume.walk.steps += seeking || extending ? 1u : 0u;
#endif
    // All from t until `leave` is empty, unless something is here: then all until `reach` may matter.
#ifdef CELL_TEST
    uvec2 brick = occupancy_brick(cell);
    uint planes = occupied_planes(brick, cell);
    int size = empty_cube(brick, planes, cell);
    bool here = matters && (extending ? size < 4 : occupied(planes, cell));
    size = here ? 4 : size;
    real reach = min(exit_time(ray, cell & ~(size - 1), size), volume.walk.until);
    real leave = matters ? reach : volume.walk.from;
#else
    bool here = matters;
    real leave = volume.walk.from;
    real reach = volume.walk.until;
#endif
#ifdef STRETCHES
    here = here || (seeking && answered && leave < s.last);
#endif
    bool move = seeking && answered && !here;
    volume.reached = move && s.cut ? max(volume.reached, s.last) : volume.reached;
    volume.k = move ? max(stretch_before(ray, volume, leave), volume.k + (s.cut ? 0.0 : 1.0)) : volume.k;
#ifdef PRE_INTEGRATED
    volume.have = volume.have && !move;
#endif
    found = found || (seeking && here);
    extending = (extending ? here || !answered : seeking && here) && !(here && (reach <= t || reach >= s.first + AHEAD * volume.dt));
    volume.through = here ? max(reach, volume.through) : volume.through;
    seeking = seeking && !found && stretches_left(ray, volume, end);
  } while (break_at == 0u ? seeking || extending : subgroupBallotBitCount(subgroupBallot(seeking || extending)) > break_at);
  if (extending) volume.walk.skip = begin_skip();  // its search for what is ahead is given up
  volume.known = found ? max(floor((volume.through - ray.begin) * volume.inverse + volume.shift + 0.5), volume.k + 1.0) : volume.known;
  return found;
#endif
}

// What the spline is at a point, as the transfer function sees it.
struct Look {
  real place;        // in the table; pre-integrated, beyond it too
  real light;        // what is left of a colour
  real modulation;   // what is left of an opacity
  real change;       // along a whole stretch, in entries of the table
};

#if defined(LIT) || defined(MODULATED)
rvec3 world_gradient(rvec3 gradient) {
  return gradient.x * wide(parameters.normal_x.xyz, parameters.normal_x_lo.xyz) + gradient.y * wide(parameters.normal_y.xyz, parameters.normal_y_lo.xyz) +
         gradient.z * wide(parameters.normal_z.xyz, parameters.normal_z_lo.xyz);
}
#endif
#ifdef LIT
// The headlight (shade.glsl), from either side.
real light_left(Ray ray, rvec3 n, real size) {
  real facing = size > 0.0 ? min(abs(dot(n, ray.view)) / size, 1.0) : 1.0;
  return mix(facing, 1.0, parameters.background.w);
}
#endif
#ifdef MODULATED
real opacity_left(real size) {
  return clamp((size * (parameters.modulation.z / SPLINE_SCALE) - parameters.modulation.x) * parameters.modulation.y, 0.0, 1.0);
}
#endif

Look look(Ray ray, VolumeRay volume, real t) {
  SplineCell cell = spline_cell(cell_at(ray, t), ray.centre);
  rvec3 u = cell_point(cell, ray.o, ray.d, t);
  real low = SPLINE_SCALE * parameters.transfer.x;
  Look seen = Look(0.0, 1.0, 1.0, 0.0);
  real value;
#if defined(LIT) || defined(MODULATED) || defined(ADAPTIVE)
  rvec3 gradient;
  spline_jet(cell, u, low, value, gradient);
#ifdef ADAPTIVE
  seen.change = abs(dot(gradient, ray.d)) * (volume.dt * wide(parameters.transfer.y, parameters.transfer.w) / SPLINE_SCALE);
#endif
#if defined(LIT) || defined(MODULATED)
  rvec3 n = world_gradient(gradient);
  real size = length(n);
#ifdef LIT
  seen.light = light_left(ray, n, size);
#endif
#ifdef MODULATED
  seen.modulation = opacity_left(size);
#endif
#endif
#else
  value = spline_value(cell, u, low);
#endif
  seen.place = value * (wide(parameters.transfer.y, parameters.transfer.w) / SPLINE_SCALE);
#ifdef PRE_INTEGRATED
  seen.place = clamp(seen.place, -1e18, 1e18);
#else
  seen.place = clamp(seen.place, 0.0, parameters.transfer.z);
#endif
  return seen;
}

// Whether the next stretch, or the rest of this one, may matter without being asked for.
bool within_known(VolumeRay volume) {
#ifdef ADAPTIVE
  return volume.parts > 0 || volume.k < volume.known;
#else
  return volume.k < volume.known;
#endif
}

// The opacity of one of 1, 2, 4 or 8 equal parts of a stretch, with its colour.
rvec4 part_of(rvec4 stretch, int parts) {
  real keep = 1.0 - stretch.a;
  keep = parts > 1 ? sqrt(keep) : keep;
  keep = parts > 2 ? sqrt(keep) : keep;
  keep = parts > 4 ? sqrt(keep) : keep;
  real a = 1.0 - keep;
  return parts > 1 && stretch.a > 0.0 ? rvec4(stretch.rgb * (a / stretch.a), a) : stretch;
}

// Where `here`, adds what reaches until t.
void see_stretch(inout Seen seen, VolumeRay volume, rvec4 stretch, real t, bool here) {
  real transmittance = seen.transmittance;
  seen.color += here ? transmittance * stretch.rgb : rvec3(0.0);
  seen.transmittance = here ? transmittance * (1.0 - stretch.a) : transmittance;
#ifndef SURFACES
  bool half_seen = seen.first.w == NO_HIT && seen.transmittance <= 0.5;
  seen.first.w = half_seen ? volume.depth + t * volume.world_per_t : seen.first.w;
#endif
}

// Where in what is left of a stretch the spline is looked at next.
real look_at(VolumeRay volume, Stretch s) {
#if defined(PRE_INTEGRATED)
  return volume.have ? s.last : s.first;
#elif defined(ADAPTIVE)
  real middle = volume.parts > 1 ? (real(volume.part) + 0.5) / real(volume.parts) : 0.5;
  return s.first + middle * (s.last - s.first);
#else
  return 0.5 * (s.first + s.last);
#endif
}

#ifdef VOIDS
// Whether nothing is seen of a stretch that is looked at in t: it is in a void cell there, or, seen by both ends, a void cell is between them.
bool in_void(Ray ray, Stretch s, real t, bool here) {
#ifdef PRE_INTEGRATED
  return void_between(ray, s.first, s.last, here);
#else
  return is_void(cell_at(ray, t));
#endif
}
#endif

// Evaluates the spline once where `ready` and adds what that tells.
void look_once(Ray ray, inout VolumeRay volume, real end, bool ready, inout Seen seen) {
  Stretch s = stretch_left(ray, volume, end);
  real t = look_at(volume, s);
#ifdef BRICKS
  ivec3 cell = cell_at(ray, t);
  if (ready && !brick_resident(cell)) {
    request_brick(cell);
    volume.parked = true;
  }
  ready = ready && !volume.parked;
#endif
  Look at = look(ray, volume, t);
#if defined(PRE_INTEGRATED)
  rvec4 stretch = pre_integrated(volume.front, at.place);
  bool here = ready && volume.have;
  bool ended = here;
  volume.have = volume.have || ready;
  volume.front = ready ? at.place : volume.front;
#elif defined(ADAPTIVE)
  bool parted = volume.parts > 1;
  rvec4 stretch = part_of(classified(at.place), volume.parts);
  real finest = parameters.modulation.w;   // entries a part may go along
  int parts = at.change <= finest ? 1 : at.change <= 2.0 * finest ? 2 : at.change <= 4.0 * finest ? 4 : 8;
  bool here = ready && (parted || parts == 1);
  bool ended = here && (!parted || volume.part + 1 == volume.parts);
  volume.part = ready && parted ? volume.part + 1 : ready ? 0 : volume.part;
  volume.parts = ended ? 0 : ready && !parted ? parts : volume.parts;
#else
  rvec4 stretch = classified(at.place);
  bool here = ready;
  bool ended = ready;
#endif
#ifdef VOIDS
  bool hidden = in_void(ray, s, t, here);
  stretch = hidden ? vec4(0.0) : stretch;
#endif
  stretch.rgb *= at.light;
#ifdef CUT_ANYWHERE
  stretch = share_of(stretch, s.part * at.modulation);
#else
  // The ray's last stretch alone may be cut: it is seen when the ray has ended.
  bool last = here && s.cut;
  volume.last = last ? stretch : volume.last;
  volume.last_part = last ? s.part : volume.last_part;
  here = here && !s.cut;
#endif
  see_stretch(seen, volume, stretch, s.last, here);
#ifdef COST
  volume.evaluations += ready ? 1u : 0u;
#endif
  volume.reached = ended && s.cut ? s.last : volume.reached;
  volume.k += ended && !s.cut ? 1.0 : 0.0;
}

// Where `wanted`, integrates until `end`, or until nothing more can be seen, or (`parked`) until a brick is missing.
void integrate(Ray ray, inout VolumeRay volume, bool wanted, real end, inout Seen seen) {
  bool busy = wanted && !opaque(seen) && stretches_left(ray, volume, end);
  uint lanes = subgroupBallotBitCount(subgroupBallot(busy));
  do {
    bool ready = busy && within_known(volume);
    ready = find_stretch(ray, volume, end, busy && !ready, lanes / 2u) || ready;
    uint most = subgroupBallotBitCount(subgroupBallot(ready));
    do {
      look_once(ray, volume, end, ready, seen);
      busy = busy && !opaque(seen) && stretches_left(ray, volume, end);
#ifdef BRICKS
      busy = busy && !volume.parked;
#endif
      ready = ready && busy && within_known(volume);
      lanes = subgroupBallotBitCount(subgroupBallot(ready));
    } while (2u * lanes > most);
    lanes = subgroupBallotBitCount(subgroupBallot(busy));
  } while (lanes > 0u);
#ifndef CUT_ANYWHERE
  see_stretch(seen, volume, share_of(volume.last, volume.last_part), ray.end, volume.last_part > 0.0 && !opaque(seen));
#endif
}
