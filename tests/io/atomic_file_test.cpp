#include "io/atomic_file.h"

#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <span>

#include "tests/io/test_files.h"

namespace quincunx {
namespace {

using testing::HasSubstr;

std::span<const std::byte> as_bytes(std::string_view text) { return std::as_bytes(std::span(text)); }

class AtomicFileTest : public FileTest {};

TEST_F(AtomicFileTest, NothingStandsUnderTheNameBeforeTheCommit) {
  AtomicFile out(path("out"));
  out.write(as_bytes("abc"));
  EXPECT_FALSE(std::filesystem::exists(path("out")));
  out.commit();
  EXPECT_EQ(bytes_of(path("out")), "abc");
  EXPECT_EQ(file_count(), 1);
}

TEST_F(AtomicFileTest, WithoutACommitTheOldFileStaysAndNothingElse) {
  file("out", "old");
  {
    AtomicFile out(path("out"));
    out.write(as_bytes("new"));
  }
  EXPECT_EQ(bytes_of(path("out")), "old");
  EXPECT_EQ(file_count(), 1);
}

TEST_F(AtomicFileTest, TheNewFileReplacesTheOldOne) {
  file("out", "the old and longer one");
  AtomicFile out(path("out"));
  out.write(as_bytes("new"));
  out.commit();
  EXPECT_EQ(bytes_of(path("out")), "new");
}

TEST_F(AtomicFileTest, APlaceThatCannotBeWrittenIsRefusedNamingIt) {
  file("plain", "x");
  for (const std::string& place : {path("missing/out"), path("plain/out"), path(""), path("missing/")}) {
    EXPECT_THAT(error_of([&] { AtomicFile out(place); }), HasSubstr(place + ": cannot be written")) << place;
    EXPECT_THROW(check_writable(place), InputError);
  }
  EXPECT_THROW(check_writable(""), InputError);
  EXPECT_EQ(file_count(), 1);
}

TEST_F(AtomicFileTest, AFolderOrADeviceIsNotReplaced) {
  EXPECT_THAT(error_of([&] { check_writable(path(".")); }), HasSubstr("a folder"));
  EXPECT_THAT(error_of([&] { check_writable("/dev/null"); }), HasSubstr("a special file"));
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  EXPECT_THAT(error_of([&] { check_writable(path("pipe")); }), HasSubstr("a special file"));
}

TEST_F(AtomicFileTest, AskingWhetherAPlaceCanBeWrittenLeavesItAsItWas) {
  check_writable(path("out"));
  EXPECT_EQ(file_count(), 0);
  file("out", "old");
  check_writable(path("out"));
  EXPECT_EQ(bytes_of(path("out")), "old");
  EXPECT_EQ(file_count(), 1);
}

TEST_F(AtomicFileTest, ADiskThatTakesNoMoreIsAnErrorAndLeavesNothing) {
  // A limit on the size of files stands in for the full disk.
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old_limit{};
  getrlimit(RLIMIT_FSIZE, &old_limit);
  const rlimit limit{1000, old_limit.rlim_max};
  setrlimit(RLIMIT_FSIZE, &limit);
  const std::string error = error_of([&] {
    AtomicFile out(path("out"));
    out.write(as_bytes(std::string(5000, 'x')));
    out.commit();
  });
  setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_THAT(error, HasSubstr(path("out") + ": cannot be written"));
  EXPECT_EQ(file_count(), 0);
}

}  // namespace
}  // namespace quincunx
