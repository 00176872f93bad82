/// fuzz_readers: feeds mutated inputs to the readers, in a child process, and says which input ends it.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "build_paths.h"
#include "sim/core/file_io.h"
#include "tests/fuzz/mutator.h"
#include "tests/fuzz/target.h"
#include "tests/fuzz/watched_child.h"
#include "tests/support/temporary_folder.h"

namespace fs = std::filesystem;
using namespace rollrig;
using namespace rollrig::fuzz;

namespace {

constexpr std::size_t kMostBytes = kMostInput_B / 2;  // of a mutated input
constexpr unsigned kHang_s = 5;                       // for one input
constexpr std::size_t kMostMemory_B = 3UL << 29;      // Assumed: address space, a third of it for libraries

struct Options {
  std::vector<std::string> targets;
  double seconds = 1.0;
  std::uint64_t seed = 1;
  std::string out = ".";
  bool is_list = false;
  std::string write_seeds;
  std::vector<std::string> replay;
};

/// Seeds and regression inputs.
std::vector<std::string> list_inputs(const Target& target) {
  std::vector<std::string> inputs = target.make_seeds();
  const fs::path former = fs::path(ROLLRIG_SOURCE_DIR) / "tests/fuzz/crashes" / target.name;
  if (!fs::is_directory(former)) return inputs;
  for (const auto& entry : fs::directory_iterator(former)) inputs.push_back(tests::read_file(entry.path().string()));
  return inputs;
}

void give(const Target& target, const std::string& input, const std::string& folder, Watched& watched) {
  watched.begin(input, kHang_s);
  execute(target, input, folder);
  watched.end();
}

/// All inputs as they are, then mutated ones until the time is over.
void work(const Target& target, const Options& options, const std::string& folder, Watched& watched) {
  const std::vector<std::string> inputs = list_inputs(target);
  for (const std::string& input : inputs) give(target, input, folder, watched);
  Engine engine(options.seed);
  const auto start = std::chrono::steady_clock::now();
  while (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < options.seconds) {
    const std::string& input = inputs[engine() % inputs.size()];
    const std::string& other = inputs[engine() % inputs.size()];
    give(target, mutate(input, other, kMostBytes, engine), folder, watched);
  }
}

/// Whether all inputs were read or refused.
bool fuzz_target(const Target& target, const Options& options) {
  Watched watched;
  const tests::TemporaryFolder folder;
  const std::string ended = watched.run([&] { work(target, options, folder.path(), watched); }, kMostMemory_B);
  std::cout << fmt::format("{:14} {:>9} executions\n", target.name, watched.executions()) << std::flush;
  if (ended.empty()) return true;
  const std::string input = watched.last_input();
  const fs::path file = fs::path(options.out) / fmt::format("{}-{}", target.name, calc_sha256(input).substr(0, 12));
  fs::create_directories(options.out);
  if (!(std::ofstream(file, std::ios::binary) << input)) throw std::runtime_error("cannot write " + file.string());
  std::cout << fmt::format("{}: {}, by the input in {}\n", target.name, ended, file.string());
  return false;
}

void write_seeds(const Target& target, const std::string& folder) {
  fs::create_directories(fs::path(folder) / target.name);
  for (const std::string& input : list_inputs(target)) {
    std::ofstream(fs::path(folder) / target.name / calc_sha256(input).substr(0, 16), std::ios::binary) << input;
  }
}

/// Whether all files were read or refused.
bool replay(const Target& target, const std::vector<std::string>& files) {
  Watched watched;
  const tests::TemporaryFolder folder;
  const auto give_files = [&] {
    for (const std::string& file : files) give(target, tests::read_file(file), folder.path(), watched);
  };
  const std::string ended = watched.run(give_files, kMostMemory_B);
  std::cout << fmt::format("{:14} {:>9} executions\n", target.name, watched.executions());
  if (ended.empty()) return true;
  const std::string& file = files.at(std::min(watched.executions(), files.size() - 1));
  std::cout << fmt::format("{}: {}, by the input in {}\n", target.name, ended, file);
  return false;
}

/// For CLI11: an empty text, or what is wrong.
std::string check_readable(const std::string& file) {
  return std::ifstream(file).good() ? "" : "Cannot read the file: " + file;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Feeds mutated inputs to the readers of files and texts"};
  Options options;
  std::vector<std::string> names;
  for (const Target& target : list_targets()) names.push_back(target.name);
  app.add_option("--target", options.targets, "Readers [all]")->check(CLI::IsMember(names));
  app.add_option("--seconds", options.seconds, "Time of each reader [1]");
  app.add_option("--seed", options.seed, "Decides all changes [1]");
  app.add_option("--out", options.out, "Folder for inputs that crash or hang a reader [.]");
  app.add_option("--write-seeds", options.write_seeds, "Writes seeds and regression inputs to a folder, and ends");
  app.add_option("--replay", options.replay, "Gives these files, as they are, to the one --target, and ends")
      ->check(CLI::ExistingFile)
      ->check(check_readable);
  app.add_flag("--list", options.is_list, "Prints the readers, and ends");
  CLI11_PARSE(app, argc, argv);
  if (!options.replay.empty() && options.targets.size() != 1) {
    std::cerr << "fuzz_readers: --replay needs exactly one --target\n";
    return 2;
  }
  if (options.targets.empty()) options.targets = names;
  bool is_good = true;
  for (const std::string& name : options.targets) {
    const Target& target = find_target(name);
    if (options.is_list) {
      std::cout << name << "\n";
    } else if (!options.write_seeds.empty()) {
      write_seeds(target, options.write_seeds);
    } else if (!options.replay.empty()) {
      is_good = replay(target, options.replay) && is_good;
    } else {
      is_good = fuzz_target(target, options) && is_good;
    }
  }
  return is_good ? 0 : 1;
}
