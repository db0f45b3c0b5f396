// Small files by name in the cache folder, each with its checksum. Private to gpu/.
//
// A file, in the machine's byte order, by offset:
//   0 "QXCACHE1"   8 bytes of content (uint64)   16 its hash (2 x uint64)   32 the content
//
// A cache never fails: what cannot be read is missing, what cannot be written is not kept.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace quincunx::gpu {

/// `asked`, or the user's cache folder where it is empty; created where missing. "" where there is none.
std::string prepare_cache_folder(const std::string& asked);

/// Empty where the file is missing, cut short or altered. `folder` "" always is.
std::optional<std::vector<std::byte>> read_cached(const std::string& folder, const std::string& name);

/// Writes beside, then renames: readers in other processes see the old file or the new one.
void write_cached(const std::string& folder, const std::string& name, std::span<const std::byte> content);

}  // namespace quincunx::gpu
