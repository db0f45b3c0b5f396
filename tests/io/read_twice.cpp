#include "tests/io/read_twice.h"

#include <gtest/gtest.h>

#include <cstring>

#include "io/sample_file.h"
#include "io/volume_file.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

void expect_same(const Volume& a, const Volume& b) {
  EXPECT_EQ(a.lattice, b.lattice);
  EXPECT_EQ(a.extents, b.extents);
  EXPECT_EQ(a.world.origin, b.world.origin);
  EXPECT_EQ(a.world.axes, b.world.axes);
  ASSERT_EQ(a.type(), b.type());
  std::visit(
      [&](const auto& samples) {
        const auto& others = std::get<std::decay_t<decltype(samples)>>(b.samples);
        ASSERT_EQ(samples.size(), others.size());
        EXPECT_EQ(std::memcmp(samples.data(), others.data(), samples.size() * sizeof(samples[0])), 0);
      },
      a.samples);
}

}  // namespace

Volume read_twice(const std::string& path) {
  try {
    const Volume whole = read_volume(path);
    const SampleFile file(path, {});
    expect_same(whole, file.read_box(glm::i64vec3(0), whole.extents));
    EXPECT_EQ(file.header().notes, whole.notes);
    return whole;
  } catch (const InputError& error) {
    EXPECT_THROW(
        try { SampleFile(path, {}); } catch (const InputError& again) {
          EXPECT_STREQ(again.what(), error.what());
          throw;
        },
        InputError);
    throw;
  }
}

}  // namespace quincunx
