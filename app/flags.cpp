#include "app/flags.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "app/values.h"
#include "lattice/error.h"
#include "lattice/quote.h"

namespace quincunx {
namespace {

std::string interval_text(const Interval& i) {
  if (std::isinf(i.high)) return fmt::format("a finite number {} {}", i.open_low ? "above" : "of at least", i.low);
  return fmt::format("a number {} {} and at most {}", i.open_low ? "above" : "of at least", i.low, i.high);
}

int parse_power_of_two(std::string_view text, std::string_view flag, int low, int high) {
  const std::int64_t n = parse_integer(text, flag, low, high);
  if (!std::has_single_bit(std::uint64_t(n))) throw InputError(fmt::format("{}: found {}, expected a power of two from {} to {}", flag, text, low, high));
  return int(n);
}

}  // namespace

CLI::Option* add_parsed(CLI::App& app, const std::string& flag, const std::function<void(const std::string&)>& parse,
                        const std::string& value_name, const std::string& shown_default, const std::string& help) {
  CLI::Option* option = app.add_option_function<std::string>(flag, parse, help)->type_name(value_name);
  if (!shown_default.empty()) option->default_str(shown_default);
  return option;
}

CLI::Option* add_number(CLI::App& app, const std::string& flag, double& value, Interval interval,
                        const std::string& help) {
  const auto parse = [&value, flag, interval](const std::string& text) {
    const double x = parse_number(text, flag);
    const bool inside = (interval.open_low ? x > interval.low : x >= interval.low) && x <= interval.high;
    if (!inside) throw InputError(fmt::format("{}: found {}, expected {}", flag, text, interval_text(interval)));
    value = x;
  };
  return add_parsed(app, flag, parse, "NUMBER", fmt::format("{}", value), help);
}

CLI::Option* add_integer(CLI::App& app, const std::string& flag, int& value, int low, int high,
                         const std::string& help) {
  const auto parse = [&value, flag, low, high](const std::string& text) {
    value = int(parse_integer(text, flag, low, high));
  };
  return add_parsed(app, flag, parse, "N", fmt::format("{}", value), help);
}

CLI::Option* add_vector(CLI::App& app, const std::string& flag, glm::dvec3& value, const std::string& help) {
  const auto parse = [&value, flag](const std::vector<std::string>& texts) {
    for (int axis = 0; axis < 3; ++axis) value[axis] = parse_number(texts[std::size_t(axis)], flag);
  };
  return app.add_option_function<std::vector<std::string>>(flag, parse, help)
      ->type_name("X Y Z")
      ->type_size(3)
      ->expected(1);
}

CLI::Option* add_size(CLI::App& app, int& width, int& height) {
  const auto parse = [&width, &height](const std::vector<std::string>& texts) {
    constexpr int most = 16384;
    width = int(parse_integer(texts[0], "--size", 1, most));
    height = int(parse_integer(texts[1], "--size", 1, most));
  };
  return app.add_option_function<std::vector<std::string>>("--size", parse, "Pixels")
      ->type_name("W H")
      ->type_size(2)
      ->expected(1)
      ->default_str(fmt::format("{} {}", width, height));
}

int parse_block(std::string_view text, std::string_view flag) { return parse_power_of_two(text, flag, 1, 256); }
int parse_brick(std::string_view text, std::string_view flag) { return parse_power_of_two(text, flag, 4, 256); }

CLI::Option* add_block(CLI::App& app, int& block) {
  const auto parse = [&block](const std::string& text) { block = parse_block(text, "--block"); };
  return add_parsed(app, "--block", parse, "N", block == 0 ? "what fits" : fmt::format("{}", block),
                    "Edge of the structure's blocks in cells, a power of two");
}

CLI::Option* add_device(CLI::App& app, std::string& device) {
  return app
      .add_option("--device", device, "Index or part of a name of `quincunx devices`, or cpu; else the best there is")
      ->type_name("D");
}

CLI::Option* add_choice_name(CLI::App& app, const std::string& flag, std::string& value,
                             const std::vector<std::string>& choices, const std::string& help) {
  const auto parse = [&value, flag, choices](const std::string& text) {
    check_choice(text, flag, choices);
    value = text;
  };
  return add_parsed(app, flag, parse, choices_text(choices), value, help);
}

void check_choice(std::string_view text, std::string_view flag, const std::vector<std::string>& choices) {
  if (std::find(choices.begin(), choices.end(), text) != choices.end()) return;
  throw InputError(fmt::format("{}: found {}, expected one of {}", flag, in_quotes(text), fmt::join(choices, ", ")));
}

std::vector<std::string> parse_choices(std::string_view text, std::string_view flag, const std::vector<std::string>& choices) {
  std::vector<std::string> names;
  for (const std::string_view name : split_list(text)) {
    check_choice(name, flag, choices);
    if (std::find(names.begin(), names.end(), name) != names.end())
      throw InputError(fmt::format("{}: found {} twice, expected different ones", flag, name));
    names.emplace_back(name);
  }
  return names;
}

std::string choices_text(const std::vector<std::string>& choices) {
  return fmt::format("{{{}}}", fmt::join(choices, ","));
}

void add_quiet(CLI::App& app, Verbosity& verbosity) {
  app.add_flag_callback(
      "--quiet", [&verbosity] { verbosity = Verbosity::quiet; }, "No progress and no summary");
}

}  // namespace quincunx
