// What `quincunx-bench growth` tells.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/machine.h"
#include "bench/table.h"

namespace quincunx {

/// A way to skip on one field.
struct GrowthLine {
  std::string field, label;
  std::vector<double> frame_ms;  ///< for each size: the median with the best block size
  std::vector<int> block;        ///< that block size; 0 for none
};

/// A whole run.
struct GrowthReport {
  std::vector<int> sizes;  ///< ascending: n of n^3 x 2 samples
  std::vector<int> blocks;
  int width = 0, height = 0, rounds = 0;
  Machine machine;
  std::vector<GrowthLine> lines;
};

/// By which factor a line's time grows from size number n to the next one, for a doubling of the edge.
double growth_per_doubling(const GrowthReport& report, const GrowthLine& line, std::size_t n);

/// One row a line: the times, then the growth from each size to the next.
Table growth_table(const GrowthReport& report);
/// What was measured where, in sentences.
std::string growth_caption(const GrowthReport& report);
/// docs/performance.md names the keys.
nlohmann::ordered_json growth_json(const GrowthReport& report);

}  // namespace quincunx
