// The program as a user runs it: arguments in; status, standard output and standard error out.
#pragma once

#include <sys/types.h>

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
};

/// Runs quincunx with `arguments` to its end.
Outcome run(const Arguments& arguments);

/// Runs quincunx until it listens to `signal` and `ready` says so, sends it the signal, and waits for its end.
/// Where the program ends by itself before that, that is its outcome.
Outcome run_and_signal(const Arguments& arguments, int signal, const std::function<bool()>& ready);

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

std::string read_file(const std::string& path);
void write_file(const std::string& path, const std::string& text);

/// A float32 volume of `extents` whose samples are f at their places in the world.
Volume make_volume(LatticeKind lattice, const Extents& extents, const World& world,
                   const std::function<double(const glm::dvec3&)>& f);

/// The lines of a text, without their ends.
std::vector<std::string> lines(const std::string& text);

}  // namespace quincunx::test
