#include "tests/fuzz/watched_child.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <exception>
#include <iostream>
#include <stdexcept>

namespace rollrig::fuzz {
namespace {

/// Of the processor, so that other work on the machine does not count; and of the clock, for what waits for ever.
void set_limit(unsigned most_s) {
  constexpr unsigned kWaits = 12;
  const itimerval limit{{0, 0}, {static_cast<time_t>(most_s), 0}};
  ::setitimer(ITIMER_PROF, &limit, nullptr);
  ::alarm(kWaits * most_s);
}

}  // namespace

struct Watched::Shared {
  std::size_t size;
  std::size_t executions;
  unsigned most_s;
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

void Watched::end() {
  set_limit(0);
  ++shared_->executions;
}

std::string Watched::run(const std::function<void()>& work, [[maybe_unused]] std::size_t most_memory_B) {
  [[maybe_unused]] constexpr std::size_t kOfLibraries_B = 1UL << 29;  // Assumed: address space
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("no child process");
  if (child == 0) {
#ifndef ROLLRIG_SANITIZED  // sanitizers map terabytes
    const rlimit limit{most_memory_B + kOfLibraries_B, most_memory_B + kOfLibraries_B};
    ::setrlimit(RLIMIT_AS, &limit);
#endif
    std::signal(SIGALRM, SIG_DFL);
    std::signal(SIGPROF, SIG_DFL);
    try {
      work();
    } catch (const std::exception& error) {
      std::cerr << fmt::format("unexpected exception: {}\n", std::string(error.what()).substr(0, 500));
      ::_exit(1);
    }
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WIFEXITED(status)) return WEXITSTATUS(status) == 0 ? "" : "an unexpected exception";
  const int signal = WTERMSIG(status);
  const bool is_late = signal == SIGPROF || signal == SIGALRM;
  return is_late ? fmt::format("more than {} s", shared_->most_s) : fmt::format("signal {}", signal);
}

std::size_t Watched::executions() const { return shared_->executions; }

std::string Watched::last_input() const { return {shared_->input, shared_->size}; }

}  // namespace rollrig::fuzz
