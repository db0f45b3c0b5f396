#include "render/kernel.h"

#include <functional>

#include "shaders/shaders.h"

namespace quincunx {
namespace {

/// A row of the table: one thing that a kernel contains or not.
struct Part {
  const char* name;
  const char* define;   ///< set where the part is compiled in; null where includes alone decide
  const char* witness;  ///< a function or buffer of the SPIR-V
  bool (*wanted)(const KernelVariant&);
  const char* why;      ///< of its being there
  const char* why_not;
};

bool skips(const KernelVariant& v) { return v.structure != "none"; }

constexpr Part kParts[] = {
    {"exact intersection", nullptr, "first_root", [](const KernelVariant& v) { return !v.stub && v.intersect == Intersect::exact; },
     "--intersect exact", "--intersect march, or nothing is evaluated"},
    {"fixed-step march", "MARCH", "refine_root", [](const KernelVariant& v) { return !v.stub && v.intersect == Intersect::march; },
     "--intersect march", "--intersect exact, or nothing is evaluated"},
    {"central differences", "NORMAL_CENTRAL", "central_gradient", [](const KernelVariant& v) { return !v.stub && v.normal == Normal::central; },
     "--normal central", "--normal analytic: the gradient comes with the polynomial"},
    {"several isovalues", nullptr, "count_isovalues", [](const KernelVariant& v) { return !v.stub && v.many_isovalues; },
     "more than one isovalue", "one isovalue"},
    {"compositing", "COMPOSITE", "composite", [](const KernelVariant& v) { return !v.stub && v.composite; },
     "a surface is not opaque", "every surface is opaque: the first hit ends the ray"},
    {kSkipPart, "SKIP", "skip_step", skips, "--skip names it", "--skip none: no structure is bound"},
    {"cell test", "CELL_TEST", "occupied", [](const KernelVariant& v) { return v.cell_test; }, "--cell-test on",
     "--cell-test off, or nothing is skipped"},
    {"cost channels", "COST", "write_cost", [](const KernelVariant& v) { return v.cost; }, "costs were asked for", "no costs were asked for"},
    {"traversal alone", nullptr, "traverse", [](const KernelVariant& v) { return v.stub; }, "--stub-sampling", "samples are evaluated"},
    {"several coefficient buffers", nullptr, "coefficients1", [](const KernelVariant& v) { return !v.stub && v.coefficient_buffers > 1; },
     "the coefficients pass the device's limit for one buffer", "the coefficients fit one buffer"},
};

const char* file_of(Pass pass) {
  switch (pass) {
    case Pass::enter: return "enter.comp";
    case Pass::trace: return "trace.comp";
    case Pass::seek: return "seek.comp";
    case Pass::shade: return "shade.comp";
    case Pass::traverse: return "traverse.comp";
  }
  return "";
}

}  // namespace

std::vector<Pass> passes(const KernelVariant& variant) {
  if (variant.stub) return {Pass::enter, Pass::traverse};
  if (variant.intersect == Intersect::exact && !variant.composite) return {Pass::enter, Pass::seek, Pass::shade};
  return {Pass::enter, Pass::trace};
}

gpu::KernelSource kernel_source(const KernelVariant& variant, Pass pass) {
  gpu::KernelSource source;
  source.file = file_of(pass);
  for (const Part& part : kParts)
    if (part.define && part.wanted(variant)) source.defines.emplace_back(part.define, "1");
  source.defines.emplace_back("ISOVALUES", variant.many_isovalues ? "2" : "1");
  source.defines.emplace_back("COEFFICIENT_BUFFERS", std::to_string(variant.coefficient_buffers));
  source.defines.emplace_back("COEFFICIENT_SHIFT", std::to_string(variant.coefficient_shift));
  return source;
}

gpu::ShaderFiles kernel_files(const KernelVariant& variant) {
  return [variant](std::string_view name) -> std::string_view {
    if (name == "structure.glsl") return shader_file(variant.structure_shader);
    if (name == "spline.glsl") return shader_file(variant.spline_shader);
    if (name == "intersect.glsl")
      return shader_file(variant.intersect == Intersect::exact ? "intersect_exact.glsl" : "intersect_march.glsl");
    return shader_file(name);
  };
}

std::vector<KernelPart> kernel_parts(const KernelVariant& variant) {
  std::vector<KernelPart> parts;
  for (const Part& part : kParts) {
    const bool wanted = part.wanted(variant);
    parts.push_back({{part.name, wanted, wanted ? part.why : part.why_not}, part.witness});
  }
  return parts;
}

}  // namespace quincunx
