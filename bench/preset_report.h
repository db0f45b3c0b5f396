// What a preset of `quincunx sweep` tells: one table, and the drawing where the publication has one.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/machine.h"
#include "bench/table.h"

namespace quincunx {

struct Preset;

/// A drawing of columns of the table, by their names.
struct PresetPanel {
  std::string title;
  std::string x;       ///< words: a group of bars for each; numbers: along the axis, and lines
  std::string series;  ///< words: a bar of each group, or a line
  std::string y;
  std::string low = {}, high = {};              ///< ends of a bar's whisker; both or none
  std::string where = {}, where_is = {};        ///< only rows of this word in this column
  std::string x_label = {}, y_label = {};
  bool y_logarithmic = false;
};

/// A whole run.
struct PresetReport {
  const Preset* preset = nullptr;  ///< not null
  std::string setup;               ///< what was measured, in sentences; may be empty
  std::vector<std::string> notes;  ///< sentences, to stand behind
  bool full = false, whole = true;  ///< whole: nothing is missing
  Machine machine;
  std::vector<std::string> columns;  ///< names of the rows' values, as in JSON: words are parted by "_"
  std::size_t left = 1;              ///< of the columns, those that are words
  std::vector<std::vector<nlohmann::ordered_json>> rows;  ///< numbers, words, or null for what there is none of
  std::vector<PresetPanel> panels;   ///< side by side; none where there is no drawing
  std::vector<std::string> differing;  ///< settings whose pictures are not those of none; there should be none
  std::size_t compared = 0;            ///< settings whose pictures were compared

  /// Number of a column (asserted to be there).
  std::size_t column(std::string_view name) const;
};

/// Whether all pictures were the same; empty where none was made.
std::string preset_pictures(const PresetReport& report);
/// What was measured where, after whom, and what they printed, in sentences.
std::string preset_caption(const PresetReport& report);
Table preset_table(const PresetReport& report);

/// `measurement` (`preset`), `preset`, `paper`, `published`, ..., `rows`: objects with the columns' names.
nlohmann::ordered_json preset_json(const PresetReport& report);
/// A line of the columns' names, then the rows; what does not exist is empty.
std::string preset_csv(const PresetReport& report);
std::string preset_markdown(const PresetReport& report);
std::string preset_text(const PresetReport& report);

}  // namespace quincunx
