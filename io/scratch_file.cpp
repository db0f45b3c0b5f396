#include "io/scratch_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "lattice/error.h"

namespace quincunx {
namespace {

std::string default_folder() {
  const char* folder = getenv("TMPDIR");
  return folder != nullptr && *folder != '\0' ? folder : "/tmp";
}

double gib(std::uint64_t bytes) { return double(bytes) / double(1 << 30); }

}  // namespace

ScratchFile::ScratchFile(std::string folder, std::uint64_t bytes, std::string path)
    : folder_(folder.empty() ? default_folder() : std::move(folder)), path_(std::move(path)) {
  struct statvfs space {};
  if (::statvfs(folder_.c_str(), &space) != 0) fail(errno);
  const std::uint64_t free = std::uint64_t(space.f_bavail) * space.f_frsize;
  if (free < bytes)
    throw InputError(fmt::format("--scratch: {} has {:.1f} GiB free, expected {:.1f} GiB for the unpacked samples of {}", folder_,
                                 gib(free), gib(bytes), path_));
  std::string name = folder_ + "/quincunx-XXXXXX";
  descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor_ < 0) fail(errno);
  ::unlink(name.c_str());
}

ScratchFile::~ScratchFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void ScratchFile::fail(int error) const {
  throw InputError(fmt::format("--scratch: cannot keep the unpacked samples of {} in {}: {}", path_, folder_, std::strerror(error)));
}

void ScratchFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(errno);
    bytes = bytes.subspan(std::size_t(written));
  }
}

std::unique_ptr<InputFile> ScratchFile::finish() {
  return std::make_unique<InputFile>(std::exchange(descriptor_, -1), fmt::format("{} (unpacked)", path_));
}

}  // namespace quincunx
