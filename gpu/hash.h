// A content hash for cache files: not against an adversary.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace quincunx::gpu {

/// FNV-1a, 128 bits (Fowler, Noll, Vo; offset and prime of the IETF draft draft-eastlake-fnv).
class Hash128 {
 public:
  void add(std::span<const std::byte> bytes);
  /// The text and its length, so that "ab" + "c" differs from "a" + "bc".
  void add(std::string_view text);
  std::uint64_t high() const;
  std::uint64_t low() const;
  std::string hex() const;  ///< 32 lower-case digits

 private:
  __extension__ using Word = unsigned __int128;
  Word state_ = (Word{0x6c62272e07bb0142} << 64) | 0x62b821756295c58d;
};

}  // namespace quincunx::gpu
