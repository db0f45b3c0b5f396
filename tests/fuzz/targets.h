// One function for each reader of files and flags: what a fuzzer, or the replay of its corpus, feeds it.
//
// Each returns where the input was read, or refused with an InputError of one line that names its file or flag. It aborts with a line on
// standard error for anything else; exceptions of other types end the program.
#pragma once

#include <span>
#include <string_view>

namespace quincunx::fuzz {

/// The bytes of an NRRD file. Its detached data are what follows the first empty line, in the file 901.
/// Reading it whole and box by box give the same, and what was read can be written and read again.
void feed_volume(std::string_view input);

/// The text of a transfer function; one that is read has colours and opacities of 0..1 everywhere.
void feed_transfer_function(std::string_view input);

/// The text of a camera file; one that is read looks along unit vectors.
void feed_camera(std::string_view input);

/// The text of a points file, read to its end or its first error.
void feed_points(std::string_view input);

/// The text of a flag, read as every kind of value there is.
void feed_values(std::string_view input);

struct Target {
  std::string_view name;  ///< also that of its folder in corpus/
  void (*feed)(std::string_view input);
};

/// All of them.
std::span<const Target> targets();

}  // namespace quincunx::fuzz
