// The program as a user runs it: arguments in; status, standard output and standard error out.
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "lattice/volume.h"

namespace quincunx::test {

using Arguments = std::vector<std::string>;

struct Outcome {
  int status = -1;  ///< exit status; -1 where a signal ended the program
  std::string out, err;
  std::uint64_t peak_bytes = 0;  ///< of its memory, the most at any time; not less than this program's own when it was started
};

/// Runs quincunx with `arguments` to its end.
Outcome run(const Arguments& arguments);

/// Runs quincunx until it listens to `signal` and `ready` says so, sends it the signal, and waits for its end.
/// Where the program ends by itself before that, that is its outcome.
Outcome run_and_signal(const Arguments& arguments, int signal, const std::function<bool()>& ready);

/// Expects bad input: status 2, nothing on standard output, one line on standard error that begins with the program's name and
/// holds each of `parts`.
void expect_refused(const Arguments& arguments, const std::vector<std::string>& parts);

/// What is wrong with the arguments of `render` before any file is read; "" where nothing is.
std::string render_refusal(Arguments arguments);

/// A new folder that goes with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  /// The path of a file in it.
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  /// The names of the files in it, ascending.
  std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

/// Tests of the program that write to a folder.
class ProgramInFolder : public testing::Test {
 protected:
  /// expect_refused, and that no file came or went.
  void expect_refused(const Arguments& arguments, const std::vector<std::string>& parts) const;

  const TemporaryFolder folder;
};

std::string read_file(const std::string& path);
void write_file(const std::string& path, const std::string& text);

/// A float32 volume of `extents` whose samples are f at their places in the world.
Volume make_volume(LatticeKind lattice, const Extents& extents, const World& world,
                   const std::function<double(const glm::dvec3&)>& f);

/// The lines of a text, without their ends.
std::vector<std::string> lines(const std::string& text);

}  // namespace quincunx::test
