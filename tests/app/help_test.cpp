#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.h"

namespace quincunx::test {
namespace {

using testing::HasSubstr;

TEST(Help, OfEverySubCommandGoesToStandardOutputAndSucceeds) {
  const std::string list = run({"--help"}).out;
  for (const std::string command : {"info", "convert", "sample", "eval", "render", "sweep", "devices"}) {
    const Outcome outcome = run({command, "--help"});
    EXPECT_EQ(outcome.status, 0) << command;
    EXPECT_EQ(outcome.err, "") << command;
    EXPECT_THAT(outcome.out, HasSubstr("quincunx " + command));
    EXPECT_THAT(list, HasSubstr("  " + command + " "));
  }
}

TEST(Help, OfRenderNamesEveryFlagAndTheSkippingStructuresThereAre) {
  const std::string help = run({"render", "--help"}).out;
  for (const std::string flag :
       {"-o,",          "--iso ",       "--color ",   "--opacity ",    "--skip ",         "--block ",    "--cell-test ",
        "--intersect ", "--step ",      "--normal ",  "--delta ",      "--prefilter ", "--size ",     "--camera ",
        "--azimuth ",   "--elevation ", "--zoom ",    "--eye ",        "--target ",       "--up ",       "--fov ",
        "--device ",    "--stats ",     "--ambient ", "--background ", "--repeat ",       "--validate ", "--explain ",
        "--cost ",      "--quiet ",     "--json ",      "--nan ",       "--storage "}) {
    EXPECT_THAT(help, HasSubstr(flag));
  }
}

TEST(Version, IsNameAndNumber) {
  const Outcome outcome = run({"--version"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, testing::MatchesRegex("quincunx [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST(Devices, AreListedWithTheCpuThatIsAlwaysThere) {
  const Outcome outcome = run({"devices"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("cpu  "));
}

}  // namespace
}  // namespace quincunx::test
