/// rollrig_serve: `rollrig serve`, a program of its own, so that rollrig does not link what a server needs.
#include <fmt/format.h>

#include <chrono>
#include <iostream>
#include <memory>
#include <thread>

#include "cli/command.h"
#include "cli/help_formatter.h"
#include "cli/serve_options.h"
#include "serve/server.h"
#include "sim/core/interrupt.h"

namespace rollrig::cli {
namespace {

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
  {
    const serve::Server server(asked);
    std::cout << fmt::format(
                     "rollrig serves this page on this computer only. Open it in a browser:\n\n  {}\n\n"
                     "The address holds a secret: anyone who has it can use the page. Kept pages go to {}/.\n"
                     "Ctrl-C ends it.\n",
                     server.url(), options.keep_folder)
              << std::flush;
    wait_for_interrupt();
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
