// How long work tells how far it is, and learns that it should stop.
#pragma once

#include <functional>

namespace quincunx {

/// Called now and then with the fraction done, 0..1, never from two threads at once.
/// May throw Interrupted, which the long work lets through, leaving nothing half-written.
/// An empty function is allowed everywhere and means that nobody listens.
using Progress = std::function<void(double fraction)>;

/// Calls `progress` where there is one.
inline void report(const Progress& progress, double fraction) {
  if (progress) progress(fraction);
}

}  // namespace quincunx
