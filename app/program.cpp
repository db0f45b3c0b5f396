#include "app/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <vector>

#include "app/interrupt.h"
#include "gpu/gpu.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

constexpr int failure = 1, bad_input = 2;

/// What the parser found wrong, in our words where its own do not name what was expected.
std::string explain_parse_error(CLI::App& program, const CLI::ParseError& error) {
  const auto chosen = program.get_subcommands();
  const std::string command =
      chosen.empty() ? program.get_name() : program.get_name() + " " + chosen.front()->get_name();
  const std::vector<std::string> extras = program.remaining(true);
  const bool extra = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr || chosen.empty();
  if (!extra || extras.empty()) return fmt::format("{}; see '{} --help'", error.what(), command);
  const auto flag = std::find_if(extras.begin(), extras.end(), [](const auto& e) { return e.starts_with('-'); });
  const std::string kind = flag != extras.end() ? "flag" : chosen.empty() ? "sub-command" : "argument";
  return fmt::format("unknown {} '{}', expected those of '{} --help'", kind,
                     flag != extras.end() ? *flag : extras.front(), command);
}

int run_command(const ProgramInfo& info, std::initializer_list<CommandMaker> makers, int argc, char** argv) {
  CLI::App program(info.description, info.name);
  program.set_version_flag("--version", info.name + " " + info.version);
  program.require_subcommand(1);
  std::vector<Command> commands;
  for (const CommandMaker make : makers) commands.push_back(make(program));
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& asked) {
    return program.exit(asked);
  } catch (const CLI::ParseError& error) {
    throw InputError(explain_parse_error(program, error));
  }
  for (const Command& command : commands) {
    if (command.app->parsed()) command.run();
  }
  if (std::fflush(stdout) != 0) throw std::runtime_error("standard output cannot be written");
  return 0;
}

}  // namespace

int run_program(const ProgramInfo& info, std::initializer_list<CommandMaker> makers, int argc, char** argv) {
  // Prints `message` as one line to stderr.
  const auto fail = [&info](int status, std::string message) {
    std::replace(message.begin(), message.end(), '\n', ' ');
    fmt::print(stderr, "{}: {}\n", info.name, message);
    return status;
  };
  catch_interrupts();
  try {
    return run_command(info, makers, argc, argv);
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

}  // namespace quincunx
