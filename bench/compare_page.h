// The report of `quincunx compare` as a page that opens in any browser, with no other file and no network.
#pragma once

#include <string>

#include "bench/compare_report.h"

namespace quincunx {

/// HTML: the chart of error against time, for each error that is known, with its Pareto front; the tables; every first picture with its difference
/// from the truth, or from its reference where that is not known; machine, device and command.
std::string compare_html(const CompareReport& report);

}  // namespace quincunx
