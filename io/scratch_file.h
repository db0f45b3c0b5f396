// A file without a name, for what does not fit memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "io/input_file.h"

namespace quincunx {

/// Written once, then read. It has lost its name before anything is written, so nothing is left of it however the program ends.
/// Every error is an InputError naming --scratch and the folder.
class ScratchFile {
 public:
  /// In `folder`; empty: that of the environment variable TMPDIR, or /tmp. Throws where `bytes` are more than is free there.
  /// `path` is whose content it will be, for messages.
  ScratchFile(std::string folder, std::uint64_t bytes, std::string path);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  /// Appends. Throws where the disk does not take it.
  void write(std::span<const std::byte> bytes);
  /// What was written, to be read; nothing more can be written.
  std::unique_ptr<InputFile> finish();

 private:
  [[noreturn]] void fail(int error) const;

  std::string folder_, path_;
  int descriptor_ = -1;
};

}  // namespace quincunx
