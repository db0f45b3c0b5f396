// Words and numbers of an NRRD header.
#pragma once

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>
#include <vector>

namespace quincunx {

/// The words of `text` between white space.
inline std::vector<std::string_view> split_words(std::string_view text) {
  constexpr std::string_view space = " \t\r\v\f\n";
  std::vector<std::string_view> words;
  std::size_t end = 0;
  for (std::size_t begin; (begin = text.find_first_not_of(space, end)) != std::string_view::npos;) {
    end = std::min(text.find_first_of(space, begin), text.size());
    words.push_back(text.substr(begin, end - begin));
  }
  return words;
}

/// The number that all of `text` is, in decimal; nothing where it is none or does not fit T.
template <class T>
std::optional<T> parse_number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  T number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return number;
}

}  // namespace quincunx
