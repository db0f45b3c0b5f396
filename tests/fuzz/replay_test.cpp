// The fuzzers' corpus, every input whole and cut short, by the compiler and options of the release.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/fuzz/targets.h"

namespace quincunx::fuzz {
namespace {

std::vector<std::filesystem::path> inputs_of(const Target& target) {
  std::vector<std::filesystem::path> inputs;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(QUINCUNX_SOURCE_DIR "/tests/fuzz/corpus") / target.name))
    inputs.push_back(entry.path());
  std::ranges::sort(inputs);
  return inputs;
}

TEST(FuzzCorpus, EveryInputIsReadOrRefusedWholeAndCutAtEveryByte) {
  for (const Target& target : targets()) {
    const std::vector<std::filesystem::path> inputs = inputs_of(target);
    EXPECT_GE(inputs.size(), 5u) << target.name;
    for (const std::filesystem::path& path : inputs) {
      std::ifstream file(path, std::ios::binary);
      const std::string input{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
      SCOPED_TRACE(path);
      // What must not happen aborts, or is another exception than InputError.
      for (std::size_t length = 0; length <= input.size(); ++length) EXPECT_NO_THROW(target.feed(input.substr(0, length))) << length;
    }
  }
}

}  // namespace
}  // namespace quincunx::fuzz
