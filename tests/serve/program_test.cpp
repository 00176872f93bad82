// `rollrig serve` as a person starts and ends it.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#undef si_value

#include <catch2/catch.hpp>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "build_paths.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace fs = std::filesystem;
using namespace rollrig::tests;

namespace {

/// Starts the program with its temporary files and output in `folder`.
pid_t start(const TemporaryFolder& folder) {
  const pid_t child = fork();
  if (child == 0) {
    setenv("TMPDIR", folder.path().c_str(), 1);
    const std::string out = folder.file("out");
    if (freopen(out.c_str(), "w", stdout) == nullptr) _exit(1);
    execl(ROLLRIG_PROGRAM, "rollrig", "serve", static_cast<char*>(nullptr));
    _exit(1);
  }
  return child;
}

template <class Condition>
bool is_soon(Condition&& condition) {
  for (int i = 0; i < 200; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

}  // namespace

TEST_CASE("Ctrl-C and SIGTERM end rollrig serve, and nothing is left", "[slow]") {
  for (const int signal_number : {SIGINT, SIGTERM}) {
    const TemporaryFolder folder;
    const pid_t server = start(folder);
    REQUIRE(is_soon([&] { return read_file(folder.file("out")).find("?token=") != std::string::npos; }));
    CHECK(folder.entry_count() == 2);  // the output, and the folder of dropped files
    kill(server, signal_number);
    int status = -1;
    const bool has_ended = is_soon([&] { return waitpid(server, &status, WNOHANG) == server; });
    if (!has_ended) kill(server, SIGKILL), waitpid(server, &status, 0);
    CHECK(has_ended);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
    CHECK(folder.entry_count() == 1);
    CHECK_THAT(read_file(folder.file("out")), Catch::EndsWith("ended\n"));
  }
}

TEST_CASE("a second Ctrl-C ends rollrig serve, and nothing is left", "[slow]") {
  const TemporaryFolder folder;
  const pid_t server = start(folder);
  REQUIRE(is_soon([&] { return read_file(folder.file("out")).find("?token=") != std::string::npos; }));
  kill(server, SIGINT);
  std::this_thread::sleep_for(std::chrono::milliseconds(5));  // before the first is looked at
  kill(server, SIGINT);
  int status = -1;
  const bool has_ended = is_soon([&] { return waitpid(server, &status, WNOHANG) == server; });
  if (!has_ended) kill(server, SIGKILL), waitpid(server, &status, 0);
  CHECK(has_ended);
  CHECK(WIFEXITED(status));  // with 130, or 0 where the server was quicker
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("rollrig serve refuses wrong files and ports before it serves", "[fast]") {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& options, const std::string& says) {
    const ProgramResult run = run_program("serve " + options, folder.path());
    INFO(run.out << run.err);
    CHECK(run.status == 2);
    CHECK_THAT(flatten(run.err), Catch::Contains(says));
    CHECK(run.out.empty());
  };
  refused("--tire nowhere.toml", "nowhere.toml");
  refused("--port 0", "--port");
  refused("--port 70000", "--port");
  refused("--port x", "--port");
  refused("--keep ''", "--keep");
  refused("--rigs road", "--rig");
}
