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
  std::set<KernelVariant> seen;  // labels may share a shader
  for (const std::string_view label : skip_labels())
    for (int bits = 0; bits < 256; ++bits) {
      KernelVariant v;
      const std::unique_ptr<SkippingStructure> structure = make_structure(labelled_skip(label));
      set_structure(v, *structure);
      v.cell_test = bits & 1;
      v.intersect = bits & 2 ? Intersect::march : Intersect::exact;
      v.normal = bits & 4 ? Normal::central : Normal::analytic;
      v.many_isovalues = bits & 8;
      v.composite = bits & 16;
      v.cost = bits & 32;
      v.coefficient_buffers = bits & 64 ? 8 : 1;
      v.coefficient_shift = bits & 64 ? 4 : 0;
      v.stub = bits & 128;
      const bool several_buffers_once = bits & 64 && (bits & 56);  // independent of surfaces and costs
      const bool stub_once = v.stub && (bits & 126) != 32;         // evaluates nothing: all that is left is the cost
      if ((v.cell_test && v.structure == "none") || several_buffers_once || stub_once) continue;
      if (seen.insert(v).second) variants.push_back(v);
    }
  return variants;
}

/// Those of volumes: every way to classify, alone and together with surfaces, with one structure; and one way with each.
std::vector<KernelVariant> volume_variants() {
  std::vector<KernelVariant> variants;
  std::set<KernelVariant> seen;
  for (const std::string_view label : skip_labels())
    for (int bits = 0; bits < 512; ++bits) {
      KernelVariant v;
      const std::unique_ptr<SkippingStructure> structure = make_structure(labelled_skip(label));
      set_structure(v, *structure);
      v.volume = true;
      v.pre_integrated = bits & 1;
      v.adaptive = bits & 2;
      v.lit = bits & 4;
      v.modulated = bits & 8;
      v.jitter = bits & 16;
      v.cost = bits & 32;
      v.cell_test = bits & 64;
      v.surfaces = v.composite = bits & 128;
      v.intersect = bits & 256 ? Intersect::march : Intersect::exact;
      const bool two_classify = v.pre_integrated && v.adaptive, march_nothing = bits & 256 && !v.surfaces;
      // Of 32 ways to look at a volume, the surfaces see three; jitter and light are independent of the other structures.
      const bool independent = (v.surfaces && bits & 28 && (bits & 28) != 28) || (v.jitter && !v.lit) || (v.cost && !v.lit);
      const bool one_with_each = v.structure != "grid" && (bits & 60) != 60;
      if (two_classify || march_nothing || independent || one_with_each || (v.cell_test && v.structure == "none")) continue;
      if (seen.insert(v).second) variants.push_back(v);
    }
  KernelVariant stub;
  stub.volume = stub.lit = stub.stub = stub.cost = true;
  stub.surfaces = false;
  variants.push_back(stub);
  return variants;
}

/// Those with void cells: every way to look, with a structure that asks about them, with one that does not and with none.
std::vector<KernelVariant> void_variants() {
  std::vector<KernelVariant> variants;
  for (const char* label : {"none", "grid", "octree"})
    for (int bits = 0; bits < 256; ++bits) {
      KernelVariant v;
      const std::unique_ptr<SkippingStructure> structure = make_structure(labelled_skip(label));
      set_structure(v, *structure);
      v.voids = true;
      v.cell_test = bits & 1;
      v.intersect = bits & 2 ? Intersect::march : Intersect::exact;
      v.surfaces = bits & 4;
      v.volume = bits & 8;
      v.composite = v.surfaces && (v.volume || bits & 16);
      v.many_isovalues = v.surfaces && bits & 16;
      v.pre_integrated = bits & 32;
      v.adaptive = bits & 64;
      v.stub = v.cost = bits & 128;
      const bool nothing = !v.surfaces && !v.volume, of_nothing = (!v.surfaces && bits & 18) || (!v.volume && bits & 96);
      if (nothing || of_nothing || (v.pre_integrated && v.adaptive) || (v.cell_test && v.structure == "none") || (v.stub && bits & 98)) continue;
      variants.push_back(v);
    }
  return variants;
}

/// Those of a brick pool, its bricks in one unit and in one each: surfaces and volumes of every spline.
std::vector<KernelVariant> brick_variants() {
  std::vector<KernelVariant> variants;
  for (const char* spline : {"bcc7.glsl", "trilinear.glsl", "tricubic.glsl"})
    for (int bits = 1; bits < 16; ++bits) {
      KernelVariant v;
      v.spline_shader = spline;
      v.structure = "grid";
      v.structure_shader = "skip_grid.glsl";
      v.bricks = true;
      v.surfaces = v.composite = bits & 1;
      v.volume = v.lit = bits & 2;
      v.brick_units = bits & 4;
      v.coefficient_buffers = bits & 8 ? 3 : 1;
      v.coefficient_shift = bits & 8 ? 9 : 0;
      if (v.surfaces || v.volume) variants.push_back(v);
    }
  return variants;
}

/// Every fifth of `variants` in 64-bit floats, of each spline in turns.
std::vector<KernelVariant> in_doubles(const std::vector<KernelVariant>& variants) {
  const std::string shaders[] = {"bcc7.glsl", "bcc4.glsl", "bcc8.glsl", "bcc12.glsl", "trilinear.glsl", "triquadratic.glsl", "tricubic.glsl", "catmull-rom.glsl"};
  std::vector<KernelVariant> doubles;
  for (std::size_t n = 0; n < variants.size(); n += 5) {
    doubles.push_back(variants[n]);
    doubles.back().precision = Precision::float64;
    doubles.back().spline_shader = shaders[n / 5 % std::size(shaders)];
  }
  return doubles;
}

