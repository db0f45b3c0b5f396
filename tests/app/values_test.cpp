#include "app/values.h"

#include <gtest/gtest.h>

#include "lattice/error.h"

namespace quincunx {
namespace {

TEST(Values, AreNumbersThatUseTheWholeText) {
  EXPECT_EQ(parse_number("-700", "--iso"), -700.0);
  EXPECT_EQ(parse_number("+1.5e3", "--iso"), 1500.0);
  for (const char* bad : {"", "x", "1x", "1 2", " 1", "nan", "inf", "-inf", "1e999", "+-1", "0x10", "1,5"}) {
    EXPECT_THROW(parse_number(bad, "--iso"), InputError) << bad;
  }
}

TEST(Values, ComeInListsWithoutHoles) {
  EXPECT_EQ(parse_numbers("1,-2,3.5", "--iso"), (std::vector<double>{1.0, -2.0, 3.5}));
  for (const char* bad : {"", ",", "1,", ",1", "1,,2", "1;2"})
    EXPECT_THROW(parse_numbers(bad, "--iso"), InputError) << bad;
}

TEST(Values, AreIntegersWithinTheirLimits) {
  EXPECT_EQ(parse_integer("16", "--block", 1, 256), 16);
  for (const char* bad : {"0", "257", "1.5", "", "99999999999999999999", "-1"}) {
    EXPECT_THROW(parse_integer(bad, "--block", 1, 256), InputError) << bad;
  }
}

TEST(Values, AreListsOfIntegersThatMayHaveToAscend) {
  EXPECT_EQ(parse_integers("4,2,2", "--sizes", 1, 8), (std::vector<int>{4, 2, 2}));
  EXPECT_EQ(parse_ascending("1,2,8", "--sizes", 1, 8), (std::vector<int>{1, 2, 8}));
  for (const char* bad : {"", "2,", "0,2", "2,9", "2,x"}) {
    EXPECT_THROW(parse_integers(bad, "--sizes", 1, 8), InputError) << bad;
    EXPECT_THROW(parse_ascending(bad, "--sizes", 1, 8), InputError) << bad;
  }
  for (const char* bad : {"2,2", "2,4,3"}) EXPECT_THROW(parse_ascending(bad, "--sizes", 1, 8), InputError) << bad;
}

TEST(Values, AreColoursLinearOrOfSrgb) {
  EXPECT_EQ(parse_color("0.25,0.5,1", "--color"), glm::dvec3(0.25, 0.5, 1.0));
  EXPECT_EQ(parse_color("#ff0000", "--color"), glm::dvec3(1.0, 0.0, 0.0));
  // The middle grey of sRGB: 188/255 is about half of the light.
  EXPECT_NEAR(parse_color("#bcbcbc", "--color").g, 0.5029, 1e-4);
  for (const char* bad :
       {"", "red", "#ff00", "#ff00000", "#gg0000", "1,2,3", "0,0", "0,0,0,0", "0,0,nan", "-0.1,0,0", ",,"}) {
    EXPECT_THROW(parse_color(bad, "--color"), InputError) << bad;
  }
}

TEST(Values, NameTheFlagAndWhatWasFoundInTheirErrors) {
  try {
    parse_number("abc", "--iso");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "--iso: found 'abc', expected a finite number");
  }
}

TEST(Values, AreShownOnOneShortLineWhateverTheyAre) {
  const std::string text = "4\n\x1b[2J\r" + std::string(100000, '7');
  for (const auto& parse : {+[](const std::string& t) { parse_number(t, "--flag"); }, +[](const std::string& t) { parse_integer(t, "--flag", 0, 9); },
                            +[](const std::string& t) { parse_color(t, "--flag"); }, +[](const std::string& t) { parse_bytes(t, "--flag"); }}) {
    try {
      parse(text);
      ADD_FAILURE();
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.find("--flag: found '4\\x0a\\x1b[2J\\x0d7777"), 0u) << message;
      EXPECT_LT(message.size(), 200u);
    }
  }
}

TEST(Values, AreBytesForPeople) {
  EXPECT_EQ(readable_bytes(12.0), "12 bytes");
  EXPECT_EQ(readable_bytes(1536.0), "1.5 KiB");
  EXPECT_EQ(readable_bytes(3.0 * 1024 * 1024 * 1024), "3.0 GiB");
}

}  // namespace
}  // namespace quincunx
