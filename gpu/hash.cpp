#include "gpu/hash.h"

#include <fmt/format.h>

namespace quincunx::gpu {

void Hash128::add(std::span<const std::byte> bytes) {
  constexpr Word kPrime = (Word{1} << 88) | 0x13b;
  for (std::byte byte : bytes) state_ = (state_ ^ static_cast<std::uint8_t>(byte)) * kPrime;
}

void Hash128::add(std::string_view text) {
  const std::uint64_t size = text.size();
  add(std::as_bytes(std::span(&size, 1)));
  add(std::as_bytes(std::span(text)));
}

std::uint64_t Hash128::high() const { return static_cast<std::uint64_t>(state_ >> 64); }
std::uint64_t Hash128::low() const { return static_cast<std::uint64_t>(state_); }
std::string Hash128::hex() const { return fmt::format("{:016x}{:016x}", high(), low()); }

}  // namespace quincunx::gpu
