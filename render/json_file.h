// JSON from files that may be damaged, or were never meant for us.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace quincunx {

/// The file as JSON in which no object has a key twice. At most 64 MiB, 2^20 values and 16 levels, so that no file takes up the
/// memory or the stack. Throws InputError naming the file, where in it (by byte) it is not JSON, and `expected` ("a camera file").
nlohmann::json read_json(const std::string& path, std::string_view expected);

/// `json` for a message: on one line, in ASCII, cut short where it is long.
std::string brief(const nlohmann::json& json);

}  // namespace quincunx
