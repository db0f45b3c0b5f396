// A program of sub-commands: one command line, errors as exit statuses.
#pragma once

#include <initializer_list>
#include <string>

#include "app/command.h"

namespace quincunx {

/// What a program says of itself.
struct ProgramInfo {
  std::string name, description, version;
};

/// Adds a sub-command to a program: info_command and its like.
using CommandMaker = Command (*)(CLI::App& program);

/// Reads the command line, runs one sub-command, turns errors into exit statuses, which main returns:
///   0 success; 1 failure; 2 bad input (one line on stderr says what); 130 interrupted by Ctrl-C (143 by SIGTERM).
int run_program(const ProgramInfo& info, std::initializer_list<CommandMaker> makers, int argc, char** argv);

}  // namespace quincunx
