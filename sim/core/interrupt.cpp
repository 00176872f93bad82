#include "sim/core/interrupt.h"

#include <atomic>
#include <csignal>

#include "include/rollrig/progress.h"
#include "sim/core/error.h"

namespace rollrig {
namespace {

std::atomic<bool> interrupted{false};

extern "C" void note_interrupt(int signal_number) {
  request_interrupt();
  std::signal(signal_number, SIG_DFL);
}

}  // namespace

void request_interrupt() { interrupted = true; }

void clear_interrupt() { interrupted = false; }

void install_interrupt_handler() {
  std::signal(SIGINT, note_interrupt);
  std::signal(SIGTERM, note_interrupt);
  if (std::signal(SIGHUP, note_interrupt) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup: the terminal may close
}

void throw_if_interrupted() {
  if (interrupted.load(std::memory_order_relaxed)) throw Interrupted();
}

}  // namespace rollrig
