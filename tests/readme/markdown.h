// What the tests look for in a Markdown file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace quincunx {

/// A fenced block: the word behind its fence, its lines, and the number of the fence's line.
struct FencedBlock {
  std::string language, text;
  int line = 0;
};

/// All fenced blocks, in their order. Throws std::runtime_error where the last one does not end.
std::vector<FencedBlock> fenced_blocks(std::string_view markdown);

/// The targets of links and images "[..](target)" that are files: no web addresses, no places of the same page (the part
/// from # on is left out). Nothing inside fenced blocks or code.
std::vector<std::string> linked_files(std::string_view markdown);

/// The text between a heading, given with its marks ("## Statistics"), and the next one of the same or a higher level;
/// empty where there is no such heading.
std::string section(std::string_view markdown, std::string_view heading);

/// The words `in backquotes`.
std::vector<std::string> code_words(std::string_view markdown);

}  // namespace quincunx
