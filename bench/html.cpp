#include "bench/html.h"

#include <fmt/format.h>

#include <cstdint>

namespace quincunx {

const char* const kPageStyle =
    "body{font:15px/1.5 system-ui,sans-serif;max-width:84rem;margin:2rem auto;padding:0 1rem;color:#222;background:#fff}"
    "code{background:#f2f2f2;padding:.1em .3em}.wide{overflow-x:auto}table{border-collapse:collapse;font-size:13px;font-variant-numeric:tabular-nums}"
    "th,td{padding:.2em .6em;text-align:right;border-bottom:1px solid #ddd;white-space:nowrap}th{position:sticky;top:0;background:#fff;border-bottom:2px solid #888}"
    ".text{text-align:left}tr.fail td{background:#fde0dc}tbody tr:hover td{background:#eef4fb}";

std::string html_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      default: result += c;
    }
  }
  return result;
}

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + "\"";
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t n = 0; n < bytes.size(); n += 3) {
    std::uint32_t group = 0;
    for (std::size_t b = 0; b < 3; ++b) group = group << 8 | (n + b < bytes.size() ? std::uint8_t(bytes[n + b]) : 0u);
    for (std::size_t digit = 0; digit < 4; ++digit) text += n + digit <= bytes.size() ? kDigits[group >> (18 - 6 * digit) & 63u] : '=';
  }
  return text;
}

std::string html_table(const Table& table, RowClass row_class) {
  const auto kind = [&](std::size_t column) { return column < table.left ? " class=\"text\"" : ""; };
  std::string text = "<div class=\"wide\"><table>\n<thead><tr>";
  for (std::size_t n = 0; n < table.headings.size(); ++n) text += fmt::format("<th{}>{}</th>", kind(n), html_text(table.headings[n]));
  text += "</tr></thead>\n<tbody>\n";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::string name = row_class ? row_class(table.rows[r]) : std::string();
    text += fmt::format("<tr data-row=\"{}\"{}>", r, name.empty() ? "" : fmt::format(" class=\"{}\"", name));
    for (std::size_t n = 0; n < table.rows[r].size(); ++n) text += fmt::format("<td{}>{}</td>", kind(n), html_text(table.rows[r][n]));
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

}  // namespace quincunx
