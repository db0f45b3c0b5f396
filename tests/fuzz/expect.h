// What every reader promises.
#pragma once

#include <string_view>

#include "lattice/error.h"

namespace quincunx::fuzz {

/// Says on standard error what was expected and aborts, unless it `held`.
void expect(bool held, std::string_view what);

/// Expects one line, not longer than a screen or two, that holds `name`, the file's or flag's.
void expect_message(std::string_view message, std::string_view name);

/// Whether `read` returned; where it threw an InputError, its message is looked at.
template <class Read>
bool accepts(std::string_view name, Read read) {
  try {
    read();
    return true;
  } catch (const InputError& error) {
    expect_message(error.what(), name);
    return false;
  }
}

}  // namespace quincunx::fuzz
