// Text as HTML and CSV want it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "bench/table.h"

namespace quincunx {

/// With & < > and quotes as entities.
std::string html_text(std::string_view text);

/// In quotes where CSV (RFC 4180) wants them.
std::string csv_text(const std::string& text);

/// Bytes as base64 (RFC 4648), padded.
std::string base64(std::string_view bytes);

/// What stands beside a row: its class, or nothing.
using RowClass = std::string (*)(const std::vector<std::string>& row);

/// A table that scrolls sideways where it is too wide, its first columns (Table::left) aligned left. Every row has its number in data-row.
std::string html_table(const Table& table, RowClass row_class = nullptr);

/// The style of such tables and of a page around them.
extern const char* const kPageStyle;

}  // namespace quincunx
