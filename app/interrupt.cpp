#include "app/interrupt.h"

#include <atomic>
#include <csignal>

#include "lattice/error.h"

namespace quincunx {
namespace {

std::atomic<int> caught_signal{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may not lock");

extern "C" void remember_signal(int signal) { caught_signal.store(signal, std::memory_order_relaxed); }

}  // namespace

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = remember_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
}

void stop_if_interrupted() {
  if (caught_signal.load(std::memory_order_relaxed) != 0) throw Interrupted();
}

int interrupt_status() { return 128 + caught_signal.load(std::memory_order_relaxed); }

}  // namespace quincunx
