#include "bench/gnuplot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <vector>

#include "io/atomic_file.h"

namespace quincunx {
namespace {

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

/// A file without a name that holds `text`, to be read from its beginning. Unlike a pipe it takes all of it at once, and nobody
/// is hurt where the reader goes away.
File anonymous_file(const std::string& text) {
  File file(std::tmpfile());
  if (!file || std::fwrite(text.data(), 1, text.size(), file.get()) != text.size() || std::fflush(file.get()) != 0)
    throw std::runtime_error("a temporary file cannot be written");
  std::rewind(file.get());
  return file;
}

/// What the child's standard streams are.
class Streams {
 public:
  Streams(int in, const std::string& out) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_adddup2(&actions_, in, STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, out.c_str(), O_WRONLY | O_TRUNC, 0);
    posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  }
  ~Streams() { posix_spawn_file_actions_destroy(&actions_); }
  Streams(const Streams&) = delete;
  Streams& operator=(const Streams&) = delete;
  const posix_spawn_file_actions_t* actions() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

}  // namespace

std::string gnuplot_string(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') result += c;
    result += static_cast<unsigned char>(c) < ' ' ? '?' : c;
  }
  return result + "'";
}

std::size_t place_of(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return std::size_t(found - names.begin());
  names.push_back(name);
  return names.size() - 1;
}

std::string gnuplot_marks(double low, double high) {
  const bool close = high / low < 4.0;
  std::vector<std::string> marks;
  for (double decade = std::pow(10.0, std::floor(std::log10(low))); decade <= high; decade *= 10.0) {
    for (const double digit : close ? std::vector<double>{1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8} : std::vector<double>{1, 2, 5}) {
      const double mark = digit * decade;
      if (mark >= low && mark <= high) marks.push_back(fmt::format("'{0:.6g}' {0:.6g}", mark));
    }
  }
  return fmt::format("{}", fmt::join(marks, ", "));
}

Drawn draw_with_gnuplot(const std::string& script, const std::string& path) {
  AtomicFile file(path);
  const File input = anonymous_file(script);
  const Streams streams(::fileno(input.get()), file.temporary());
  std::string name = "gnuplot";
  const std::array<char*, 2> arguments{name.data(), nullptr};
  pid_t child = -1;
  const int error = ::posix_spawnp(&child, name.c_str(), streams.actions(), nullptr, arguments.data(), environ);
  if (error != 0) return error == ENOENT ? Drawn::no_gnuplot : Drawn::failed;

  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return Drawn::failed;
  }
  // An empty drawing is none: gnuplot may end well without having plotted.
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || std::filesystem::file_size(file.temporary()) == 0) return Drawn::failed;
  file.commit();
  return Drawn::yes;
}

void draw_or_note(const std::string& script, const std::string& path) {
  const Drawn drawn = draw_with_gnuplot(script, path);
  if (drawn == Drawn::yes) return;
  std::filesystem::remove(path);
  fmt::print(stderr, "note: {} is not drawn: {}\n", path,
             drawn == Drawn::failed ? "gnuplot failed" : "gnuplot is not there (Debian package gnuplot-nox)");
}

}  // namespace quincunx
