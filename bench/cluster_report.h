// What `quincunx-bench cluster` tells.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/cluster_measure.h"
#include "bench/machine.h"
#include "bench/table.h"

namespace quincunx {

/// A whole run.
struct ClusterReport {
  int max_cluster = 16, rounds = 0;
  Machine machine;
  std::vector<ClusterLine> lines;
};

/// One row a mask: blocks, leaves, medians of the times.
Table cluster_table(const ClusterReport& report);
/// What was measured where, and the published figures, in sentences.
std::string cluster_caption(const ClusterReport& report);
/// docs/performance.md names the keys.
nlohmann::ordered_json cluster_json(const ClusterReport& report);

}  // namespace quincunx
