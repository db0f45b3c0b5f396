#include "tests/gpu/test_device.h"

namespace quincunx::gpu {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const char* const kHead =
    "#version 460\nlayout(local_size_x = 1) in;\nlayout(binding = 0) buffer Out { float o[]; } result;\n";

std::string compile_error(const Files& files, const KernelSource& source) {
  try {
    compile(files.lookup(), source);
  } catch (const ShaderError& error) {
    return error.what();
  }
  return "";
}

TEST(Shader, ErrorNamesFileAndLine) {
  const Files files{{{"main.comp", std::string(kHead) + "void main() {\n  result.o[0] = wrong;\n}\n"}}};
  EXPECT_THAT(compile_error(files, {"main.comp", {}}),
              AllOf(StartsWith("main.comp:5: "), HasSubstr("wrong"), Not(HasSubstr("ERROR"))));
}

TEST(Shader, ErrorInAnIncludedFileNamesThatFileAndLine) {
  const Files files{
      {{"main.comp", std::string(kHead) + "#include \"shared/part.glsl\"\nvoid main() { result.o[0] = f(); }\n"},
       {"shared/part.glsl", "\n\nfloat f() { return nothing; }\n"}}};
  EXPECT_THAT(compile_error(files, {"main.comp", {}}), StartsWith("shared/part.glsl:3: "));
}

TEST(Shader, ErrorAfterAnIncludeCountsTheLinesOfItsOwnFile) {
  const Files files{{{"main.comp", std::string(kHead) + "#include \"a.glsl\"\nvoid main() { wrong(); }\n"},
                     {"a.glsl", "\n\n\n\n\n\n\n\nfloat f() { return 1.0; }\n"}}};
  EXPECT_THAT(compile_error(files, {"main.comp", {}}), StartsWith("main.comp:5: "));
}

TEST(Shader, OfSeveralErrorsTheFirstIsToldInOneLine) {
  const Files files{
      {{"main.comp", std::string(kHead) + "void main() {\n  result.o[0] = one;\n  result.o[1] = two;\n}\n"}}};
  EXPECT_THAT(compile_error(files, {"main.comp", {}}),
              AllOf(StartsWith("main.comp:5: "), HasSubstr("one"), Not(HasSubstr("\n"))));
}

TEST(Shader, MissingFilesAndFunctionsAreNamed) {
  const Files files{
      {{"main.comp", std::string(kHead) + "#include \"absent.glsl\"\nvoid main() {}\n"}, {"empty.comp", kHead}}};
  EXPECT_THAT(compile_error(files, {"nowhere.comp", {}}), HasSubstr("nowhere.comp"));
  EXPECT_THAT(compile_error(files, {"main.comp", {}}), AllOf(StartsWith("main.comp:4: "), HasSubstr("absent.glsl")));
  EXPECT_THAT(compile_error(files, {"empty.comp", {}}), AllOf(StartsWith("empty.comp: "), HasSubstr("entry point")));
}

TEST(Shader, IncludesThatGoRoundInACircleAreAnErrorAndNoHang) {
  const Files files{{{"main.comp", std::string(kHead) + "#include \"a.glsl\"\nvoid main() {}\n"},
                     {"a.glsl", "#include \"b.glsl\"\n"},
                     {"b.glsl", "#include \"a.glsl\"\n"}}};
  EXPECT_THAT(compile_error(files, {"main.comp", {}}), ::testing::ContainsRegex("^[ab].glsl:1: "));
}

TEST(Shader, IncludesAreSoughtBesideTheIncluderFirst) {
  const Files files{
      {{"main.comp", std::string(kHead) + "#include \"shared/a.h\"\nvoid main() { result.o[0] = b(); }\n"},
       {"shared/a.h", "#include \"b.h\"\n"},
       {"shared/b.h", "float b() { return 1.0; }\n"},
       {"b.h", "#error the wrong one\n"}}};
  EXPECT_EQ(compile_error(files, {"main.comp", {}}), "");
}

TEST(Shader, PragmaOnceIncludesOnceAndOtherFilesAsOftenAsAsked) {
  const Files once{
      {{"main.comp", std::string(kHead) + "#include \"a.h\"\n#include \"a.h\"\nvoid main() { result.o[0] = a(); }\n"},
       {"a.h", "#pragma once\nfloat a() { return 1.0; }\n"}}};
  EXPECT_EQ(compile_error(once, {"main.comp", {}}), "");
  const Files twice{
      {{"main.comp", std::string(kHead) + "#include \"a.h\"\n#include \"a.h\"\nvoid main() { result.o[0] = a(); }\n"},
       {"a.h", "float a() { return 1.0; }\n"}}};
  EXPECT_THAT(compile_error(twice, {"main.comp", {}}), StartsWith("a.h:1: "));
}

TEST(Shader, DefinesChooseWhatIsCompiled) {
  const Files files{{{"main.comp", std::string(kHead) +
                                       "#if MODE == 2\n#include \"two.glsl\"\n#else\n#include \"absent.glsl\"\n#endif\n"
                                       "void main() { result.o[0] = two() + SHIFT; }\n"},
                     {"two.glsl", "float two() { return 2.0; }\n"}}};
  EXPECT_EQ(compile_error(files, {"main.comp", {{"MODE", "2"}, {"SHIFT", "0.5"}}}), "");
  EXPECT_THAT(compile_error(files, {"main.comp", {{"MODE", "1"}, {"SHIFT", "0.5"}}}), HasSubstr("absent.glsl"));
  EXPECT_THAT(compile_error(files, {"main.comp", {{"MODE", "2"}}}), HasSubstr("SHIFT"));
}

TEST(Shader, FunctionsKeepTheirNames) {
  const Files files{
      {{"main.comp",
        std::string(kHead) +
            "float march_step(float x) { return x * 2.0; }\nvoid main() { result.o[0] = march_step(1.0); }\n"}}};
  const auto spirv = compile(files.lookup(), {"main.comp", {}});
  const std::string_view text(reinterpret_cast<const char*>(spirv.data()), spirv.size() * 4);
  EXPECT_NE(text.find("march_step("), std::string_view::npos);
}

}  // namespace
}  // namespace quincunx::gpu
