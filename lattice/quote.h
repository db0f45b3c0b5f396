// What a user wrote, as messages show it.
#pragma once

#include <string>
#include <string_view>

namespace quincunx {

/// `text` in single quotes: one line of printable ASCII, other bytes as \x0a, shortened after 60 bytes.
std::string in_quotes(std::string_view text);

}  // namespace quincunx
