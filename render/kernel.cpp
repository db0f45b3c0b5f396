#include "render/kernel.h"

#include <functional>

#include "shaders/shaders.h"

namespace quincunx {
namespace {

/// A row of the table: one thing that a kernel contains or not.
struct Part {
  const char* name;
  const char* define;   ///< set where the part is compiled in; null where includes alone decide
  const char* witness;  ///< a function or buffer of the SPIR-V; null where others tell
  bool (*wanted)(const KernelVariant&);
  const char* why;      ///< of its being there
  const char* why_not;
};

bool skips(const KernelVariant& v) { return v.structure != "none"; }
bool shows_surfaces(const KernelVariant& v) { return v.surfaces && !v.stub; }
bool shows_volume(const KernelVariant& v) { return v.volume && !v.stub; }

constexpr Part kParts[] = {
    {kExactPart, nullptr, "first_root", [](const KernelVariant& v) { return shows_surfaces(v) && v.intersect == Intersect::exact; },
     "--intersect exact", "--intersect march, or there is no surface"},
    {"fixed-step march", "MARCH", "refine_root", [](const KernelVariant& v) { return shows_surfaces(v) && v.intersect == Intersect::march; },
     "--intersect march", "--intersect exact, or there is no surface"},
    {kDifferencesPart, "NORMAL_CENTRAL", "central_gradient", [](const KernelVariant& v) { return shows_surfaces(v) && v.normal == Normal::central; },
     "--normal central or samples", "--normal analytic: the gradient comes with the polynomial"},
    {"several isovalues", nullptr, "count_isovalues", [](const KernelVariant& v) { return shows_surfaces(v) && v.many_isovalues; },
     "more than one isovalue", "one isovalue at most"},
    {"compositing", "COMPOSITE", "composite", [](const KernelVariant& v) { return shows_surfaces(v) && v.composite; },
     "a surface is not opaque, a volume is in front of it, or rays wait for bricks", "every surface is opaque: the first hit ends the ray"},
    {"surfaces", "SURFACES", nullptr, shows_surfaces, "--iso", "no --iso"},
    {"direct volume rendering", "VOLUME", "integrate", shows_volume, "--tf", "no --tf"},
    {"pre-integrated classification", "PRE_INTEGRATED", "pre_integrated", [](const KernelVariant& v) { return shows_volume(v) && v.pre_integrated; },
     "--classify pre-integrated", "--classify post, or no --tf"},
    {"adaptive steps", "ADAPTIVE", "part_of", [](const KernelVariant& v) { return shows_volume(v) && v.adaptive; }, "--adaptive", "no --adaptive"},
    {"light on the volume", "LIT", "light_left", [](const KernelVariant& v) { return shows_volume(v) && v.lit; }, "--shade on", "--shade off, or no --tf"},
    {"gradient modulation", "MODULATED", "opacity_left", [](const KernelVariant& v) { return shows_volume(v) && v.modulated; }, "--modulate", "no --modulate"},
    {"jitter", "JITTER", "pixel_noise", [](const KernelVariant& v) { return shows_volume(v) && v.jitter; }, "--jitter", "no --jitter"},
    {kSkipPart, "SKIP", "skip_step", skips, "--skip names it", "--skip none: no structure is bound"},
    {"segments of rays", "RAY_SEGMENTS", "ray_number", [](const KernelVariant& v) { return !v.segments_shader.empty(); },
     "the structure lists them for each ray", "the structure lists nothing for each ray"},
    {"cell test", "CELL_TEST", "occupied", [](const KernelVariant& v) { return v.cell_test; }, "--cell-test on",
     "--cell-test off, or nothing is skipped"},
    {"void cells", "VOIDS", "is_void", [](const KernelVariant& v) { return v.voids && !v.stub; }, "--nan empty, and samples are not finite",
     "every sample is finite, or --nan is not empty"},
    {"brick pool", "BRICKS", "brick_resident", [](const KernelVariant& v) { return v.bricks && !v.stub; }, "--pool", "all coefficients are on the device: no page table"},
    {"unit of each brick", "BRICK_UNITS", "in_unit", [](const KernelVariant& v) { return v.bricks && v.brick_units && !v.stub; },
     "--storage of 16 or 8 bits with --pool", "--storage float32, or all coefficients are on the device in one unit"},
    {"64-bit floats", "DOUBLE", "wide", [](const KernelVariant& v) { return v.precision == Precision::float64; }, "--precision double", "--precision float"},
    {"cost channels", "COST", "write_cost", [](const KernelVariant& v) { return v.cost; }, "costs were asked for", "no costs were asked for"},
    {"traversal alone", nullptr, "traverse", [](const KernelVariant& v) { return v.stub; }, "--stub-sampling", "samples are evaluated"},
    {"several coefficient buffers", nullptr, "coefficients1", [](const KernelVariant& v) { return !v.stub && v.coefficient_buffers > 1; },
     "the coefficients pass the device's limit for one buffer", "the coefficients fit one buffer"},
};

const char* file_of(Pass pass) {
  switch (pass) {
    case Pass::segments: return "segments.comp";
    case Pass::enter: return "enter.comp";
    case Pass::trace: return "trace.comp";
    case Pass::seek: return "seek.comp";
    case Pass::shade: return "shade.comp";
    case Pass::volume: return "volume.comp";
    case Pass::traverse: return "traverse.comp";
  }
  return "";
}

/// What comes once rays have their segments, where the structure lists any.
std::vector<Pass> ray_passes(const KernelVariant& variant) {
  if (variant.stub) return {Pass::enter, Pass::traverse};
  if (!variant.surfaces) return {Pass::enter, Pass::volume};
  if (variant.intersect == Intersect::exact && !variant.composite) return {Pass::enter, Pass::seek, Pass::shade};
  return {Pass::enter, Pass::trace};
}

}  // namespace

void set_structure(KernelVariant& variant, const SkippingStructure& structure) {
  const std::optional<SegmentPass> segments = structure.segment_pass();
  variant.structure = structure.name();
  variant.structure_shader = structure.shader();
  variant.segments_shader = segments ? segments->shader : "";
}

std::vector<Pass> passes(const KernelVariant& variant) {
  std::vector<Pass> all = ray_passes(variant);
  if (!variant.segments_shader.empty()) all.insert(all.begin(), Pass::segments);
  return all;
}

gpu::KernelSource kernel_source(const KernelVariant& variant, Pass pass) {
  gpu::KernelSource source;
  source.file = file_of(pass);
  for (const Part& part : kParts)
    if (part.define && part.wanted(variant)) source.defines.emplace_back(part.define, "1");
  source.defines.emplace_back("ISOVALUES", variant.many_isovalues ? "2" : "1");
  source.defines.emplace_back("RANGES", variant.many_isovalues || variant.volume ? "2" : "1");
  source.defines.emplace_back("COEFFICIENT_BUFFERS", std::to_string(variant.coefficient_buffers));
  source.defines.emplace_back("COEFFICIENT_SHIFT", std::to_string(variant.coefficient_shift));
  return source;
}

gpu::ShaderFiles kernel_files(const KernelVariant& variant) {
  return [variant](std::string_view name) -> std::string_view {
    if (name == "structure.glsl") return shader_file(variant.structure_shader);
    if (name == "segments.glsl") return shader_file(variant.segments_shader);
    if (name == "spline.glsl") return shader_file(variant.spline_shader);
    if (name == "intersect.glsl")
      return shader_file(variant.intersect == Intersect::exact ? "intersect_exact.glsl" : "intersect_march.glsl");
    return shader_file(name);
  };
}

std::vector<KernelPart> kernel_parts(const KernelVariant& variant) {
  std::vector<KernelPart> parts;
  for (const Part& part : kParts) {
    if (!part.witness) continue;
    const bool wanted = part.wanted(variant);
    parts.push_back({{part.name, wanted, wanted ? part.why : part.why_not}, part.witness});
  }
  return parts;
}

}  // namespace quincunx
