#include "app/time_left.h"

#include <fmt/format.h>

#include <cmath>

namespace quincunx {

void TimeLeft::note(double seconds, double fraction) {
  constexpr double apart = 10.0;
  now_ = {seconds, fraction};
  if (seconds - next_.seconds < apart) return;
  from_ = next_;
  next_ = now_;
}

std::optional<double> TimeLeft::seconds() const {
  constexpr double least = 2.0;
  const double took = now_.seconds - from_.seconds, done = now_.fraction - from_.fraction;
  if (took < least || !(done > 0.0)) return std::nullopt;
  return (1.0 - now_.fraction) * took / done;
}

std::string time_left_text(double seconds) {
  if (seconds < 10.0) return "a few seconds left";
  if (seconds < 90.0) return fmt::format("about {:.0f} s left", 10.0 * std::round(seconds / 10.0));
  const double minutes = seconds / 60.0;
  if (minutes < 90.0) return fmt::format("about {:.0f} min left", minutes);
  return fmt::format("about {:.1f} h left", minutes / 60.0);
}

}  // namespace quincunx
