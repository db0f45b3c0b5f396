#include "bench/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace quincunx {
namespace {

using Row = std::vector<std::string>;

std::vector<std::size_t> column_widths(const Table& table) {
  std::vector<std::size_t> widths;
  for (const std::string& heading : table.headings) widths.push_back(heading.size());
  for (const Row& row : table.rows) {
    assert(row.size() == widths.size());
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  }
  return widths;
}

/// The cells of a row, padded, with `before`, `between` and `after` around them.
std::string line(const Table& table, const Row& row, const char* before, const char* between, const char* after) {
  const std::vector<std::size_t> widths = column_widths(table);
  std::string text = before;
  for (std::size_t c = 0; c < row.size(); ++c) {
    if (c > 0) text += between;
    text += c < table.left ? fmt::format("{:<{}}", row[c], widths[c]) : fmt::format("{:>{}}", row[c], widths[c]);
  }
  return text + after + "\n";
}

}  // namespace

std::string plain_text(const Table& table) {
  std::string text = line(table, table.headings, "", "  ", "");
  for (const Row& row : table.rows) text += line(table, row, "", "  ", "");
  return text;
}

std::string markdown_text(const Table& table) {
  std::string text = line(table, table.headings, "| ", " | ", " |");
  const std::vector<std::size_t> widths = column_widths(table);
  for (std::size_t c = 0; c < widths.size(); ++c) {
    const std::string dashes(std::max<std::size_t>(widths[c], 2) + 1, '-');
    text += c < table.left ? "|:" + dashes : "|" + dashes + ":";
  }
  text += "|\n";
  for (const Row& row : table.rows) text += line(table, row, "| ", " | ", " |");
  return text;
}

std::string three_digits(double x) {
  return x >= 100.0 && x < 1e6 ? fmt::format("{:.0f}", x) : fmt::format("{:.3g}", x);
}

}  // namespace quincunx
