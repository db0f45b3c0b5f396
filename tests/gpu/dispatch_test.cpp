#include <bit>
#include <numeric>

#include "tests/gpu/test_device.h"

namespace quincunx::gpu {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const char* const kDouble = R"(#version 460
layout(local_size_x = 64) in;
layout(binding = 0) readonly buffer In { uint v[]; } source;
layout(binding = 1) buffer Out { uint v[]; } result;
layout(push_constant) uniform Push { uint count; uint added; } push;
void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i < push.count) result.v[i] = 2u * source.v[i] + push.added;
})";

template <class Function>
std::string dispatch_error(Function&& function) {
  try {
    function();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

// Only as an argument: the bytes live as long as the vector.
std::span<const std::byte> push_bytes(const std::vector<std::uint32_t>& push) { return bytes_of(push); }

class DispatchTest : public GpuTest, public ::testing::WithParamInterface<Transfer> {
 protected:
  void SetUp() override { open(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(BothWays, DispatchTest, ::testing::Values(Transfer::automatic, Transfer::staged),
                         [](const auto& way) { return way.param == Transfer::staged ? "Staged" : "Automatic"; });

TEST_P(DispatchTest, ComputesWhatTheHostComputes) {
  const Pipeline pipeline = make(kDouble);
  std::vector<std::uint32_t> values(100001);
  std::iota(values.begin(), values.end(), 17u);
  const Buffer source = filled(values),
               result = create_buffer(*device, 4 * values.size(), BufferUse::storage, "result");
  // Twice, the second from the first one's result: what a dispatch wrote is there for the next.
  const auto count = static_cast<std::uint32_t>(values.size());
  dispatch(*device, pipeline, {{"source", source}, {"result", result}}, push_bytes({count, 3}), (count + 63) / 64);
  dispatch(*device, pipeline, {{"result", source}, {"source", result}}, push_bytes({count, 1}), (count + 63) / 64);
  for (std::uint32_t& value : values) value = 2 * (2 * value + 3) + 1;
  EXPECT_TRUE(contents<std::uint32_t>(source) == values);
}

TEST_P(DispatchTest, TakesTimeAndMoreForMore) {
  const Pipeline pipeline = make(R"(#version 460
    layout(local_size_x = 64) in;
    layout(binding = 0) buffer Out { float v[]; } result;
    layout(push_constant) uniform Push { uint rounds; } push;
    void main() {
      float x = float(gl_GlobalInvocationID.x);
      for (uint i = 0; i < push.rounds; ++i) x = x * 0.999 + 1.0;
      result.v[gl_GlobalInvocationID.x] = x;
    })");
  const Buffer result = create_buffer(*device, 4 * 64 * 64, BufferUse::storage, "result");
  const double some = dispatch(*device, pipeline, {{"result", result}}, push_bytes({100}), 64);
  const double many = dispatch(*device, pipeline, {{"result", result}}, push_bytes({100000}), 64);
  EXPECT_GT(some, 0.0);
  EXPECT_GT(many, some);
  EXPECT_LT(many, 60000.0);  // milliseconds, not another unit
}

TEST_F(GpuTest, TexelBuffersAndUniformBlocksAreRead) {
  const Pipeline pipeline = make(R"(#version 460
    layout(local_size_x = 4) in;
    layout(binding = 0) uniform samplerBuffer samples;
    layout(binding = 1) uniform usamplerBuffer bits;
    layout(binding = 2) uniform Frame { vec4 unused; float scale; } frame;
    layout(binding = 3) buffer Out { float v[]; } result;
    void main() {
      int i = int(gl_LocalInvocationIndex);
      float scaled = texelFetch(samples, 3 - i).x * frame.scale;
      result.v[i] = scaled + float(texelFetch(bits, i).y) + float(textureSize(samples));
    })");
  const Buffer samples =
      filled(std::vector<std::uint16_t>{0, 65535, 0, 65535, 1}, BufferUse::texel, VK_FORMAT_R16_UNORM);
  const Buffer bits =
      filled(std::vector<std::uint32_t>{1, 10, 2, 20, 3, 30, 4, 40}, BufferUse::texel, VK_FORMAT_R32G32_UINT);
  const Buffer frame = filled(std::vector<float>{0, 0, 0, 0, 100.0f}, BufferUse::uniform);
  const Buffer result = create_buffer(*device, 16, BufferUse::storage, "result");
  dispatch(*device, pipeline, {{"samples", samples}, {"bits", bits}, {"frame", frame}, {"result", result}}, {}, 1);
  EXPECT_THAT(contents<float>(result), ElementsAre(115.0f, 25.0f, 135.0f, 45.0f));
}

TEST_F(GpuTest, AddressesReachWhatNoBindingDoes) {
  open();
  if (!features(*device).buffer_address) GTEST_SKIP() << "no device addresses";
  const Pipeline pipeline = make(R"(#version 460
    #extension GL_EXT_buffer_reference : require
    layout(local_size_x = 1) in;
    layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer Floats { float v[]; };
    layout(binding = 0) buffer Out { float v[]; } result;
    layout(push_constant) uniform Push { Floats floats; } push;
    void main() { result.v[0] = push.floats.v[2]; })");
  EXPECT_THAT(pipeline.reflection.members, ::testing::SizeIs(2));
  const Buffer floats = create_buffer(*device, 12, BufferUse::address, "floats");
  upload(*device, floats, bytes_of(std::vector<float>{1.0f, 2.0f, 3.5f}));
  const Buffer result = create_buffer(*device, 4, BufferUse::storage, "result");
  dispatch(*device, pipeline, {{"result", result}}, std::as_bytes(std::span(&floats.address, 1)), 1);
  EXPECT_THAT(contents<float>(result), ElementsAre(3.5f));
}

TEST_F(GpuTest, SpecializationConstantsAreSetByNameAndKeepTheirDefaults) {
  const std::string glsl = R"(#version 460
    layout(local_size_x = 2, local_size_x_id = 7) in;
    layout(constant_id = 7) const uint kLanes = 2;
    layout(constant_id = 4) const int kSteps = 3;
    layout(constant_id = 5) const float kScale = 0.5;
    layout(binding = 0) buffer Out { float v[]; } result;
    void main() { result.v[gl_GlobalInvocationID.x] = float(kSteps) * kScale; })";
  const auto run = [&](const Pipeline& pipeline) {
    const Buffer result = create_buffer(*device, 4 * 8, BufferUse::storage, "result");
    dispatch(*device, pipeline, {{"result", result}}, {}, 1);
    return contents<float>(result);
  };
  const Pipeline plain = make(glsl);
  EXPECT_THAT(plain.reflection.local_size, ElementsAre(2u, 1u, 1u));
  EXPECT_THAT(run(plain), ElementsAre(1.5f, 1.5f, 0, 0, 0, 0, 0, 0));
  const Pipeline other = make(glsl, {{"kScale", std::bit_cast<std::uint32_t>(0.25f)}, {"kLanes", 5}});
  EXPECT_THAT(other.reflection.local_size, ElementsAre(5u, 1u, 1u));
  EXPECT_THAT(run(other), ElementsAre(0.75f, 0.75f, 0.75f, 0.75f, 0.75f, 0, 0, 0));
  EXPECT_THAT(dispatch_error([&] { make(glsl, {{"kStep", 1}}); }), HasSubstr("'kStep'"));
}

TEST_F(GpuTest, SpecializedWorkGroupsAreCheckedAgainstTheDevice) {
  const char* const glsl =
      "#version 460\nlayout(local_size_x_id = 0) in;\nlayout(constant_id = 0) const uint kLanes = 1;\nvoid main() {}\n";
  EXPECT_THROW(make(glsl, {{"kLanes", 1u << 20}}), DeviceError);
  EXPECT_THROW(make(glsl, {{"kLanes", 0}}), DeviceError);
}

TEST_F(GpuTest, ResourcesMissingTooManyOrWrongAreNamed) {
  const Pipeline pipeline = make(kDouble);
  const Buffer b = create_buffer(*device, 64, BufferUse::storage, "b");
  const Buffer uniform = create_buffer(*device, 64, BufferUse::uniform, "u");
  const std::vector<std::uint32_t> push = {1, 0};
  const auto error = [&](const Resources& resources) {
    return dispatch_error([&] { dispatch(*device, pipeline, resources, bytes_of(push), 1); });
  };
  EXPECT_THAT(error({{"source", b}}), HasSubstr("'result' was not given"));
  EXPECT_THAT(error({{"source", b}, {"result", b}, {"grid", b}}),
              AllOf(HasSubstr("no resource 'grid'"), HasSubstr("source, result")));
  EXPECT_THAT(error({{"source", b}, {"result", b}, {"source", b}}), HasSubstr("'source' was given twice"));
  EXPECT_THAT(error({{"source", uniform}, {"result", b}}), HasSubstr("'source'"));
  EXPECT_THAT(error({{"source", Buffer()}, {"result", b}}), HasSubstr("empty"));
  EXPECT_EQ(error({{"source", b}, {"result", b}}), "");
}

TEST_F(GpuTest, PushConstantsMustHaveTheirSize) {
  const Pipeline pipeline = make(kDouble);
  const Buffer b = create_buffer(*device, 64, BufferUse::storage, "b");
  const Resources resources = {{"source", b}, {"result", b}};
  EXPECT_THAT(dispatch_error([&] { dispatch(*device, pipeline, resources, push_bytes({1}), 1); }),
              AllOf(HasSubstr("8 bytes"), HasSubstr("4 were given")));
  EXPECT_THAT(dispatch_error([&] { dispatch(*device, pipeline, resources, {}, 1); }), HasSubstr("0 were given"));
}

TEST_F(GpuTest, UniformBuffersSmallerThanTheirBlockAreRefused) {
  const Pipeline pipeline = make(R"(#version 460
    layout(local_size_x = 1) in;
    layout(binding = 0) uniform Frame { vec4 a; vec4 b; } frame;
    layout(binding = 1) buffer Out { float v[]; } result;
    void main() { result.v[0] = frame.b.x; })");
  const Buffer result = create_buffer(*device, 4, BufferUse::storage, "result");
  const Buffer small = create_buffer(*device, 16, BufferUse::uniform, "small");
  EXPECT_THAT(dispatch_error([&] {
                dispatch(*device, pipeline, {{"frame", small}, {"result", result}}, {}, 1);
              }),
              AllOf(HasSubstr("'frame'"), HasSubstr("32 bytes"), HasSubstr("16")));
}

TEST_F(GpuTest, NoGroupsAreNoWorkAndTooManyAnError) {
  const Pipeline pipeline = make(kDouble);
  const Buffer b = filled(std::vector<std::uint32_t>(16, 5u));
  const Resources resources = {{"source", b}, {"result", b}};
  EXPECT_EQ(dispatch(*device, pipeline, resources, push_bytes({16, 0}), 1, 0), 0.0);
  EXPECT_THAT(contents<std::uint32_t>(b), Each(5u));
  EXPECT_THROW(dispatch(*device, pipeline, resources, push_bytes({0, 0}), 1, UINT32_MAX), DeviceError);
}

TEST_F(GpuTest, KernelsOutliveTheHandlesTheyWereMadeFrom) {
  const Pipeline first = make(kDouble);
  Pipeline copy = first;
  const Buffer b = filled(std::vector<std::uint32_t>(4, 1u));
  { const Pipeline gone = make(kDouble); }
  dispatch(*device, copy, {{"source", b}, {"result", b}}, push_bytes({4, 0}), 1);
  EXPECT_THAT(contents<std::uint32_t>(b), Each(2u));
}

}  // namespace
}  // namespace quincunx::gpu