/// Every seventh of those of `variants` that find no first roots, of a spline that has none.
std::vector<KernelVariant> of_smooth_pieces(const std::vector<KernelVariant>& variants) {
  std::vector<KernelVariant> smooth;
  std::size_t n = 0;
  for (const KernelVariant& v : variants) {
    if ((v.surfaces && !v.stub && v.intersect == Intersect::exact) || ++n % 7 != 0) continue;
    smooth.push_back(v);
    smooth.back().spline_shader = "cwlb.glsl";
    smooth.back().precision = smooth.size() % 2 ? Precision::float32 : Precision::float64;
  }
  return smooth;
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

/// The structure of a variant, in a form that has its shader.
std::unique_ptr<SkippingStructure> structure_of(const KernelVariant& v) {
  for (const std::string_view label : skip_labels()) {
    std::unique_ptr<SkippingStructure> structure = make_structure(labelled_skip(label));
    if (structure->name() == v.structure && structure->shader() == v.structure_shader) return structure;
  }
  throw std::logic_error("no structure has the shader " + v.structure_shader);
}

/// The names of the buffers that the structure of a variant hands out for a few blocks.
std::set<std::string> buffers_of(const KernelVariant& v) {
  const std::unique_ptr<SkippingStructure> structure = structure_of(v);
  CellBounds cells;
  cells.cells = glm::i64vec3(2);
  cells.min.assign(8, 0), cells.max.assign(8, 65535);
  const BlockBounds blocks = block_bounds(cells, 1);
  const std::vector<double> isovalues{0.5};
  structure->prepare(blocks);
  structure->build(classify(blocks, cells, ranges_of(isovalues)), Thresholds(cells, ranges_of(isovalues)));
  std::set<std::string> names;
  for (const StructureBuffer& buffer : structure->buffers()) names.insert(buffer.name);
  return names;
}

std::vector<KernelVariant> every_variant() {
  std::vector<KernelVariant> variants = all_variants();
  for (const std::vector<KernelVariant>& more : {volume_variants(), void_variants()}) variants.insert(variants.end(), more.begin(), more.end());
  const std::vector<KernelVariant> of_doubles = in_doubles(variants), smooth = of_smooth_pieces(variants), of_bricks = brick_variants();
  for (const auto* more : {&of_doubles, &smooth, &of_bricks}) variants.insert(variants.end(), more->begin(), more->end());
  return variants;
}

/// The kernel compiles and has and binds what its variant asks for, and nothing else.
void expect_explained(const KernelVariant& v) {
  SCOPED_TRACE(describe(v));
  std::set<std::string> names, bound;
  for (const Pass pass : passes(v)) {
    const std::vector<std::uint32_t> spirv = gpu::compile(kernel_files(v), kernel_source(v, pass));
    names.merge(names_in(spirv));
    for (const gpu::Binding& b : gpu::reflect(spirv).bindings) bound.insert(b.name);
  }
  for (const KernelPart& part : kernel_parts(v)) {
    EXPECT_EQ(names.count(part.witness) == 1, part.feature.compiled) << part.feature.name << ": " << part.witness;
    EXPECT_FALSE(part.feature.why.empty());
  }
  std::set<std::string> expected{"uniforms", "Color", "Hit", "Rays"};
  expected.merge(buffers_of(v));
  if (!v.segments_shader.empty()) expected.insert({"RaySegments", "raySegments", "SegmentCounts"});
  if (v.surfaces && !v.stub) expected.insert("Isosurfaces");
  if (v.volume && !v.stub) expected.insert("transferTable");
  if (v.cell_test) expected.insert("occupancy");
  if (v.voids && !v.stub) expected.insert("voids");
  if (v.cost) expected.insert("Cost");
  if (v.bricks) expected.insert({"pageTable", "Requests", "Parked"});
  if (v.brick_units) expected.insert("brickUnits");
  for (int i = 0; i < v.coefficient_buffers && !v.stub; ++i) expected.insert("coefficients" + std::to_string(i));
  EXPECT_EQ(bound, expected);
}

TEST(Kernel, EveryVariantCompilesAndContainsExactlyWhatIsExplainedAndBindsNothingElse) {
  for (const KernelVariant& v : every_variant()) expect_explained(v);
}

TEST(Kernel, ReadsItsParametersWhereCppPutsThem) {
  const auto offsets_in = [](Precision precision) {
    KernelVariant v;
    v.precision = precision;
    const gpu::Reflection reflection = gpu::reflect(gpu::compile(kernel_files(v), kernel_source(v, Pass::seek)));
    std::map<std::string, std::size_t> offsets;
    for (const gpu::BlockMember& m : reflection.members)
      if (m.block == "uniforms") offsets[m.name] = m.offset;
    return offsets;
  };
#define MEMBER(name) {"all." #name, offsetof(TraceParameters, name)}
  std::map<std::string, std::size_t> expected{
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
      MEMBER(bricks),
      MEMBER(structure),
      MEMBER(sampling),
      MEMBER(transfer),
      MEMBER(modulation),
      MEMBER(pages)};
  EXPECT_EQ(offsets_in(Precision::float32), expected);
  expected.insert({MEMBER(world_forward_lo), MEMBER(world_right_lo), MEMBER(world_up_lo), MEMBER(normal_x_lo), MEMBER(normal_y_lo), MEMBER(normal_z_lo)});
  EXPECT_EQ(offsets_in(Precision::float64), expected);
#undef MEMBER
}

}  // namespace
}  // namespace quincunx
