// The report of `quincunx stability`: tables, CSV, JSON, and a page that opens in any browser.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/known_roots.h"
#include "bench/machine.h"
#include "bench/stability_measure.h"
#include "bench/table.h"
#include "bench/watertight.h"

namespace quincunx {

struct StabilityReport {
  std::string command;  ///< that made it
  Machine machine;
  double step = 0.0;       ///< of the march, cells
  std::uint32_t seed = 1;
  std::vector<StabilityLine> lines;
  std::vector<RootsLine> roots;
  std::vector<WatertightLine> watertight;
};

/// How many of everything measured passed, and of how many.
struct StabilityScore {
  std::size_t passed = 0, all = 0;
};
StabilityScore stability_score(const StabilityReport& report);

/// A heading, what the columns mean, and the rows; only of what was measured.
struct StabilitySection {
  std::string title, caption;
  Table table;
};
std::vector<StabilitySection> stability_sections(const StabilityReport& report);

/// One line for each case and spline, numbers as they are.
std::string stability_csv(const StabilityReport& report);
nlohmann::ordered_json stability_json(const StabilityReport& report);
std::string stability_markdown(const StabilityReport& report);
/// One file without scripts that refers to no other.
std::string stability_html(const StabilityReport& report);

}  // namespace quincunx
