// The report of `quincunx compare`: error against time as tables, CSV and JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/compare_measure.h"
#include "bench/machine.h"
#include "bench/table.h"

namespace quincunx {

/// Something that a combination gets wrong, as one number: less is better.
struct CompareMetric {
  std::string_view name;   ///< as --error has it
  std::string_view title;  ///< of an axis
  bool against_truth;      ///< only where the truth is known
  std::optional<double> (*value)(const CompareLine& line);
};

/// All of them.
const std::vector<CompareMetric>& compare_metrics();
/// The one of that name; throws InputError (--error) naming the choices.
const CompareMetric& compare_metric(std::string_view name);

struct CompareReport {
  std::string command;  ///< that made it
  Machine machine;
  const CompareSubject* subject = nullptr;  ///< not null
  ComparePlan plan;
  CompareMeasurement measured;
  const CompareMetric* metric = nullptr;  ///< that the tables are about; not null, known for this subject

  /// The metrics that are known for the subject.
  std::vector<const CompareMetric*> metrics() const;
};

/// The median of a line's frames, milliseconds.
double median_ms(const CompareLine& line);

/// The numbers of the lines than which no other is both faster and, by `metric`, less wrong; the fastest first.
std::vector<std::size_t> pareto_front(const std::vector<CompareLine>& lines, const CompareMetric& metric);

struct CompareSection {
  std::string title, caption;
  Table table;
};
/// What was sampled, time and error of every combination, reconstruction alone.
std::vector<CompareSection> compare_sections(const CompareReport& report);

/// What was compared, in a sentence.
std::string compare_caption(const CompareReport& report);
/// One line for each combination, numbers as they are.
std::string compare_csv(const CompareReport& report);
nlohmann::ordered_json compare_json(const CompareReport& report);
std::string compare_text(const CompareReport& report);
std::string compare_markdown(const CompareReport& report);

}  // namespace quincunx
