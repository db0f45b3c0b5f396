// The sub-commands: one file each.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace quincunx {

/// A sub-command: its part of the command line, and what it does once that has been parsed.
/// `run` throws InputError, gpu::DeviceError, Interrupted or any other exception; main turns them into exit statuses.
struct Command {
  CLI::App* app = nullptr;
  std::function<void()> run;
};

Command info_command(CLI::App& program);
Command convert_command(CLI::App& program);
Command sample_command(CLI::App& program);
Command eval_command(CLI::App& program);
Command render_command(CLI::App& program);
Command devices_command(CLI::App& program);

}  // namespace quincunx
