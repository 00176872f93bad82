/// fuzz_readers: gives changed inputs to the readers, in a child process, and says which input ends it.
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <chrono>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "build_paths.h"
#include "sim/core/file_io.h"
#include "tests/fuzz/mutator.h"
#include "tests/fuzz/target.h"
#include "tests/support/temporary_folder.h"

namespace fs = std::filesystem;
using namespace rollrig;
using namespace rollrig::fuzz;

namespace {

constexpr std::size_t kMostBytes = 1 << 17;
constexpr unsigned kHang_s = 5;              // for one input
constexpr rlim_t kMostMemory_B = 1UL << 30;  // beyond what the program holds at its start
constexpr rlim_t kAtStart_B = 1UL << 29;     // Assumed: address space of its libraries
const fs::path kFormer = fs::path(ROLLRIG_SOURCE_DIR) / "tests/fuzz/crashes";

/// What the child shows the parent while it works.
struct Shared {
  std::size_t size;
  std::size_t executions;
  char input[2 * kMostBytes];
};

Shared& share() {
  void* memory = ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::runtime_error("no shared memory");
  return *static_cast<Shared*>(memory);
}

void execute_watched(const Target& target, const std::string& input, const std::string& folder, Shared& shared) {
  shared.size = std::min(input.size(), sizeof shared.input);
  std::memcpy(shared.input, input.data(), shared.size);
  ::alarm(kHang_s);
  try {
    execute(target, input, folder);
  } catch (const std::exception& error) {
    std::cerr << fmt::format("{}: unexpected exception: {}\n", target.name, std::string(error.what()).substr(0, 500));
    ::_exit(1);
  }
  ::alarm(0);
  ++shared.executions;
}

std::vector<std::string> list_former(const Target& target) {
  std::vector<std::string> inputs;
  if (!fs::is_directory(kFormer / target.name)) return inputs;
  for (const auto& entry : fs::directory_iterator(kFormer / target.name)) {
    inputs.push_back(tests::read_file(entry.path().string()));
  }
  return inputs;
}

std::vector<std::string> list_inputs(const Target& target) {
  std::vector<std::string> inputs = list_former(target);
  for (std::string& seed : target.make_seeds()) inputs.push_back(std::move(seed));
  return inputs;
}

struct Options {
  std::vector<std::string> targets;
  double seconds = 1.0;
  std::uint64_t seed = 1;
  std::string out = ".";
  std::string write_seeds;
  std::vector<std::string> replay;
};

/// The child: former mistakes and seeds as they are, then changed ones until the time is over.
[[noreturn]] void work(const Target& target, const Options& options, Shared& shared) {
  const rlimit limit{kMostMemory_B + kAtStart_B, kMostMemory_B + kAtStart_B};
  ::setrlimit(RLIMIT_AS, &limit);
  const tests::TemporaryFolder folder;
  const std::vector<std::string> inputs = list_inputs(target);
  for (const std::string& input : inputs) execute_watched(target, input, folder.path(), shared);
  Engine engine(options.seed);
  const auto start = std::chrono::steady_clock::now();
  const auto is_over = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > options.seconds;
  };
  while (!is_over()) {
    const std::string& input = inputs[engine() % inputs.size()];
    const std::string& other = inputs[engine() % inputs.size()];
    execute_watched(target, mutate(input, other, kMostBytes, engine), folder.path(), shared);
  }
  fs::remove_all(folder.path());
  ::_exit(0);
}

/// Whether all inputs were read or refused.
bool fuzz_target(const Target& target, const Options& options, Shared& shared) {
  shared.executions = 0;
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("no child process");
  if (child == 0) work(target, options, shared);
  int status = 0;
  ::waitpid(child, &status, 0);
  std::cout << fmt::format("{:14} {:>9} executions\n", target.name, shared.executions) << std::flush;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return true;
  const std::string input(shared.input, shared.size);
  const fs::path file = fs::path(options.out) / fmt::format("{}-{}", target.name, calc_sha256(input).substr(0, 12));
  std::ofstream(file, std::ios::binary) << input;
  const bool is_hang = WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM;
  const std::string why = is_hang               ? fmt::format("takes more than {} s", kHang_s)
                          : WIFSIGNALED(status) ? fmt::format("ends by signal {}", WTERMSIG(status))
                                                : "unexpected exception";
  std::cout << fmt::format("{}: {}, by the input in {}\n", target.name, why, file.string());
  return false;
}

void write_seeds(const Target& target, const std::string& folder) {
  fs::create_directories(fs::path(folder) / target.name);
  for (const std::string& input : list_inputs(target)) {
    std::ofstream(fs::path(folder) / target.name / calc_sha256(input).substr(0, 16), std::ios::binary) << input;
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Gives changed inputs to the readers of files and texts"};
  Options options;
  app.add_option("--target", options.targets, "Readers [all]");
  app.add_option("--seconds", options.seconds, "Time of each reader [1]");
  app.add_option("--seed", options.seed, "Decides all changes [1]");
  app.add_option("--out", options.out, "Folder for inputs that are neither read nor refused [.]");
  app.add_option("--write-seeds", options.write_seeds, "Writes seeds and former mistakes to a folder, and ends");
  app.add_option("--replay", options.replay, "Gives these files, as they are, to the one --target, and ends");
  CLI11_PARSE(app, argc, argv);
  if (options.targets.empty()) {
    for (const Target& target : list_targets()) options.targets.push_back(target.name);
  }
  Shared& shared = share();
  bool is_good = true;
  for (const std::string& name : options.targets) {
    const Target& target = find_target(name);
    if (!options.write_seeds.empty()) {
      write_seeds(target, options.write_seeds);
    } else if (!options.replay.empty()) {
      const tests::TemporaryFolder folder;
      for (const std::string& file : options.replay) {
        execute_watched(target, tests::read_file(file), folder.path(), shared);
      }
    } else {
      is_good = fuzz_target(target, options, shared) && is_good;
    }
  }
  return is_good ? 0 : 1;
}
