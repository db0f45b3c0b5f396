// First roots: every polynomial piece along the ray in Bernstein form.
//
// One flat loop in which each seeking lane looks at one piece a trip, wherever it is on its way; roots are isolated after it.
// The level is carried along the ray: a value on the other side at the start of a piece means that a root fell
// to rounding between two pieces, and counts there.
//
// No lane leaves a loop before its subgroup does: what a lane found is kept by selection. (Mesa 22.3's lavapipe gives lanes
// that left a do-while early the values of the last trip; and a masked lane costs it as much as a live one.)

#include "bernstein.glsl"
#ifdef VOIDS
#include "voids.glsl"
#endif

// So close behind a hit (lattice coordinates) a value within rounding of the isovalue, HIT_ROUNDING of what went into it, is taken to be
// on the level's side: the next piece knows the crossing at a slightly different place.
const real HIT_BAND = BY_PRECISION(0.02, 1e-3lf);
const real HIT_ROUNDING = BY_PRECISION(1e-5, 2e-14lf);

struct Caster {
  Walk walk;
  int level;         // of the ray so far; LEVEL_UNKNOWN until a value told
  bool live;         // the ray has not ended
  bool need_cell;    // the current cell is done
  ivec3 cell;
  real entry, len;   // of the current cell: where the ray enters, how long it stays
  real done;         // how far of it has been looked at
  real last_hit;     // where the ray last crossed a surface; before everything until then
#ifdef BRICKS
  bool parked;       // the current cell waits for its brick
#endif
#ifdef COST
  uint evaluations;
#endif
};

Caster begin_caster(Ray ray, Walk walk) {
  Caster caster;
  caster.walk = walk;
  caster.level = LEVEL_UNKNOWN;
  caster.live = ray.begin < ray.end;
  caster.need_cell = true;
  caster.cell = caster.walk.cell;
  caster.entry = ray.begin;
  caster.len = 0.0;
  caster.done = 0.0;
  caster.last_hit = -1e30;
#ifdef BRICKS
  caster.parked = false;
#endif
#ifdef COST
  caster.evaluations = 0u;
#endif
  return caster;
}

// Where `wanted`, makes the next cell that may matter the current one, or ends the ray, or gets nearer to either. `break_at`: as for
// find_cell.
void enter_cell(Ray ray, inout Caster caster, bool wanted, uint break_at) {
#ifdef VOIDS
  real before = caster.walk.t;
#endif
  bool found = find_cell(ray, caster.walk, wanted, break_at);
  ivec3 cell = caster.walk.cell;
  real leave = exit_time(ray, cell, 1);
  real entry = caster.walk.t;
#ifdef VOIDS
  // What was passed over may have held void cells; where it did not, the first value behind it says the same again.
  caster.level = entry != before ? LEVEL_UNKNOWN : caster.level;
#endif
  caster.live = caster.live && (!wanted || found || entry < ray.end);
  caster.need_cell = caster.need_cell && !found;
  caster.cell = found ? cell : caster.cell;
  caster.entry = found ? entry : caster.entry;
  caster.len = found ? max(min(leave, ray.end) - entry, 0.0) : caster.len;
  caster.done = found ? 0.0 : caster.done;
  caster.walk.t = found ? leave : caster.walk.t;
  caster.walk.cell = found ? next_cell(ray, cell, leave) : caster.walk.cell;
}

#if SPLINE_CUTS == 0
// A cell is one piece.
real piece_end(Ray ray, SplineCell cell, rvec3 from, real len, real done) { return len; }
#else
// Where the piece that begins at `done` ends.
real piece_end(Ray ray, SplineCell cell, rvec3 from, real len, real done) {
  rvec3 cuts = spline_cuts(from, cell.sign * ray.d, len);
  real after = done + SHORTEST_PIECE;
  real end = cuts.z > after ? cuts.z : len;
  end = cuts.y > after ? cuts.y : end;
  return cuts.x > after ? cuts.x : end;
}
#endif

// A piece's Bernstein coefficients as distances to an isovalue: positive on the ray's side of it.
real[SPLINE_DEGREE + 1] distances(real b[SPLINE_DEGREE + 1], real isovalue, bool upwards, bool crossed) {
  real h[SPLINE_DEGREE + 1] = scaled_differences(b, isovalue, upwards ? -1.0 : 1.0);
#ifdef COMPOSITE
  real size = abs(b[0]);
  for (int i = 1; i <= SPLINE_DEGREE; ++i) size = max(size, abs(b[i]));
  size += abs(scaled_isovalue(0));
  real rounding = crossed ? HIT_ROUNDING * size : 0.0;
  for (int i = 0; i <= SPLINE_DEGREE; ++i) h[i] += rounding;
  // The root at 0 is known; behind it the polynomial leaves 0 as h[1] says.
  h[0] = crossed ? max(h[0], max(BY_PRECISION(1e-3, 1e-9lf) * h[1], 1e-30)) : h[0];
#endif
  return h;
}
// The isovalue itself belongs to the side above it.
bool may_cross(real h[SPLINE_DEGREE + 1], bool upwards) {
  real least = least_of(h);
  return least < 0.0 || (upwards && least == 0.0);
}
real root_of(real h[SPLINE_DEGREE + 1]) { return h[0] <= 0.0 ? 0.0 : first_root(h); }

#if ISOVALUES == 1
#define EXACT_OFFSET scaled_isovalue(0)

