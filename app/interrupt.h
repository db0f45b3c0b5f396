// Ctrl-C: a flag that long work looks at.
#pragma once

namespace quincunx {

/// From now on the first SIGINT or SIGTERM sets the flag instead of ending the program; a second one ends it.
void catch_interrupts();

/// Throws Interrupted once the flag is set.
void stop_if_interrupted();

/// 128 + the signal's number: what a shell shows for a program that a signal ended.
int interrupt_status();

}  // namespace quincunx
