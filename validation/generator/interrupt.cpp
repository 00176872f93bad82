#include "validation/generator/interrupt.h"

#include <atomic>
#include <csignal>

namespace blind {
namespace {

std::atomic<bool> was_asked{false};

extern "C" void remember_signal(int number) {
  was_asked = true;
  std::signal(number, SIG_DFL);
}

}  // namespace

void install_interrupt_handler() {
  for (const int number : {SIGINT, SIGTERM}) std::signal(number, remember_signal);
}

void throw_if_interrupted() {
  if (was_asked.load(std::memory_order_relaxed)) throw Interrupted();
}

}  // namespace blind
