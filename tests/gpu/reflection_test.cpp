#include "tests/gpu/test_device.h"

namespace quincunx::gpu {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;
using ::testing::UnorderedElementsAre;

std::vector<std::uint32_t> compiled(const std::string& glsl) {
  const Files files{{{"test.comp", "#version 460\n" + glsl}}};
  return compile(files.lookup(), {"test.comp", {}});
}

Reflection reflected(const std::string& glsl) { return reflect(compiled(glsl)); }

std::string reflection_error(const std::string& glsl) {
  try {
    reflected(glsl);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

auto is_binding(const std::string& name, std::uint32_t number, VkDescriptorType type) {
  return AllOf(Field(&Binding::name, name), Field(&Binding::binding, number), Field(&Binding::type, type));
}

auto is_member(const std::string& block, const std::string& name, std::uint32_t offset) {
  return AllOf(Field(&BlockMember::block, block), Field(&BlockMember::name, name), Field(&BlockMember::offset, offset));
}

TEST(Reflection, FindsTheBindingsThatAreUsedAndNoOthers) {
  const Reflection reflection = reflected(R"(
    layout(local_size_x = 1) in;
    layout(binding = 7) buffer Out { float o[]; } result;
    layout(binding = 2) uniform samplerBuffer samples;
    layout(binding = 5) uniform Frame { vec4 eye; float scale; };
    layout(binding = 4) buffer Spare { float s[]; } spare;
    layout(binding = 3) uniform samplerBuffer spare_samples;
    void main() { result.o[0] = texelFetch(samples, 1).x * scale; })");
  EXPECT_THAT(reflection.bindings, ElementsAre(is_binding("samples", 2, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER),
                                               is_binding("Frame", 5, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER),
                                               is_binding("result", 7, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER)));
  EXPECT_EQ(reflection.bindings[1].struct_bytes, 20u);
  EXPECT_EQ(reflection.push_constant_bytes, 0u);
}

TEST(Reflection, GivesOffsetsOfMembersAndOfTheirMembers) {
  const Reflection reflection = reflected(R"(
    layout(local_size_x = 1) in;
    struct Camera { vec3 eye; float fov; mat3 basis; };
    layout(binding = 0, std140) uniform Frame { vec2 size; Camera camera; Camera more[2]; float last; } frame;
    struct Node { uint first; float low; };
    layout(binding = 1, std430) buffer Nodes { uint count; Node node[]; } nodes;
    layout(push_constant) uniform Push { float time; layout(offset = 16) vec4 tint; } push;
    void main() { nodes.node[1].low = frame.last + push.tint.x; })");
  // std140: a struct starts at and fills multiples of 16; a mat3 is three vec4.
  EXPECT_THAT(reflection.members,
              UnorderedElementsAre(is_member("frame", "size", 0), is_member("frame", "camera.eye", 16),
                                   is_member("frame", "camera.fov", 28), is_member("frame", "camera.basis", 32),
                                   is_member("frame", "more[0].eye", 80), is_member("frame", "more[0].fov", 92),
                                   is_member("frame", "more[0].basis", 96), is_member("frame", "last", 208),
                                   is_member("nodes", "count", 0), is_member("nodes", "node[0].first", 4),
                                   is_member("nodes", "node[0].low", 8), is_member("push", "time", 0),
                                   is_member("push", "tint", 16)));
  EXPECT_EQ(reflection.push_constant_bytes, 32u);
}

TEST(Reflection, AddsUpOffsetsThroughEveryLevel) {
  const Reflection reflection = reflected(R"(
    layout(local_size_x = 1) in;
    struct Lens { float focus; float width; };
    struct Camera { vec4 eye; Lens lens; };
    layout(binding = 0, std430) buffer Frame { vec4 size; Camera camera; } frame;
    void main() { frame.camera.lens.width = 1.0; })");
  EXPECT_THAT(reflection.members, ::testing::Contains(is_member("frame", "camera.lens.width", 36)));  // 16 + 16 + 4
}

TEST(Reflection, NamesSpecializationConstantsAndTheWorkGroup) {
  const Reflection reflection = reflected(R"(
    layout(local_size_x_id = 3, local_size_y = 4) in;
    layout(constant_id = 0) const int kSteps = 8;
    layout(constant_id = 9) const float kScale = 0.5;
    layout(binding = 0) buffer Out { float o[]; } result;
    void main() { for (int i = 0; i < kSteps; ++i) result.o[i] = kScale; })");
  EXPECT_THAT(reflection.specialization, ::testing::IsSupersetOf({Pair("kSteps", 0u), Pair("kScale", 9u)}));
  EXPECT_THAT(reflection.local_size, ElementsAre(1u, 4u, 1u));
  EXPECT_THAT(reflection.local_size_ids, ElementsAre(3u, UINT32_MAX, UINT32_MAX));
}

TEST(Reflection, OfAKernelThatUsesNothingIsEmpty) {
  const Reflection reflection = reflected("layout(local_size_x = 8, local_size_y = 4) in; void main() {}");
  EXPECT_THAT(reflection.bindings, IsEmpty());
  EXPECT_THAT(reflection.members, IsEmpty());
  EXPECT_THAT(reflection.local_size, ElementsAre(8u, 4u, 1u));
}

TEST(Reflection, RefusesWhatIsNotOfferedByName) {
  EXPECT_THAT(
      reflection_error(
          "layout(set = 1, binding = 0) buffer Out { float o[]; } elsewhere; void main() { elsewhere.o[0] = 1.0; }"),
      AllOf(HasSubstr("elsewhere"), HasSubstr("set 1")));
  EXPECT_THAT(
      reflection_error("layout(binding = 0) buffer Out { float o[]; } several[2]; void main() { several[0].o[0] = 1.0; }"),
      AllOf(HasSubstr("several"), HasSubstr("array")));
  EXPECT_THAT(
      reflection_error(
          "layout(binding = 0, r32f) uniform image2D picture; void main() { imageStore(picture, ivec2(0), vec4(1)); }"),
      HasSubstr("picture"));
  EXPECT_THAT(reflection_error("layout(binding = 0) buffer A { float o[]; } a; layout(binding = 0) buffer B { uint o[]; } b;"
                       "void main() { a.o[0] = 1.0; b.o[1] = 1; }"),
              AllOf(HasSubstr("'a'"), HasSubstr("'b'"), HasSubstr("binding 0")));
}

TEST(Reflection, RefusesWordsThatAreNoKernelAtEveryLength) {
  const auto spirv = compiled(
      "layout(local_size_x = 1) in; layout(binding = 0) buffer O { float o[]; } r; void main() { r.o[0] = 1.0; }");
  EXPECT_THROW(reflect({}), std::runtime_error);
  EXPECT_THROW(reflect(std::vector<std::uint32_t>(100, 0)), std::runtime_error);
  EXPECT_THROW(reflect(std::span(spirv).first(5)), std::runtime_error);
}

}  // namespace
}  // namespace quincunx::gpu
