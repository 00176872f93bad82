#include "sim/core/interrupt.h"

#include <atomic>
#include <csignal>
#include <utility>

#include "include/rollrig/progress.h"
#include "include/rollrig/stop.h"
#include "sim/core/current_stop.h"
#include "sim/core/error.h"

namespace rollrig {
namespace {

std::atomic<bool> interrupted{false};
thread_local const Stop* stop_of_thread = nullptr;

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
  if (stop_of_thread != nullptr && stop_of_thread->is_requested()) throw Interrupted();
}

const Stop* current_stop() { return stop_of_thread; }

const Stop* exchange_current_stop(const Stop* stop) { return std::exchange(stop_of_thread, stop); }

StopScope::StopScope(const Stop& stop) : before_(exchange_current_stop(&stop)) {}

StopScope::~StopScope() { exchange_current_stop(before_); }

}  // namespace rollrig
