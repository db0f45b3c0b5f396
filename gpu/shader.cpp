#include "gpu/shader.h"

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <cstring>
#include <memory>
#include <set>
#include <sstream>

#include "gpu/device_state.h"
#include "gpu/disk_cache.h"
#include "gpu/shader_source.h"

namespace quincunx::gpu {
namespace {

constexpr std::uint32_t kSpirvMagic = 0x07230203;
constexpr std::size_t kDeepest = 32;  // includes within includes

struct GlslangProcess {
  GlslangProcess() { glslang::InitializeProcess(); }
  ~GlslangProcess() { glslang::FinalizeProcess(); }
  GlslangProcess(const GlslangProcess&) = delete;
  GlslangProcess& operator=(const GlslangProcess&) = delete;
};

// Serves includes from ShaderFiles; texts are theirs, results are freed on release.
class FileIncluder : public glslang::TShader::Includer {
 public:
  explicit FileIncluder(const ShaderFiles& files) : files_(files) {}

  IncludeResult* includeLocal(const char* name, const char* includer, std::size_t depth) override {
    if (depth > kDeepest) return nullptr;  // files that include each other in a circle
    const std::string resolved = resolve_include(files_, name, includer);
    if (resolved.empty()) return nullptr;
    std::string_view text = files_(resolved);
    if (has_pragma_once(text) && !once_.insert(resolved).second) text = "";
    return new IncludeResult(resolved, text.data(), text.size(), nullptr);
  }
  void releaseInclude(IncludeResult* result) override { delete result; }

 private:
  const ShaderFiles& files_;
  std::set<std::string> once_;
};

// glslang's log as "file:line: what" lines, errors alone.
std::string error_lines(const char* log, const std::string& file) {
  std::istringstream lines(log);
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    constexpr std::string_view kError = "ERROR: ";
    if (!line.starts_with(kError)) continue;
    line.erase(0, kError.size());
    const bool summary = line.find("compilation errors.  No code generated") != std::string::npos ||
                         line.find("'' : compilation terminated") != std::string::npos;
    if (summary) continue;
    line.erase(line.find_last_not_of(' ') + 1);
    const bool has_place = line.find(':') != std::string::npos && !line.starts_with("Linking");
    text += (text.empty() ? "" : "\n") + (has_place ? line : fmt::format("{}: {}", file, line));
  }
  return text.empty() ? fmt::format("{}: does not compile: {}", file, log) : text;
}

// GLSL to SPIR-V 1.5 for Vulkan 1.2, not optimised.
std::vector<std::uint32_t> compile_text(const ShaderFiles& files, const KernelSource& source, std::string_view text) {
  static const GlslangProcess process;
  constexpr auto kMessages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
  const std::string preamble = "#extension GL_GOOGLE_include_directive : require\n" + define_lines(source);
  const char* const string = text.data();
  const int length = static_cast<int>(text.size());
  const char* const name = source.file.c_str();

  glslang::TShader shader(EShLangCompute);
  shader.setStringsWithLengthsAndNames(&string, &length, &name, 1);
  shader.setPreamble(preamble.c_str());
  shader.setEnvInput(glslang::EShSourceGlsl, EShLangCompute, glslang::EShClientVulkan, 460);
  shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_2);
  shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_5);
  FileIncluder includer(files);
  if (!shader.parse(GetDefaultResources(), 460, ENoProfile, false, false, kMessages, includer)) {
    throw ShaderError(error_lines(shader.getInfoLog(), source.file));
  }
  glslang::TProgram program;
  program.addShader(&shader);
  if (!program.link(kMessages)) throw ShaderError(error_lines(program.getInfoLog(), source.file));

  std::vector<std::uint32_t> spirv;
  glslang::SpvOptions options;
  options.disableOptimizer = true;
  glslang::GlslangToSpv(*program.getIntermediate(EShLangCompute), spirv, &options);
  return spirv;
}

std::vector<std::uint32_t> as_words(std::span<const std::byte> bytes) {
  std::vector<std::uint32_t> words(bytes.size() / sizeof(std::uint32_t));
  std::memcpy(words.data(), bytes.data(), words.size() * sizeof(std::uint32_t));
  return words;
}

}  // namespace

std::vector<std::uint32_t> compile(const ShaderFiles& files, const KernelSource& source) {
  const SourceTexts texts = collect_sources(files, source);
  return compile_text(files, source, texts.at(source.file));
}

std::vector<std::uint32_t> compile(const Device& device, const ShaderFiles& files, const KernelSource& source) {
  const SourceTexts texts = collect_sources(files, source);
  const std::string name = content_key(texts, source) + ".spv";
  if (const auto cached = read_cached(device.cache_folder, name)) {
    std::vector<std::uint32_t> words = as_words(*cached);
    if (!words.empty() && words.front() == kSpirvMagic) return words;
  }
  std::vector<std::uint32_t> spirv = compile_text(files, source, texts.at(source.file));
  write_cached(device.cache_folder, name, std::as_bytes(std::span(spirv)));
  return spirv;
}

}  // namespace quincunx::gpu
