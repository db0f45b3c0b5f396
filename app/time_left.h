// How long something will still take.
#pragma once

#include <optional>
#include <string>

namespace quincunx {

/// Tells the time left from the pace of the last 10 to 20 seconds: work that goes slower first and faster then is not
/// judged by its beginning.
class TimeLeft {
 public:
  /// `fraction` (0..1) was done `seconds` after the start; neither descends from call to call.
  void note(double seconds, double fraction);
  /// Nothing in the first two seconds, and where nothing got done.
  std::optional<double> seconds() const;

 private:
  struct Mark {
    double seconds = 0.0, fraction = 0.0;
  };
  Mark from_, next_;  ///< where the pace is taken from, and what takes its place 10 seconds later
  Mark now_;
};

/// "about 2 min left".
std::string time_left_text(double seconds);

}  // namespace quincunx
