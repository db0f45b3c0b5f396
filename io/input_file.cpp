#include "io/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstring>

#include "lattice/error.h"

namespace quincunx {

InputFile::InputFile(std::string path) : path_(std::move(path)) {
  // O_NONBLOCK: a pipe nobody writes to must be refused, not waited for.
  descriptor_ = ::open(path_.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0) throw InputError(fmt::format("{}: cannot be read: {}", path_, std::strerror(errno)));
  take_size();
}

InputFile::InputFile(int descriptor, std::string path) : path_(std::move(path)), descriptor_(descriptor) { take_size(); }

void InputFile::take_size() {
  struct stat status {};
  const bool known = ::fstat(descriptor_, &status) == 0;
  if (!known || !S_ISREG(status.st_mode)) {
    ::close(descriptor_);
    throw InputError(fmt::format("{}: cannot be read: found {}, expected a regular file", path_,
                                 known && S_ISDIR(status.st_mode) ? "a folder" : "a special file"));
  }
  size_ = std::uint64_t(status.st_size);
}

InputFile::~InputFile() { ::close(descriptor_); }

std::size_t InputFile::read(void* to, std::size_t bytes) {
  const std::size_t wanted = std::size_t(std::min<std::uint64_t>(bytes, remaining()));
  read_at(position_, to, wanted);
  position_ += wanted;
  return wanted;
}

void InputFile::read_at(std::uint64_t position, void* to, std::size_t bytes) const {
  assert(position <= size_ && bytes <= size_ - position);
  std::size_t done = 0;
  while (done < bytes) {
    const ssize_t got = ::pread(descriptor_, static_cast<char*>(to) + done, bytes - done, off_t(position + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw InputError(fmt::format("{}: cannot be read: {}", path_, std::strerror(errno)));
    if (got == 0) throw InputError(fmt::format("{}: became shorter while it was read", path_));
    done += std::size_t(got);
  }
}

void InputFile::seek(std::uint64_t position) {
  assert(position <= size_);
  position_ = position;
}

}  // namespace quincunx
