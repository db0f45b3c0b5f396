// Progress of work that several threads share.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>

#include "lattice/progress.h"

namespace quincunx {

/// Reports how many of `total` parts are done, from any thread; a thread that finds another one reporting goes on.
class SharedProgress {
 public:
  SharedProgress(const Progress& progress, std::int64_t total) : progress_(progress), total_(total) {}
  void add(std::int64_t parts) {
    const std::int64_t done = done_ += parts;
    if (const std::unique_lock lock(mutex_, std::try_to_lock); lock) report(progress_, double(done) / double(total_));
  }

 private:
  const Progress& progress_;
  const std::int64_t total_;
  std::atomic<std::int64_t> done_{0};
  std::mutex mutex_;
};

}  // namespace quincunx
