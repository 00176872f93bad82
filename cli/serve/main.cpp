/// rollrig_serve: `rollrig serve`, a program of its own, so that rollrig does not link what a server needs.
#include <csignal>

#undef si_value  // of <signal.h>, and a name of sim/core/units.h

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <thread>

#include "cli/command.h"
#include "cli/help_formatter.h"
#include "cli/serve_options.h"
#include "include/rollrig/progress.h"
#include "serve/server.h"
#include "sim/core/interrupt.h"

namespace rollrig::cli {
namespace {

std::atomic<int> interrupts{0};  // written by a signal handler, read by another thread
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler must not wait");

/// The first asks the server to end, the second is for SecondInterrupt, the third ends the process at once.
extern "C" void count_interrupt(int signal_number) {
  request_interrupt();
  if (++interrupts > 1) std::signal(signal_number, SIG_DFL);
}

/// A server may take a while to end: its diagnosis stops at its next step. At a second Ctrl-C the process ends, and the
/// dropped files go before.
class SecondInterrupt {
 public:
  explicit SecondInterrupt(std::string folder) : folder_(std::move(folder)), thread_([this] { watch(); }) {}
  ~SecondInterrupt() {
    has_ended_ = true;
    thread_.join();
  }
  SecondInterrupt(const SecondInterrupt&) = delete;
  SecondInterrupt& operator=(const SecondInterrupt&) = delete;

 private:
  void watch() const {
    constexpr std::chrono::milliseconds kBetweenLooks{20};
    constexpr int kStatus = 128 + SIGINT;  // as a shell reports it
    while (!has_ended_) {
      if (interrupts > 1) {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
        std::_Exit(kStatus);
      }
      std::this_thread::sleep_for(kBetweenLooks);
    }
  }

  std::string folder_;
  std::atomic<bool> has_ended_{false};
  std::thread thread_;  // the last member: it uses the others
};

/// Waits until Ctrl-C or SIGTERM.
void wait_for_interrupt() {
  constexpr std::chrono::milliseconds kBetweenLooks{50};
  try {
    while (true) {
      throw_if_interrupted();
      std::this_thread::sleep_for(kBetweenLooks);
    }
  } catch (const Interrupted&) {  // that is how a server ends
  }
}

int serve_until_interrupt(const ServeOptions& options) {
  serve::ServerOptions asked;
  asked.files = {options.tires, options.rigs, options.vehicles};
  asked.keep_folder = options.keep_folder;
  asked.port = options.port;
  asked.threads = options.threads;
  for (const int signal_number : {SIGINT, SIGTERM}) std::signal(signal_number, count_interrupt);
  {
    auto server = std::make_unique<const serve::Server>(asked);
    const SecondInterrupt second(server->dropped_folder());
    std::cout << fmt::format(
                     "rollrig serves this page on this computer only. Open it in a browser:\n\n  {}\n\n"
                     "The address holds a secret: anyone who has it can use the page. Kept pages go to {}/.\n"
                     "Ctrl-C ends it.\n",
                     server->url(), options.keep_folder)
              << std::flush;
    wait_for_interrupt();
    server.reset();
  }
  std::cout << "ended\n";
  return kDone;
}

int make_and_run(int argc, char** argv) {
  CLI::App app{"Serves the page of rollrig serve", "rollrig_serve"};
  app.formatter(std::make_shared<HelpFormatter>());
  auto options = std::make_shared<ServeOptions>();
  add_serve_options(app, *options);
  const Action action = [options] { return serve_until_interrupt(*options); };
  return parse_and_act(app, action, argc, argv);
}

}  // namespace
}  // namespace rollrig::cli

int main(int argc, char** argv) { return rollrig::cli::run_program(argc, argv, &rollrig::cli::make_and_run); }
