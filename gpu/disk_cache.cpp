#include "gpu/disk_cache.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "gpu/hash.h"

namespace quincunx::gpu {
namespace {

namespace fs = std::filesystem;

struct Head {
  std::array<char, 8> magic = {'Q', 'X', 'C', 'A', 'C', 'H', 'E', '1'};
  std::uint64_t bytes = 0;
  std::uint64_t hash[2] = {0, 0};
};
static_assert(sizeof(Head) == 32);

Head make_head(std::span<const std::byte> content) {
  Hash128 hash;
  hash.add(content);
  Head head;
  head.bytes = content.size();
  head.hash[0] = hash.high();
  head.hash[1] = hash.low();
  return head;
}

std::string user_cache_folder() {
  const char* xdg = std::getenv("XDG_CACHE_HOME");
  if (xdg && fs::path(xdg).is_absolute()) return (fs::path(xdg) / "quincunx").string();
  const char* home = std::getenv("HOME");
  if (home && fs::path(home).is_absolute()) return (fs::path(home) / ".cache" / "quincunx").string();
  return "";
}

bool write_file(const fs::path& path, std::span<const std::byte> content) {
  const Head head = make_head(content);
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(&head), sizeof(head));
  file.write(reinterpret_cast<const char*>(content.data()), static_cast<std::streamsize>(content.size()));
  file.close();
  return file.good();
}

}  // namespace

std::string prepare_cache_folder(const std::string& asked) {
  const std::string folder = asked.empty() ? user_cache_folder() : asked;
  if (folder.empty()) return "";
  std::error_code error;
  fs::create_directories(folder, error);
  return fs::is_directory(folder, error) ? folder : "";
}

std::optional<std::vector<std::byte>> read_cached(const std::string& folder, const std::string& name) {
  if (folder.empty()) return std::nullopt;
  std::ifstream file(fs::path(folder) / name, std::ios::binary);
  const std::vector<char> all((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (all.size() < sizeof(Head)) return std::nullopt;
  const auto bytes = std::as_bytes(std::span(all));
  const auto content = bytes.subspan(sizeof(Head));
  const Head expected = make_head(content);
  if (std::memcmp(bytes.data(), &expected, sizeof(Head)) != 0) return std::nullopt;
  return std::vector<std::byte>(content.begin(), content.end());
}

void write_cached(const std::string& folder, const std::string& name, std::span<const std::byte> content) {
  if (folder.empty()) return;
  static std::atomic<unsigned> counter = 0;
  const fs::path target = fs::path(folder) / name;
  const fs::path beside = target.string() + fmt::format(".{}.{}.tmp", getpid(), counter++);
  std::error_code error;
  if (write_file(beside, content)) fs::rename(beside, target, error);
  if (error || fs::exists(beside, error)) fs::remove(beside, error);
}

}  // namespace quincunx::gpu
