#include "app/time_left.h"

#include <gtest/gtest.h>

namespace quincunx {
namespace {

TEST(TimeLeft, IsNotToldBeforeThereIsAPace) {
  TimeLeft left;
  EXPECT_FALSE(left.seconds());
  left.note(1.0, 0.5);
  EXPECT_FALSE(left.seconds());  // too early
  left.note(5.0, 0.5);
  ASSERT_TRUE(left.seconds());
  EXPECT_DOUBLE_EQ(*left.seconds(), 5.0);
  TimeLeft stuck;
  stuck.note(60.0, 0.0);
  EXPECT_FALSE(stuck.seconds());
}

TEST(TimeLeft, FollowsThePaceOfTheLastSeconds) {
  TimeLeft left;
  // A hundredth in the first 20 seconds, then one each second.
  for (int s = 1; s <= 20; ++s) left.note(s, 0.0005 * s);
  EXPECT_NEAR(*left.seconds(), 1980.0, 1e-6);
  for (int s = 21; s <= 50; ++s) left.note(s, 0.01 + 0.01 * (s - 20));
  EXPECT_NEAR(*left.seconds(), 69.0, 1e-6);
}

TEST(TimeLeft, IsToldInRoundNumbers) {
  EXPECT_EQ(time_left_text(3.0), "a few seconds left");
  EXPECT_EQ(time_left_text(42.0), "about 40 s left");
  EXPECT_EQ(time_left_text(125.0), "about 2 min left");
  EXPECT_EQ(time_left_text(2.0 * 3600.0), "about 2.0 h left");
}

}  // namespace
}  // namespace quincunx
