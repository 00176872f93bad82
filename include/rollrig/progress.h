#pragma once
/// How far a call is, and how it is stopped.

#include <functional>
#include <string>

#pragma GCC visibility push(default)
namespace rollrig {

/// Called now and then. `done` is the share of the work, 0 to 1, NaN where its length is not known; `stage` says what
/// is being done, and may be empty. The share falls back to 0 where more work turns out to follow: `diagnose` may
/// repeat itself without one run. Calls of one function come one at a time, but from any of its threads.
using Progress = std::function<void(double done, const std::string& stage)>;

/// Makes every running and later call of the process stop with Interrupted, at its next step. May be called from any
/// thread and from a signal handler.
void request_interrupt();
/// Takes that back.
void clear_interrupt();
/// Makes SIGINT and SIGTERM call request_interrupt(); a second one ends the process at once.
void install_interrupt_handler();

}  // namespace rollrig
#pragma GCC visibility pop
