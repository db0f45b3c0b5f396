#include "gpu/shader_source.h"

#include <fmt/format.h>
#include <glslang/build_info.h>

#include <filesystem>
#include <optional>

#include "gpu/hash.h"

namespace quincunx::gpu {
namespace {

// Part of every content key: to be raised with each change of how compile() calls glslang.
constexpr int kRecipe = 1;

std::string_view trim_left(std::string_view text) {
  const std::size_t start = text.find_first_not_of(" \t");
  return start == std::string_view::npos ? std::string_view() : text.substr(start);
}

// What follows "# word" where the line is that directive.
std::optional<std::string_view> directive(std::string_view line, std::string_view word) {
  line = trim_left(line);
  if (line.empty() || line.front() != '#') return std::nullopt;
  line = trim_left(line.substr(1));
  if (line.substr(0, word.size()) != word) return std::nullopt;
  return trim_left(line.substr(word.size()));
}

std::optional<std::string_view> include_name(std::string_view line) {
  const auto rest = directive(line, "include");
  if (!rest || rest->empty() || rest->front() != '"') return std::nullopt;
  const std::size_t end = rest->find('"', 1);
  return end == std::string_view::npos ? std::nullopt : std::optional(rest->substr(1, end - 1));
}

template <class Function>
void for_each_line(std::string_view text, Function&& function) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    function(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

void collect(const ShaderFiles& files, const std::string& name, SourceTexts& texts) {
  const std::string_view text = files(name);
  if (text.empty() || !texts.emplace(name, text).second) return;
  for_each_line(text, [&](std::string_view line) {
    const auto included = include_name(line);
    const std::string resolved = included ? resolve_include(files, *included, name) : "";
    if (!resolved.empty()) collect(files, resolved, texts);
  });
}

}  // namespace

std::string resolve_include(const ShaderFiles& files, std::string_view name, std::string_view includer) {
  const auto beside = (std::filesystem::path(includer).parent_path() / name).lexically_normal().generic_string();
  if (!files(beside).empty()) return beside;
  return files(name).empty() ? "" : std::string(name);
}

SourceTexts collect_sources(const ShaderFiles& files, const KernelSource& source) {
  SourceTexts texts;
  collect(files, source.file, texts);
  if (texts.empty()) throw ShaderError(fmt::format("{}: there is no such shader file", source.file));
  return texts;
}

std::string define_lines(const KernelSource& source) {
  std::string lines;
  for (const auto& [name, value] : source.defines) lines += fmt::format("#define {} {}\n", name, value);
  return lines;
}

std::string content_key(const SourceTexts& texts, const KernelSource& source) {
  Hash128 hash;
  hash.add(fmt::format("recipe {}, glslang {}.{}.{}", kRecipe, GLSLANG_VERSION_MAJOR, GLSLANG_VERSION_MINOR,
                       GLSLANG_VERSION_PATCH));
  hash.add(source.file);
  hash.add(define_lines(source));
  for (const auto& [name, text] : texts) {
    hash.add(name);
    hash.add(text);
  }
  return hash.hex();
}

bool has_pragma_once(std::string_view text) {
  bool found = false;
  for_each_line(text, [&](std::string_view line) {
    const auto rest = directive(line, "pragma");
    found = found || (rest && rest->substr(0, 4) == "once");
  });
  return found;
}

}  // namespace quincunx::gpu
