// The errors that are a user's to mend: data and arguments.
#pragma once

#include <stdexcept>
#include <string>

namespace quincunx {

/// Bad input: a file, a flag or a value. The message is one line that names the file or flag,
/// says what was found and what was expected. The program ends with exit status 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The user asked to stop (Ctrl-C); thrown by a Progress callback, passed through by long work.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

}  // namespace quincunx
