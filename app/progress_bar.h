// How far a long command is, on a terminal.
#pragma once

#include <chrono>
#include <string>

#include "app/time_left.h"
#include "lattice/progress.h"

namespace quincunx {

enum class Verbosity { quiet, normal };

/// A line on stderr that shows a stage's name, the part done and, where that can be told, the time left. It appears once the command has run for a second, and
/// only where stderr is a terminal; it is erased with the object.
class ProgressBar {
 public:
  explicit ProgressBar(Verbosity verbosity);
  ~ProgressBar() { erase(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// A listener for one stage; valid as long as this object. Throws Interrupted after Ctrl-C, shown or not.
  Progress stage(std::string name);

  /// Removes the line, if it is there.
  void erase();

 private:
  using Clock = std::chrono::steady_clock;
  void show(const std::string& name, double fraction, const TimeLeft& left);

  bool enabled_;
  bool shown_ = false;
  Clock::time_point next_;  ///< when to draw (again)
};

}  // namespace quincunx