bool piece_may_cross(int level, real b[SPLINE_DEGREE + 1], bool crossed) {
  return may_cross(distances(b, 0.0, level == 0, crossed), level == 0);
}
real piece_root(int level, real b[SPLINE_DEGREE + 1], bool crossed, out int surface) {
  surface = 0;
  return root_of(distances(b, 0.0, level == 0, crossed));
}
#else
#define EXACT_OFFSET 0.0

bool piece_may_cross(int level, real b[SPLINE_DEGREE + 1], bool crossed) {
  int above = clamp(level, 0, parameters.cells.w - 1);
  int below = max(level - 1, 0);
  bool up = level < parameters.cells.w && may_cross(distances(b, scaled_isovalue(above), true, crossed), true);
  bool down = level > 0 && may_cross(distances(b, scaled_isovalue(below), false, crossed), false);
  return up || down;
}
// The earlier of the crossings of the next isovalue above and of the one below.
real piece_root(int level, real b[SPLINE_DEGREE + 1], bool crossed, out int surface) {
  int above = clamp(level, 0, parameters.cells.w - 1);
  int below = max(level - 1, 0);
  real up[SPLINE_DEGREE + 1] = distances(b, scaled_isovalue(above), true, crossed);
  real down[SPLINE_DEGREE + 1] = distances(b, scaled_isovalue(below), false, crossed);
  real r_up = level < parameters.cells.w && may_cross(up, true) ? root_of(up) : -1.0;
  real r_down = level > 0 && may_cross(down, false) ? root_of(down) : -1.0;
  bool take_up = r_up >= 0.0 && (r_down < 0.0 || r_up <= r_down);
  surface = take_up ? above : below;
  return take_up ? r_up : r_down;
}
#endif

// Where `wanted`, the next hit from where the caster stands; false where there is none, or none yet (the caster is live then:
// call again). `others`: whether there is work for lanes that do not seek.
bool next_hit(Ray ray, inout Caster caster, bool wanted, bool others, out Root root) {
  bool seeking = wanted && caster.live;
  real b[SPLINE_DEGREE + 1];
  for (int i = 0; i <= SPLINE_DEGREE; ++i) b[i] = 1.0;
  real start = 0.0;
  real width = 0.0;
  bool crossed = false;
  bool found = false;
  uint seekers = subgroupBallotBitCount(subgroupBallot(seeking));
  do {
    enter_cell(ray, caster, seeking && caster.need_cell, seekers / 4u);
    seeking = seeking && caster.live;
    bool looking = seeking && !caster.need_cell;
#ifdef VOIDS
    // The ray starts anew behind a void cell.
    bool passes = looking && is_void(caster.cell);
    caster.level = passes ? LEVEL_UNKNOWN : caster.level;
    caster.need_cell = caster.need_cell || passes;
    looking = looking && !passes;
#endif
#ifdef BRICKS
    if (looking && !brick_resident(caster.cell)) {
      request_brick(caster.cell);
      caster.parked = true;
    }
    looking = looking && !caster.parked;
    seeking = seeking && !caster.parked;
#endif
    SplineCell cell = spline_cell(caster.cell, ray.centre);
    rvec3 from = cell_point(cell, ray.o, ray.d, caster.entry);
    rvec3 along = cell.sign * ray.d;
    real end = piece_end(ray, cell, from, caster.len, caster.done);
    real span = end - caster.done;
    AxisOrder order = axis_order(from + (caster.done + 0.5 * span) * along);
    real piece[SPLINE_DEGREE + 1];
    spline_restrict(cell, order, from + caster.done * along, span * along, EXACT_OFFSET, piece);
#ifdef COST
    caster.evaluations += looking ? 1u : 0u;
#endif
    caster.level = looking && caster.level == LEVEL_UNKNOWN ? level_of(piece[0] + EXACT_OFFSET) : caster.level;

    // Keep the piece where a root may be; go on to the next one elsewhere.
    bool behind_hit = caster.entry + caster.done - caster.last_hit < HIT_BAND;
    found = found || (looking && piece_may_cross(caster.level, piece, behind_hit));
    for (int i = 0; i <= SPLINE_DEGREE; ++i) b[i] = looking ? piece[i] : b[i];
    start = looking ? caster.done : start;
    width = looking ? span : width;
    crossed = looking ? behind_hit : crossed;
    caster.done = looking ? end : caster.done;
    caster.need_cell = looking ? !(caster.len > end + BY_PRECISION(1e-6, 1e-14lf)) : caster.need_cell;
    caster.live = caster.live && (!looking || !caster.need_cell || caster.walk.t < ray.end);
    seeking = seeking && !found && caster.live;
  } while (keep_seeking(seeking, found, others, seekers));

  real r = piece_root(caster.level, b, crossed, root.surface);
  bool hit = found && r >= 0.0;
  real reached = hit ? start + r * width : 0.0;

  SplineCell cell = spline_cell(caster.cell, ray.centre);
  root.cell = caster.cell;
  root.t = caster.entry + reached;
  root.order = axis_order(cell_point(cell, ray.o, ray.d, caster.entry) + (start + 0.5 * width) * (cell.sign * ray.d));
#ifdef COMPOSITE
  // Go on behind the hit, in the same piece.
  caster.level += hit ? (caster.level == root.surface ? 1 : -1) : 0;
  caster.done = hit ? reached : caster.done;
  caster.need_cell = caster.need_cell && !hit;
  caster.last_hit = hit ? root.t : caster.last_hit;
  caster.live = caster.live || hit;
#endif
  return hit;
}
