// Flags of programs that compare ways to skip.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace quincunx {

/// "--structures L[,L...]": labels of skip_labels(), no two alike.
CLI::Option* add_structures(CLI::App& app, std::vector<std::string>& labels);

/// A flag of edges of blocks, powers of two from 1 to 256, no two alike; `blocks` ascends and holds the default.
CLI::Option* add_blocks(CLI::App& app, const std::string& flag, std::vector<int>& blocks);

/// The edges of bricks in `text`, "N[,N...]" of --bricks: powers of two from 4 to 256, no two alike; ascending.
std::vector<int> parse_bricks(const std::string& text);

/// Throws InputError where --device names the reference, which walks none of them.
void refuse_reference(std::string_view device);

}  // namespace quincunx
