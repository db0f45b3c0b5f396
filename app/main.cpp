// quincunx: reads the command line, runs one sub-command, turns errors into exit statuses.
//   0 success; 1 failure; 2 bad input (one line says what); 130 interrupted by Ctrl-C (143 by SIGTERM)
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "app/command.h"
#include "app/interrupt.h"
#include "gpu/gpu.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

constexpr int failure = 1, bad_input = 2;

/// Prints `message` as one line to stderr and returns `status`.
int fail(int status, std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  fmt::print(stderr, "quincunx: {}\n", message);
  return status;
}

/// What the parser found wrong, in our words where its own do not name what was expected.
std::string explain_parse_error(CLI::App& program, const CLI::ParseError& error) {
  const auto chosen = program.get_subcommands();
  const std::string command = chosen.empty() ? "quincunx" : "quincunx " + chosen.front()->get_name();
  const std::vector<std::string> extras = program.remaining(true);
  const bool extra = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr || chosen.empty();
  if (!extra || extras.empty()) return fmt::format("{}; see '{} --help'", error.what(), command);
  const auto flag = std::find_if(extras.begin(), extras.end(), [](const auto& e) { return e.starts_with('-'); });
  const std::string kind = flag != extras.end() ? "flag" : chosen.empty() ? "sub-command" : "argument";
  return fmt::format("unknown {} '{}', expected those of '{} --help'", kind,
                     flag != extras.end() ? *flag : extras.front(), command);
}

int run_program(int argc, char** argv) {
  CLI::App program("Isosurfaces of volumes on the body-centred cubic (BCC) lattice, exact and certified.", "quincunx");
  program.set_version_flag("--version", "quincunx " QUINCUNX_VERSION);
  program.require_subcommand(1);
  const std::vector<Command> commands{info_command(program), convert_command(program), sample_command(program),
                                      eval_command(program), render_command(program),  devices_command(program)};
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& asked) {
    return program.exit(asked);
  } catch (const CLI::ParseError& error) {
    return fail(bad_input, explain_parse_error(program, error));
  }
  for (const Command& command : commands) {
    if (command.app->parsed()) command.run();
  }
  if (std::fflush(stdout) != 0) return fail(failure, "standard output cannot be written");
  return 0;
}

}  // namespace
}  // namespace quincunx

int main(int argc, char** argv) {
  using namespace quincunx;
  catch_interrupts();
  try {
    return run_program(argc, argv);
  } catch (const InputError& error) {
    return fail(bad_input, error.what());
  } catch (const gpu::DeviceError& error) {
    return fail(bad_input, error.what());
  } catch (const Interrupted& error) {
    return fail(interrupt_status(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(failure, "out of memory");
  } catch (const std::exception& error) {
    return fail(failure, error.what());
  } catch (...) {
    return fail(failure, "unknown error");
  }
}
