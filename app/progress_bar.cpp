#include "app/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

#include "app/interrupt.h"

namespace quincunx {

ProgressBar::ProgressBar(Verbosity verbosity)
    : enabled_(verbosity == Verbosity::normal && isatty(STDERR_FILENO) == 1),
      next_(Clock::now() + std::chrono::seconds(1)) {}

Progress ProgressBar::stage(std::string name) {
  return [this, name = std::move(name), start = Clock::now(), left = std::make_shared<TimeLeft>()](double fraction) {
    stop_if_interrupted();
    if (!enabled_) return;
    left->note(std::chrono::duration<double>(Clock::now() - start).count(), fraction);
    show(name, fraction, *left);
  };
}

void ProgressBar::show(const std::string& name, double fraction, const TimeLeft& left) {
  constexpr int width = 30;
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + std::chrono::milliseconds(100);
  shown_ = true;
  const double part = std::clamp(fraction, 0.0, 1.0);
  const int full = int(part * width);
  // Carriage return and "erase to the end of the line" (ECMA-48): each drawing replaces the one before.
  fmt::print(stderr, "\r\033[K{:<12} [{:#<{}}{:.<{}}] {:3.0f} %", name, "", full, "", width - full, 100.0 * part);
  if (const std::optional<double> seconds = left.seconds()) fmt::print(stderr, "  {}", time_left_text(*seconds));
  std::fflush(stderr);
}

void ProgressBar::erase() {
  if (!shown_) return;
  shown_ = false;
  fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
}

}  // namespace quincunx
