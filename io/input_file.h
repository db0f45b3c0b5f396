// A file to be read, whose length is known before anything is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace quincunx {

/// A regular file open for reading, at its beginning. Every error is an InputError naming the file.
class InputFile {
 public:
  /// Throws where the file cannot be opened or is no regular file (a folder; a pipe or device, which has no length).
  explicit InputFile(std::string path);
  /// Takes over an open descriptor, which may have no name; `path` is for messages.
  InputFile(int descriptor, std::string path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::string& path() const { return path_; }
  std::uint64_t size() const { return size_; }
  /// Bytes from the position to the end (as long as the file was when opened).
  std::uint64_t remaining() const { return size_ - position_; }
  /// Reads up to `bytes` and moves on; fewer only at the end of the file.
  std::size_t read(void* to, std::size_t bytes);
  /// Reads the `bytes` from `position` on, which are all there when the file was opened (asserted), and leaves the position. May be called
  /// from several threads at once.
  void read_at(std::uint64_t position, void* to, std::size_t bytes) const;
  /// Moves to `position` from the beginning, at most size().
  void seek(std::uint64_t position);

 private:
  /// Checks the descriptor and takes the file's length; closes it where it throws.
  void take_size();

  std::string path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0, position_ = 0;
};

}  // namespace quincunx
