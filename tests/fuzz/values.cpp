#include "app/values.h"

#include <cmath>

#include "tests/fuzz/expect.h"
#include "tests/fuzz/targets.h"

namespace quincunx::fuzz {
namespace {

/// What split_list promises: the parts with commas between them are the text.
void expect_parts(std::string_view text) {
  std::string joined;
  for (const std::string_view part : split_list(text)) joined.append(part).append(1, ',');
  expect(joined == std::string(text) + ",", "parts that make the text");
}

}  // namespace

void feed_values(std::string_view text) {
  constexpr std::string_view flag = "--flag";
  expect_parts(text);
  const bool number = accepts(flag, [&] { expect(std::isfinite(parse_number(text, flag)), "a finite number"); });
  const bool integer = accepts(flag, [&] {
    const std::int64_t n = parse_integer(text, flag, -1000000, 1000000);
    expect(n >= -1000000 && n <= 1000000, "an integer of the range");
  });
  expect(number || !integer, "an integer to be a number");
  const bool list = accepts(flag, [&] { expect(parse_numbers(text, flag).size() == split_list(text).size(), "a number for each part"); });
  expect(list || !number, "a number to be a list of one");
  accepts(flag, [&] {
    const glm::dvec3 c = parse_color(text, flag);
    for (int channel = 0; channel < 3; ++channel) expect(c[channel] >= 0.0 && c[channel] <= 1.0, "channels of 0..1");
  });
  accepts(flag, [&] {
    const std::uint64_t bytes = parse_bytes(text, flag);
    expect(bytes <= std::uint64_t(1) << 53 && !readable_bytes(double(bytes)).empty(), "bytes that can be counted");
  });
}

}  // namespace quincunx::fuzz
