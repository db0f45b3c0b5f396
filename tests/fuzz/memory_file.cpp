#include "tests/fuzz/memory_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <stdexcept>

namespace quincunx::fuzz {

MemoryFile::MemoryFile(int descriptor) : descriptor_(descriptor), path_("/proc/self/fd/" + std::to_string(descriptor)) {
  const int made = ::memfd_create("fuzz", MFD_CLOEXEC);
  const bool moved = made >= 0 && ::dup2(made, descriptor_) == descriptor_;
  if (made >= 0) ::close(made);
  if (!moved) throw std::runtime_error("no file in memory: memfd_create failed");
}

MemoryFile::~MemoryFile() { ::close(descriptor_); }

void MemoryFile::write(std::string_view bytes) {
  const bool written = ::ftruncate(descriptor_, 0) == 0 && ::pwrite(descriptor_, bytes.data(), bytes.size(), 0) == ssize_t(bytes.size());
  if (!written) throw std::runtime_error(path_ + ": a file in memory cannot be written");
}

}  // namespace quincunx::fuzz
