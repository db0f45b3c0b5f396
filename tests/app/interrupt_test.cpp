// Ctrl-C: status 130, nothing left behind. The work is long enough (seconds) to be caught in the middle.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>

#include "io/volume_file.h"
#include "program.h"

namespace quincunx::test {
namespace {

/// Whether this much time has gone by since it was made.
class After {
 public:
  explicit After(int milliseconds) : end_(Clock::now() + std::chrono::milliseconds(milliseconds)) {}
  bool operator()() const { return Clock::now() >= end_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point end_;
};

Arguments long_sampling(const std::string& path) {
  return {"sample", "marschner-lobb", path, "--lattice", "bcc", "--dims", "300", "300", "300"};
}

TEST(Interrupt, EndsSamplingAndLeavesNothing) {
  const TemporaryFolder folder;
  const Outcome outcome = run_and_signal(long_sampling(folder / "v.nrrd"), SIGINT, After(400));
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_EQ(outcome.err, "quincunx: interrupted\n");
  EXPECT_TRUE(folder.names().empty()) << testing::PrintToString(folder.names());
}

TEST(Interrupt, EndsWritingAndTakesTheUnfinishedFileAway) {
  const TemporaryFolder folder;
  // Smaller, so that writing begins soon; gzip takes seconds for these 64 MB.
  Arguments arguments = long_sampling(folder / "v.nrrd");
  for (std::size_t n = arguments.size() - 3; n < arguments.size(); ++n) arguments[n] = "200";
  const auto writing = [&] {
    for (const std::string& name : folder.names()) {
      std::error_code ignored;
      if (std::filesystem::file_size(folder / name, ignored) > 1000 && !ignored) return true;
    }
    return false;
  };
  const Outcome outcome = run_and_signal(arguments, SIGINT, writing);
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_TRUE(folder.names().empty()) << testing::PrintToString(folder.names());
}

TEST(Interrupt, OfTheSystemsKindIsTakenTheSameWay) {
  const TemporaryFolder folder;
  const Outcome outcome = run_and_signal(long_sampling(folder / "v.nrrd"), SIGTERM, After(400));
  EXPECT_EQ(outcome.status, 143) << outcome.err;
  EXPECT_TRUE(folder.names().empty()) << testing::PrintToString(folder.names());
}

TEST(Interrupt, EndsRenderingAndLeavesNoPicture) {
  const TemporaryFolder folder;
  const auto gyroid = run({"sample", "gyroid", folder / "v.nrrd", "--lattice", "bcc", "--dims", "20", "20", "20"});
  ASSERT_EQ(gyroid.status, 0) << gyroid.err;
  const Outcome outcome = run_and_signal({"render", folder / "v.nrrd", "--iso", "0", "--device", "cpu", "--size",
                                          "4000", "4000", "-o", folder / "v.png", "-o", folder / "v.exr"},
                                         SIGINT, After(700));
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_EQ(folder.names(), std::vector<std::string>{"v.nrrd"});
}

}  // namespace
}  // namespace quincunx::test
