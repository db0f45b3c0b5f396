#include "tests/fuzz/expect.h"

#include <cstdio>
#include <cstdlib>

namespace quincunx::fuzz {

void expect(bool held, std::string_view what) {
  if (held) return;
  std::fprintf(stderr, "fuzz: expected %.*s\n", int(what.size()), what.data());
  std::abort();
}

void expect_message(std::string_view message, std::string_view name) {
  constexpr std::size_t kLongest = 4096;
  const bool good = message.find(name) != std::string_view::npos && message.find_first_of("\n\r") == std::string_view::npos &&
                    message.size() <= kLongest;
  if (!good) std::fprintf(stderr, "fuzz: found the message '%.*s'\n", int(message.size()), message.data());
  expect(good, "one line of at most 4096 characters that names the file or flag");
}

}  // namespace quincunx::fuzz
