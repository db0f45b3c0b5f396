// Numbers and colours as they stand on the command line.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace quincunx {

/// The finite number that is all of `text`. Throws InputError naming `flag`, what was found and what was expected.
double parse_number(std::string_view text, std::string_view flag);

/// The parts of `text` between its commas, at least one, empty ones too.
std::vector<std::string_view> split_list(std::string_view text);

/// Finite numbers separated by commas, at least one. Throws InputError naming `flag`.
std::vector<double> parse_numbers(std::string_view text, std::string_view flag);

/// The integer that is all of `text`, low <= it <= high. Throws InputError naming `flag`.
std::int64_t parse_integer(std::string_view text, std::string_view flag, std::int64_t low, std::int64_t high);

/// Integers separated by commas, at least one, each low <= it <= high. Throws InputError naming `flag`.
std::vector<int> parse_integers(std::string_view text, std::string_view flag, int low, int high);

/// The same, ascending and no two alike.
std::vector<int> parse_ascending(std::string_view text, std::string_view flag, int low, int high);

/// "r,g,b" (linear, each 0..1) or "#rrggbb" (sRGB) as linear RGB. Throws InputError naming `flag`.
glm::dvec3 parse_color(std::string_view text, std::string_view flag);

/// "#rrggbb" of sRGB as linear RGB (IEC 61966-2-1).
glm::dvec3 srgb_color(std::uint32_t rrggbb);

/// Bytes: a number that may end in K, M, G or T (1024 and its powers). Throws InputError naming `flag`.
std::uint64_t parse_bytes(std::string_view text, std::string_view flag);

/// Bytes for people: "3.8 MiB".
std::string readable_bytes(double bytes);

}  // namespace quincunx
