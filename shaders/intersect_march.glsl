// The published way, as a baseline: samples every `step` along the ray from its entry into the domain, a change of side between two of them,
// then regula falsi (Illinois). Sheets thinner than a step are lost. Samples stand at the same places whatever is skipped.
#ifdef VOIDS
#include "voids.glsl"
#endif

struct Caster {
  Walk walk;
  int level;         // of the ray so far; LEVEL_UNKNOWN until a value told
  bool live;
  real leave;      // where the current interval ends
  real k;          // number of the next sample
  bool have;       // a sample came before it:
  real previous;   // where,
  real before;     // and its value less the offset
  bool need_interval;
#ifdef COST
  uint evaluations;
#endif
};

Caster begin_caster(Ray ray, Walk walk) {
  Caster caster;
  caster.walk = walk;
  caster.level = LEVEL_UNKNOWN;
  caster.live = ray.begin < ray.end;
  caster.leave = ray.begin;
  caster.k = 0.0;
  caster.have = false;
  caster.previous = ray.begin;
  caster.before = 0.0;
  caster.need_interval = true;
#ifdef COST
  caster.evaluations = 0u;
#endif
  return caster;
}

real sample_time(Ray ray, real k) {
  precise real t = ray.begin + k * wide(parameters.march.x, parameters.march.z);
  return min(t, ray.end);
}

// Where `wanted`, makes the next stretch that may matter the current one: a cell where cells are tested, else an interval of the structure.
void enter_interval(Ray ray, inout Caster caster, bool wanted) {
  bool found = find_cell(ray, caster.walk, wanted, 0u);
#ifdef CELL_TEST
  real leave = min(exit_time(ray, caster.walk.cell, 1), ray.end);
#elif defined(SKIP)
  real leave = min(caster.walk.until, ray.end);
#else
  real leave = ray.end;
#endif
  caster.live = caster.live && (!wanted || found);
  // From the last sample before the interval, unless it has been taken.
  real first = floor((caster.walk.t - ray.begin) / wide(parameters.march.x, parameters.march.z));
#ifdef VOIDS
  caster.have = caster.have && !(wanted && first > caster.k);  // void cells may have been passed over
#endif
  caster.k = wanted ? max(caster.k, first) : caster.k;
  caster.leave = wanted ? leave : caster.leave;
  caster.walk.t = wanted ? leave : caster.walk.t;
  ivec3 next = cell_at(ray, leave);
  caster.walk.cell = wanted ? next : caster.walk.cell;
}

#if ISOVALUES == 1
#define MARCH_OFFSET scaled_isovalue(0)
#else
#define MARCH_OFFSET 0.0
#endif

real sample_value(Ray ray, real t, real offset) { return spline_value_at(ray.o + t * ray.d, ray.centre, offset); }

// The root between a (value fa) and b (value fb, on the other side).
real refine_root(Ray ray, real a, real fa, real b, real fb, real isovalue, bool wanted, inout uint evaluations) {
  bool refining = wanted && fb != 0.0;
  for (int i = 0; i < BY_PRECISION(12, 40) && subgroupAny(refining); ++i) {
    real x = clamp(b - fb * (b - a) / (fb - fa), min(a, b), max(a, b));
    real fx = sample_value(ray, x, isovalue);
    evaluations += refining ? 1u : 0u;
    bool other_side = (fx < 0.0) != (fb < 0.0);
    real kept = other_side ? fb : 0.5 * fa;
    a = refining && other_side ? b : a;
    fa = refining ? kept : fa;
    bool close = abs(x - b) < BY_PRECISION(1e-5, 1e-12lf);
    b = refining ? x : b;
    fb = refining ? fx : fb;
    refining = refining && !close && fx != 0.0;
  }
  return b;
}

bool next_hit(Ray ray, inout Caster caster, bool wanted, bool others, out Root root) {
  bool hit = false;
  bool seeking = wanted && caster.live;
  real a = 0.0, fa = 0.0, b = 0.0, fb = 0.0;
  int surface = 0;
  uint seekers = 0u;
  do {
    enter_interval(ray, caster, seeking && caster.need_interval);
    seeking = seeking && caster.live;
    real t = sample_time(ray, caster.k);
    real f = sample_value(ray, t, MARCH_OFFSET);
#ifdef COST
    caster.evaluations += seeking ? 1u : 0u;
#endif
    int level = level_of(f + MARCH_OFFSET);
    bool pair = seeking && caster.have;
#ifdef VOIDS
    pair = pair && !void_between(ray, caster.previous, t, pair);
#endif
    caster.level = seeking && !pair ? level : caster.level;
    bool crosses = pair && level != caster.level;
    a = seeking ? caster.previous : a;
    fa = seeking ? caster.before : fa;
    b = seeking ? t : b;
    fb = seeking ? f : fb;
    surface = crosses ? (level > caster.level ? caster.level : caster.level - 1) : surface;
    hit = hit || crosses;
    // On to the next sample, unless this one is behind a hit and has to be looked at again.
    bool on = seeking && !crosses;
    caster.previous = on ? t : caster.previous;
    caster.before = on ? f : caster.before;
    caster.have = caster.have || on;
    caster.k += on ? 1.0 : 0.0;
    caster.need_interval = on ? t >= caster.leave : caster.need_interval && !seeking;
    caster.live = caster.live && (!on || t < ray.end);
    seeking = on && caster.live;
  } while (keep_seeking(seeking, hit, others, seekers));

  real isovalue = scaled_isovalue(surface);
  uint evaluations = 0u;
  real shift = MARCH_OFFSET - isovalue;
  real t = refine_root(ray, a, fa + shift, b, fb + shift, isovalue, hit, evaluations);
#ifdef COST
  caster.evaluations += evaluations;
#endif
  root.surface = surface;
  root.t = t;
  root.cell = cell_at(ray, t);
  SplineCell cell = spline_cell(root.cell, ray.centre);
  root.order = axis_order(cell_point(cell, ray.o, ray.d, t));
#ifdef COMPOSITE
  caster.level += hit ? (caster.level == surface ? 1 : -1) : 0;
  caster.previous = hit ? t : caster.previous;
  caster.before = hit ? isovalue - MARCH_OFFSET : caster.before;
  caster.need_interval = caster.need_interval && !hit;
#endif
  return hit;
}
