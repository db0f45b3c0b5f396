#include "bench/skip_lists.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "accel/structure.h"
#include "app/flags.h"
#include "app/values.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

template <class T>
void add_new(std::vector<T>& values, T value, const std::string& flag) {
  if (std::find(values.begin(), values.end(), value) != values.end())
    throw InputError(fmt::format("{}: found {} twice, expected different ones", flag, value));
  values.push_back(std::move(value));
}

}  // namespace

CLI::Option* add_structures(CLI::App& app, std::vector<std::string>& labels) {
  const std::vector<std::string> choices(skip_labels().begin(), skip_labels().end());
  const auto parse = [&labels, choices](const std::string& text) { labels = parse_choices(text, "--structures", choices); };
  return add_parsed(app, "--structures", parse, "L[,L...]", "", fmt::format("Some of {}; else all", fmt::join(choices, ", ")));
}

CLI::Option* add_blocks(CLI::App& app, const std::string& flag, std::vector<int>& blocks) {
  const auto parse = [&blocks, flag](const std::string& text) {
    blocks.clear();
    for (const std::string_view block : split_list(text)) add_new(blocks, parse_block(block, flag), flag);
    std::sort(blocks.begin(), blocks.end());
  };
  return add_parsed(app, flag, parse, "N[,N...]", fmt::format("{}", fmt::join(blocks, ",")),
                    "Edges of the structures' blocks in cells, powers of two");
}

std::vector<int> parse_bricks(const std::string& text) {
  std::vector<int> bricks;
  for (const std::string_view brick : split_list(text)) add_new(bricks, parse_brick(brick, "--bricks"), "--bricks");
  std::sort(bricks.begin(), bricks.end());
  return bricks;
}

void refuse_reference(std::string_view device) {
  if (device == "cpu") throw InputError("--device: found cpu, expected a Vulkan device: the reference walks no structure");
}

}  // namespace quincunx
