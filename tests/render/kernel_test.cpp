// Every variant the table allows compiles, and contains what --explain says: no more, no less.
#include "render/kernel.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <set>

#include "accel/structure.h"
#include "render/trace_frame.h"

namespace quincunx {
namespace {

std::vector<KernelVariant> all_variants() {
  std::vector<KernelVariant> variants;
  for (const std::string_view name : structure_names())
    for (int bits = 0; bits < 128; ++bits) {
      KernelVariant v;
      const std::unique_ptr<SkippingStructure> structure = make_structure(name);
      v.structure = name;
      v.structure_shader = structure->shader();
      v.cell_test = bits & 1;
      v.intersect = bits & 2 ? Intersect::march : Intersect::exact;
      v.normal = bits & 4 ? Normal::central : Normal::analytic;
      v.many_isovalues = bits & 8;
      v.composite = bits & 16;
      v.cost = bits & 32;
      v.coefficient_buffers = bits & 64 ? 8 : 1;
      v.coefficient_shift = bits & 64 ? 4 : 0;
      const bool several_buffers_once = bits & 64 && (bits & 56);  // independent of surfaces and costs
      if ((v.cell_test && name == "none") || several_buffers_once) continue;
      variants.push_back(v);
    }
  return variants;
}

std::string describe(const KernelVariant& v) {
  std::string text = v.structure;
  for (const KernelPart& part : kernel_parts(v)) text += (part.feature.compiled ? ", " : ", no ") + part.feature.name;
  return text;
}

/// What OpName (instruction 5) names in a SPIR-V module; functions without their mangled parameters.
std::set<std::string> names_in(std::span<const std::uint32_t> spirv) {
  std::set<std::string> names;
  for (std::size_t i = 5; i < spirv.size(); i += spirv[i] >> 16) {
    if ((spirv[i] & 0xffff) != 5) continue;
    const std::string name = reinterpret_cast<const char*>(&spirv[i + 2]);
    names.insert(name.substr(0, name.find('(')));
  }
  return names;
}

TEST(Kernel, EveryVariantCompilesAndContainsExactlyWhatIsExplainedAndBindsNothingElse) {
  for (const KernelVariant& v : all_variants()) {
    SCOPED_TRACE(describe(v));
    std::set<std::string> names, bound;
    for (const Pass pass : {Pass::enter, Pass::trace}) {
      const std::vector<std::uint32_t> spirv = gpu::compile(kernel_files(v), kernel_source(v, pass));
      names.merge(names_in(spirv));
      for (const gpu::Binding& b : gpu::reflect(spirv).bindings) bound.insert(b.name);
    }
    for (const KernelPart& part : kernel_parts(v)) {
      EXPECT_EQ(names.count(part.witness) == 1, part.feature.compiled) << part.feature.name << ": " << part.witness;
      EXPECT_FALSE(part.feature.why.empty());
    }
    std::set<std::string> expected{"parameters", "Isosurfaces", "Color", "Hit", "Rays"};
    if (v.structure == "grid") expected.insert("gridLevel");
    if (v.cell_test) expected.insert("occupancy");
    if (v.cost) expected.insert("Cost");
    for (int i = 0; i < v.coefficient_buffers; ++i) expected.insert("coefficients" + std::to_string(i));
    EXPECT_EQ(bound, expected);
  }
}

TEST(Kernel, ReadsItsParametersWhereCppPutsThem) {
  const KernelVariant v;
  const gpu::Reflection reflection = gpu::reflect(gpu::compile(kernel_files(v), kernel_source(v, Pass::trace)));
  std::map<std::string, std::size_t> offsets;
  for (const gpu::BlockMember& m : reflection.members)
    if (m.block == "parameters" || m.block == "TraceParameters") offsets[m.name] = m.offset;
#define MEMBER(name) {#name, offsetof(TraceParameters, name)}
  const std::map<std::string, std::size_t> expected{
      MEMBER(forward_hi),
      MEMBER(forward_lo),
      MEMBER(right_hi),
      MEMBER(right_lo),
      MEMBER(up_hi),
      MEMBER(up_lo),
      MEMBER(base_hi),
      MEMBER(base_lo),
      MEMBER(base_right_hi),
      MEMBER(base_right_lo),
      MEMBER(base_up_hi),
      MEMBER(base_up_lo),
      MEMBER(tangent),
      MEMBER(world_forward),
      MEMBER(world_right),
      MEMBER(world_up),
      MEMBER(normal_x),
      MEMBER(normal_y),
      MEMBER(normal_z),
      MEMBER(background),
      MEMBER(march),
      MEMBER(cells),
      MEMBER(strides),
      MEMBER(picture),
      MEMBER(blocks),
      MEMBER(bricks)};
#undef MEMBER
  EXPECT_EQ(offsets, expected);
}

}  // namespace
}  // namespace quincunx
