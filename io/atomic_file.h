// Files that appear whole or not at all.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace quincunx {

/// A file in the making: written as `path`.tmp-<pid> beside its place, renamed to `path` by commit().
/// Destroyed before that (an error, an interrupt), it removes what it wrote and leaves `path` as it was.
class AtomicFile {
 public:
  /// Creates the temporary file. Throws InputError, naming `path`, where that cannot be done or where `path`
  /// is something else than a regular file (a folder, a device).
  explicit AtomicFile(std::string path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Where to write, for a library that opens files by itself.
  const std::string& temporary() const { return temporary_; }
  /// Appends to the temporary file. Throws InputError where the disk does not take it.
  void write(std::span<const std::byte> bytes);
  /// Closes the temporary file and gives it its name. Throws InputError.
  void commit();

 private:
  [[noreturn]] void fail(const char* what, int error) const;
  void close();

  std::string path_, temporary_;
  int descriptor_ = -1;
  bool committed_ = false;
};

/// Throws InputError unless `path` could be written now: so that a long job does not fail at its end.
void check_writable(const std::string& path);

/// Makes `text` the content of the file `path`. Throws InputError like AtomicFile.
void write_text(std::string_view text, const std::string& path);

}  // namespace quincunx
