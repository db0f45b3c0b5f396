// Rows of words under headings.
#pragma once

#include <string>
#include <vector>

namespace quincunx {

/// Cells are ASCII; every row is as long as the headings (asserted). The first `left` columns are aligned left, the
/// others right.
struct Table {
  std::vector<std::string> headings;
  std::vector<std::vector<std::string>> rows;
  std::size_t left = 1;
};

/// Aligned columns, two spaces apart; each line ends with a newline.
std::string plain_text(const Table& table);
/// The same as a table of GitHub's Markdown, aligned as text too.
std::string markdown_text(const Table& table);

/// Three significant digits, without an exponent from 1 to 10^6.
std::string three_digits(double x);

}  // namespace quincunx
