#include "tests/readme/markdown.h"

#include <regex>
#include <sstream>
#include <stdexcept>

namespace quincunx {
namespace {

constexpr std::string_view kFence = "```";

std::vector<std::string> matches(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> found;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), pattern); at != std::sregex_iterator(); ++at)
    found.push_back((*at)[1]);
  return found;
}

/// The text without its fenced blocks.
std::string prose(std::string_view markdown) {
  std::istringstream lines{std::string(markdown)};
  std::string text;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    const bool fence = line.starts_with(kFence);
    if (!inside && !fence) text += line + "\n";
    inside = inside != fence;
  }
  return text;
}

}  // namespace

std::vector<FencedBlock> fenced_blocks(std::string_view markdown) {
  std::istringstream lines{std::string(markdown)};
  std::vector<FencedBlock> blocks;
  bool inside = false;
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const bool fence = line.starts_with(kFence);
    if (fence && !inside) blocks.push_back({line.substr(kFence.size()), "", number});
    if (inside && !fence) blocks.back().text += line + "\n";
    inside = inside != fence;
  }
  if (inside) throw std::runtime_error("line " + std::to_string(blocks.back().line) + ": a fenced block without end");
  return blocks;
}

std::vector<std::string> linked_files(std::string_view markdown) {
  const std::string text = std::regex_replace(prose(markdown), std::regex("`[^`\n]*`"), "");
  std::vector<std::string> files;
  for (const std::string& target : matches(text, std::regex(R"(\]\(([^)\s]+)\))"))) {
    const std::string file = target.substr(0, target.find('#'));
    if (!file.empty() && file.find("://") == std::string::npos) files.push_back(file);
  }
  return files;
}

std::string section(std::string_view markdown, std::string_view heading) {
  const std::size_t level = heading.find(' ');
  std::istringstream lines{std::string(markdown)};
  std::string text;
  bool inside = false, fenced = false;
  for (std::string line; std::getline(lines, line);) {
    fenced = fenced != line.starts_with(kFence);
    const std::size_t marks = line.find_first_not_of('#');
    const bool is_heading = !fenced && marks > 0 && marks != std::string::npos && line[marks] == ' ';
    if (is_heading && marks <= level) inside = line == heading;
    else if (inside) text += line + "\n";
  }
  return text;
}

std::vector<std::string> code_words(std::string_view markdown) {
  return matches(std::string(markdown), std::regex("`([^`\n]+)`"));
}

}  // namespace quincunx
