#include "program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "app/render_flags.h"
#include "lattice/error.h"

namespace quincunx::test {
namespace {

[[noreturn]] void execute(const Arguments& arguments, const std::string& out, const std::string& err) {
  const int streams[3] = {::open("/dev/null", O_RDONLY), ::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600),
                          ::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600)};
  for (int stream = 0; stream < 3; ++stream) ::dup2(streams[stream], stream);
  std::vector<char*> argv{const_cast<char*>(QUINCUNX_PROGRAM)};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  ::execv(QUINCUNX_PROGRAM, argv.data());
  ::_exit(127);
}

/// Whether the process has a handler for `signal`: the mask SigCgt of /proc, hexadecimal, bit signal - 1.
bool catches(pid_t process, int signal) {
  std::ifstream file(fmt::format("/proc/{}/status", process));
  for (std::string word; file >> word;) {
    if (word != "SigCgt:" || !(file >> word)) continue;
    return (std::stoull(word, nullptr, 16) >> (signal - 1) & 1u) != 0;
  }
  return false;
}

}  // namespace

Outcome run_and_signal(const Arguments& arguments, int signal, const std::function<bool()>& ready) {
  const TemporaryFolder streams;
  const std::string out = streams / "out", err = streams / "err";
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) execute(arguments, out, err);

  int wait_status = 0;
  rusage usage{};
  bool sent = false;
  for (;;) {
    const pid_t ended = ::wait4(child, &wait_status, ready && !sent ? WNOHANG : 0, &usage);
    if (ended == child) break;
    if (ended < 0 && errno != EINTR) throw std::runtime_error("wait4 failed");
    if (ended == 0 && !sent && catches(child, signal) && ready()) {
      sent = true;
      ::kill(child, signal);
    }
    if (ended == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return {WIFEXITED(wait_status) ? WEXITSTATUS(wait_status) : -1, read_file(out), read_file(err), std::uint64_t(usage.ru_maxrss) * 1024};
}

Outcome run(const Arguments& arguments) { return run_and_signal(arguments, 0, {}); }

void expect_refused(const Arguments& arguments, const std::vector<std::string>& parts) {
  SCOPED_TRACE(testing::PrintToString(arguments));
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(lines(outcome.err).size(), 1u) << outcome.err;
  const std::string program = std::filesystem::path(QUINCUNX_PROGRAM).filename().string();
  EXPECT_THAT(outcome.err, testing::StartsWith(program + ": "));
  for (const std::string& part : parts) EXPECT_THAT(outcome.err, testing::HasSubstr(part));
}

std::string render_refusal(Arguments arguments) {
  CLI::App app;
  RenderFlags flags;
  add_render_flags(app, flags);
  std::reverse(arguments.begin(), arguments.end());  // the parser takes them from the back
  try {
    app.parse(arguments);
    check_render_flags(flags);
  } catch (const InputError& error) {
    return error.what();
  } catch (const CLI::ParseError& error) {
    return error.what();
  }
  return "";
}

void ProgramInFolder::expect_refused(const Arguments& arguments, const std::vector<std::string>& parts) const {
  const auto before = folder.names();
  test::expect_refused(arguments, parts);
  EXPECT_EQ(folder.names(), before) << testing::PrintToString(arguments);
}

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "quincunx-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder can be made: " + pattern);
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::vector<std::string> TemporaryFolder::names() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path_))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot be read: " + path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void write_file(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error("cannot be written: " + path);
}

Volume make_volume(LatticeKind lattice, const Extents& extents, const World& world,
                   const std::function<double(const glm::dvec3&)>& f) {
  std::vector<float> samples;
  for (int c = 0; c < coset_count(lattice); ++c) {
    for (std::int64_t k = 0; k < extents.z; ++k) {
      for (std::int64_t j = 0; j < extents.y; ++j) {
        for (std::int64_t i = 0; i < extents.x; ++i) {
          const glm::dvec3 u = double(lattice_step(lattice)) * glm::dvec3(i, j, k) + double(c);
          samples.push_back(float(f(world.to_world(u))));
        }
      }
    }
  }
  return {.lattice = lattice, .extents = extents, .world = world, .samples = std::move(samples), .notes = {}};
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> result;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) result.push_back(line);
  return result;
}

}  // namespace quincunx::test
