#include "app/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "lattice/error.h"
#include "lattice/quote.h"

namespace quincunx {
namespace {

/// All of `text` as a T in from_chars' notation, a leading '+' allowed; nothing where it is anything else.
template <class T>
std::optional<T> parse_all(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

double linear_from_srgb(double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); }

}  // namespace

double parse_number(std::string_view text, std::string_view flag) {
  const std::optional<double> value = parse_all<double>(text);
  if (!value || !std::isfinite(*value)) {
    throw InputError(fmt::format("{}: found {}, expected a finite number", flag, in_quotes(text)));
  }
  return *value;
}

std::vector<std::string_view> split_list(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t comma = std::min(text.find(',', start), text.size());
    parts.push_back(text.substr(start, comma - start));
    start = comma + 1;
  }
  return parts;
}

std::vector<double> parse_numbers(std::string_view text, std::string_view flag) {
  std::vector<double> values;
  for (const std::string_view part : split_list(text)) values.push_back(parse_number(part, flag));
  return values;
}

std::int64_t parse_integer(std::string_view text, std::string_view flag, std::int64_t low, std::int64_t high) {
  const std::optional<std::int64_t> value = parse_all<std::int64_t>(text);
  if (!value || *value < low || *value > high) {
    throw InputError(fmt::format("{}: found {}, expected an integer from {} to {}", flag, in_quotes(text), low, high));
  }
  return *value;
}

std::vector<int> parse_integers(std::string_view text, std::string_view flag, int low, int high) {
  std::vector<int> values;
  for (const std::string_view part : split_list(text)) values.push_back(int(parse_integer(part, flag, low, high)));
  return values;
}

std::vector<int> parse_ascending(std::string_view text, std::string_view flag, int low, int high) {
  const std::vector<int> values = parse_integers(text, flag, low, high);
  for (std::size_t n = 1; n < values.size(); ++n)
    if (values[n] <= values[n - 1]) throw InputError(fmt::format("{}: found {} after {}, expected ascending ones", flag, values[n], values[n - 1]));
  return values;
}

glm::dvec3 parse_color(std::string_view text, std::string_view flag) {
  const auto refuse = [&] {
    return InputError(fmt::format("{}: found {}, expected r,g,b with each from 0 to 1, or #rrggbb", flag, in_quotes(text)));
  };
  if (text.starts_with('#')) {
    std::uint32_t rrggbb = 0;
    const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), rrggbb, 16);
    if (text.size() != 7 || error != std::errc() || end != text.data() + text.size()) throw refuse();
    return srgb_color(rrggbb);
  }
  glm::dvec3 color(0.0);
  std::size_t start = 0;
  for (int channel = 0; channel < 3; ++channel) {
    const std::size_t end = channel == 2 ? text.size() : text.find(',', start);
    if (end == std::string_view::npos || start > end) throw refuse();
    const std::optional<double> value = parse_all<double>(text.substr(start, end - start));
    if (!value || !(*value >= 0.0 && *value <= 1.0)) throw refuse();
    color[channel] = *value;
    start = end + 1;
  }
  return color;
}

glm::dvec3 srgb_color(std::uint32_t rrggbb) {
  const auto channel = [&](int shift) { return linear_from_srgb(double((rrggbb >> shift) & 255u) / 255.0); };
  return {channel(16), channel(8), channel(0)};
}

std::uint64_t parse_bytes(std::string_view text, std::string_view flag) {
  constexpr std::string_view kUnits = "KMGT";
  const std::size_t unit = text.empty() ? std::string_view::npos : kUnits.find(text.back());
  const double scale = unit == std::string_view::npos ? 1.0 : std::exp2(10.0 * double(unit + 1));
  const std::string_view digits = unit == std::string_view::npos ? text : text.substr(0, text.size() - 1);
  double number = -1.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::fixed);
  if (error != std::errc() || end != digits.data() + digits.size() || !(number >= 0.0 && number * scale <= 0x1p53))
    throw InputError(fmt::format("{}: found {}, expected bytes, such as 256M or 1.5G", flag, in_quotes(text)));
  return std::uint64_t(number * scale);
}

std::string readable_bytes(double bytes) {
  constexpr std::array units{"bytes", "KiB", "MiB", "GiB", "TiB", "PiB"};
  std::size_t unit = 0;
  while (bytes >= 1024.0 && unit + 1 < units.size()) {
    bytes /= 1024.0;
    ++unit;
  }
  return unit == 0 ? fmt::format("{:.0f} bytes", bytes) : fmt::format("{:.1f} {}", bytes, units[unit]);
}

}  // namespace quincunx
