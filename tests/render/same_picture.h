// Pictures that have to be the same, bit for bit.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "render/scene.h"

namespace quincunx {

inline bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

/// Everything but the cost is equal, bit for bit.
inline void expect_same_picture(const Frame& a, const Frame& b) {
  EXPECT_TRUE(same_bits(a.depth, b.depth));
  EXPECT_TRUE(same_bits(a.normal, b.normal));
  EXPECT_TRUE(same_bits(a.color, b.color));
}

}  // namespace quincunx
