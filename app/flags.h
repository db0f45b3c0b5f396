// Flags whose values are checked in our words: an error names the flag, what was found and what was expected.
#pragma once

#include <CLI/CLI.hpp>
#include <concepts>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/progress_bar.h"

namespace quincunx {

/// The numbers a flag takes: low <= x <= high, or low < x where `open_low`.
struct Interval {
  double low, high;
  bool open_low = false;
};

/// A flag of one finite number within `interval`; `value` holds the default, which --help shows.
CLI::Option* add_number(CLI::App& app, const std::string& flag, double& value, Interval interval,
                        const std::string& help);

/// A flag of one integer, low..high; `value` holds the default, which --help shows.
CLI::Option* add_integer(CLI::App& app, const std::string& flag, int& value, int low, int high,
                         const std::string& help);

/// A flag of three finite numbers, "--flag x y z".
CLI::Option* add_vector(CLI::App& app, const std::string& flag, glm::dvec3& value, const std::string& help);

/// "--size W H", pixels.
CLI::Option* add_size(CLI::App& app, int& width, int& height);

/// "--block N": the edge of a structure's blocks in cells, a power of two from 1 to 256. 0 beforehand stands for one that fits.
CLI::Option* add_block(CLI::App& app, int& block);

/// The edge of a block that is all of `text`: a power of two from 1 to 256. Throws InputError naming `flag`.
int parse_block(std::string_view text, std::string_view flag);

/// The edge of a brick that is all of `text`: a power of two from 4 to 256. Throws InputError naming `flag`.
int parse_brick(std::string_view text, std::string_view flag);

/// "--device D".
CLI::Option* add_device(CLI::App& app, std::string& device);

/// A flag whose value is one of `choices`, shown in --help.
CLI::Option* add_choice_name(CLI::App& app, const std::string& flag, std::string& value,
                             const std::vector<std::string>& choices, const std::string& help);

/// The same for an enumeration: the value goes with the name; `value` holds the default.
template <class Enum>
CLI::Option* add_choice(CLI::App& app, const std::string& flag, Enum& value,
                        const std::vector<std::pair<std::string, Enum>>& choices, const std::string& help);

/// Throws InputError naming the flag and the choices unless `text` is one of them.
void check_choice(std::string_view text, std::string_view flag, const std::vector<std::string>& choices);

/// The parts of a list "a,b,..", each one of `choices` and no two alike. Throws InputError naming the flag.
std::vector<std::string> parse_choices(std::string_view text, std::string_view flag, const std::vector<std::string>& choices);

/// --quiet.
void add_quiet(CLI::App& app, Verbosity& verbosity);

// ---- implementation ----

/// A flag of one string handed to `parse`, with the default's text for --help ("" shows none).
CLI::Option* add_parsed(CLI::App& app, const std::string& flag, const std::function<void(const std::string&)>& parse,
                        const std::string& value_name, const std::string& shown_default, const std::string& help);
/// "{a,b,c}": how --help shows choices.
std::string choices_text(const std::vector<std::string>& choices);

template <class Enum>
CLI::Option* add_choice(CLI::App& app, const std::string& flag, Enum& value,
                        const std::vector<std::pair<std::string, Enum>>& choices, const std::string& help) {
  std::vector<std::string> names;
  std::string shown_default;
  for (const auto& [name, meaning] : choices) {
    names.push_back(name);
    if (meaning == value) shown_default = name;
  }
  const auto parse = [&value, flag, choices, names](const std::string& text) {
    check_choice(text, flag, names);
    for (const auto& [name, meaning] : choices) {
      if (name == text) value = meaning;
    }
  };
  return add_parsed(app, flag, parse, choices_text(names), shown_default, help);
}

}  // namespace quincunx
