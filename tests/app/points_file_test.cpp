#include "app/points_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "lattice/error.h"
#include "program.h"

namespace quincunx::test {
namespace {

TEST(PointsFile, IsReadWithAndWithoutAHeaderAndAsWindowsWritesIt) {
  const TemporaryFolder folder;
  for (const char* text : {"x,y,z\n-1,8,15\n", "-1,8,15\n", "-1, 8 ,\t15", "x, y, z\r\n\r\n-1,8,15\r\n\r\n",
                           "\xEF\xBB\xBFX,Y,Z\n-1,8,15\n"}) {
    write_file(folder / "p.csv", text);
    PointsFile file(folder / "p.csv");
    EXPECT_EQ(file.next(), glm::dvec3(-1, 8, 15)) << text;
    EXPECT_EQ(file.next(), std::nullopt) << text;
  }
}

TEST(PointsFile, NamesFileAndLineOfWhatIsNoPoint) {
  const TemporaryFolder folder;
  for (const std::string bad : {"1,2", "1,2,3,4", "1,2,abc", "1,,3", "1 2 3", "nan,0,0", "1,2,1e999", "x,y,z"}) {
    write_file(folder / "p.csv", "x,y,z\n0,0,0\n" + bad + "\n0,0,0\n");
    PointsFile file(folder / "p.csv");
    EXPECT_EQ(file.next(), glm::dvec3(0.0));
    try {
      file.next();
      ADD_FAILURE() << bad;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("p.csv:3: found '")) << bad;
    }
  }
}

// A line is held in memory, and its text goes into the message.
TEST(PointsFile, RefusesALineOfEndlessLengthInOneShortLine) {
  const TemporaryFolder folder;
  for (const std::string& bad : {std::string(5000, '1'), std::string(1 << 20, ' '), "0,0,\x1b[31m\r0 " + std::string(4000, '1')}) {
    write_file(folder / "p.csv", "0,0,0\n" + bad + "\n0,0,0\n");
    PointsFile file(folder / "p.csv");
    EXPECT_EQ(file.next(), glm::dvec3(0.0));
    try {
      file.next();
      ADD_FAILURE() << bad.size();
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_THAT(message, testing::HasSubstr("p.csv:2: found "));
      EXPECT_EQ(message.find_first_of("\r\n\x1b"), std::string::npos) << message;
      EXPECT_LT(message.size(), 300u);
    }
  }
}

TEST(PointsFile, ReadsALineOf4096Bytes) {
  const TemporaryFolder folder;
  write_file(folder / "p.csv", "1,2," + std::string(4096 - 5, ' ') + "3\n4,5," + std::string(4096 - 5, ' ') + "6");
  PointsFile file(folder / "p.csv");
  EXPECT_EQ(file.next(), glm::dvec3(1.0, 2.0, 3.0));
  EXPECT_EQ(file.next(), glm::dvec3(4.0, 5.0, 6.0));
  EXPECT_EQ(file.next(), std::nullopt);
}

// It is read twice: a pipe would be empty, or hang, the second time.
TEST(PointsFile, RefusesAPipeAndAFolder) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  const Outcome pipe = run({"eval", folder / "none.nrrd", "--points", folder / "pipe"});
  EXPECT_EQ(pipe.status, 2);
  EXPECT_THAT(pipe.err, testing::HasSubstr("pipe: found a special file, expected a regular file"));
  EXPECT_THROW(PointsFile(folder / "."), InputError);
}

}  // namespace
}  // namespace quincunx::test
