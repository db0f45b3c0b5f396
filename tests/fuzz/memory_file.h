// A file whose content changes a million times and never touches a disk.
#pragma once

#include <string>
#include <string_view>

namespace quincunx::fuzz {

/// A regular file in memory, with a path that any reader can open.
class MemoryFile {
 public:
  /// `descriptor`, which nobody uses yet, is its number: the file's name in the folder /proc/self/fd. Throws std::runtime_error where the
  /// system has none to give.
  explicit MemoryFile(int descriptor);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const std::string& path() const { return path_; }
  /// Makes `bytes` the whole content. Throws std::runtime_error where the system does not take them.
  void write(std::string_view bytes);

 private:
  int descriptor_;
  std::string path_;
};

}  // namespace quincunx::fuzz
