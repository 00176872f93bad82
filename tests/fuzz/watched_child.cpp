#include "tests/fuzz/watched_child.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <iostream>
#include <numeric>
#include <stdexcept>

namespace rollrig::fuzz {
namespace {

constexpr unsigned kWaits = 12;  // wall-clock time per CPU time
constexpr int kThrew = 88;       // exit status of the child

/// Of the processor, so that other work on the machine does not count; and of the clock, for what waits for ever.
void set_limit(unsigned most_s) {
  const itimerval limit{{0, 0}, {static_cast<time_t>(most_s), 0}};
  ::setitimer(ITIMER_PROF, &limit, nullptr);
  ::alarm(kWaits * most_s);
}

}  // namespace

struct Watched::Shared {
  std::size_t size;
  std::size_t executions[kMostOutcomes];
  unsigned most_s;
  bool is_complete;  // the work returned
  char input[kMostInput_B];
};

Watched::Watched() {
  void* memory = ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::runtime_error("no shared memory");
  shared_ = static_cast<Shared*>(memory);
}

Watched::~Watched() { ::munmap(shared_, sizeof(Shared)); }

void Watched::begin(const std::string& input, unsigned most_s) {
  shared_->size = std::min(input.size(), sizeof shared_->input);
  std::memcpy(shared_->input, input.data(), shared_->size);
  shared_->most_s = most_s;
  set_limit(most_s);
}

void Watched::end(std::size_t outcome) {
  set_limit(0);
  ++shared_->executions[outcome];
}

std::string Watched::run(const std::function<void()>& work, [[maybe_unused]] std::size_t most_memory_B) {
  shared_->is_complete = false;
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("no child process");
  if (child == 0) {
#ifndef ROLLRIG_SANITIZED  // sanitizers map terabytes
    const rlimit limit{most_memory_B, most_memory_B};
    ::setrlimit(RLIMIT_AS, &limit);
#endif
    std::signal(SIGALRM, SIG_DFL);
    std::signal(SIGPROF, SIG_DFL);
    try {
      work();
    } catch (const std::exception& error) {
      std::cerr << fmt::format("unexpected exception: {}\n", std::string(error.what()).substr(0, 500));
      ::_exit(kThrew);
    }
    shared_->is_complete = true;
    ::_exit(0);  // 0, since a sanitizer replaces only this status by its own
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) throw std::runtime_error("the end of the child process is not known");
  }
  if (WIFEXITED(status)) {
    const int exit_status = WEXITSTATUS(status);
    if (exit_status == 0 && shared_->is_complete) return "";
    return exit_status == kThrew ? "an unexpected exception" : fmt::format("an exit with status {}", exit_status);
  }
  const int signal = WTERMSIG(status);
  if (signal == SIGPROF) return fmt::format("more than {} s of CPU time", shared_->most_s);
  if (signal == SIGALRM) return fmt::format("more than {} s of wall-clock time", kWaits * shared_->most_s);
  return fmt::format("signal {}", signal);
}

std::size_t Watched::executions() const {
  return std::accumulate(std::begin(shared_->executions), std::end(shared_->executions), std::size_t{0});
}

std::size_t Watched::executions_with(std::size_t outcome) const { return shared_->executions[outcome]; }

std::string Watched::last_input() const { return {shared_->input, shared_->size}; }

}  // namespace rollrig::fuzz
