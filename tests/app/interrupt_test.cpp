// Ctrl-C: status 130, nothing left behind. The work is long enough (seconds) to be caught in the middle.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <optional>

#include "io/volume_file.h"
#include "lattice/field.h"
#include "program.h"

namespace quincunx::test {
namespace {

/// True from the given time after the first question on.
class After {
 public:
  explicit After(int milliseconds) : delay_(milliseconds) {}
  bool operator()() {
    if (!first_) first_ = Clock::now();
    return Clock::now() >= *first_ + delay_;
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::chrono::milliseconds delay_;
  std::optional<Clock::time_point> first_;
};

Arguments long_sampling(const std::string& path) {
  return {"sample", "marschner-lobb", path, "--lattice", "bcc", "--dims", "300", "300", "300"};
}

TEST(Interrupt, EndsSamplingAndLeavesNothing) {
  const TemporaryFolder folder;
  const Outcome outcome = run_and_signal(long_sampling(folder / "v.nrrd"), SIGINT, After(200));
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
  const Outcome outcome = run_and_signal(long_sampling(folder / "v.nrrd"), SIGTERM, After(200));
  EXPECT_EQ(outcome.status, 143) << outcome.err;
  EXPECT_TRUE(folder.names().empty()) << testing::PrintToString(folder.names());
}

TEST(Interrupt, EndsRenderingAndLeavesNoPicture) {
  const TemporaryFolder folder;
  write_volume(sample_field(*make_field("gyroid"), LatticeKind::bcc, {20, 20, 20}), folder / "v.nrrd");
  const Outcome outcome = run_and_signal({"render", folder / "v.nrrd", "--iso", "0", "--device", "cpu", "--size",
                                          "4000", "4000", "-o", folder / "v.png", "-o", folder / "v.exr"},
                                         SIGINT, After(500));
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_EQ(folder.names(), std::vector<std::string>{"v.nrrd"});
}

}  // namespace
}  // namespace quincunx::test
