#include <fmt/format.h>

#include <cmath>
#include <iostream>

#include "cli/output_files.h"
#include "cli/progress.h"
#include "sim/core/file_io.h"
#include "sim/core/text.h"
#include "validation/generator/machine_pairs.h"
#include "validation/program/commands.h"
#include "validation/program/made_items.h"
#include "validation/scoring/machine_pairs.h"

namespace rollrig::validation {
namespace {

constexpr int kMostPairs = 2000;

struct MakePairsOptions {
  generator::PairsOrder order;
  int threads = 0;
};

int make_pairs_command(const MakePairsOptions& options) {
  cli::ProgressLine line("validation", false);
  const auto hashed = [&](const std::string& sha256) {
    line.clear();
    std::cout << fmt::format("SHA-256 of {}/truth.json: {}\n", options.order.out, sha256);
  };
  generator::write_pairs(options.order, make_by_campaign(options.threads, line, "pairs"), hashed);
  return cli::kDone;
}

struct RunPairsOptions {
  PairsRun order;
  bool quiet = false;
};

int run_pairs_command(RunPairsOptions options) {
  options.order.out = place_in(options.order.set, "answers", options.order.out);
  cli::ProgressLine line("validation", options.quiet);
  options.order.progress = [&line](std::size_t done, std::size_t of) {
    line.update(std::nan(""), fmt::format("{} of {} pairs", done, of));
  };
  const AnswerTally tally = run_pairs(options.order);
  line.clear();
  for (const auto& [number, why] : tally.failures) std::cerr << wrap(fmt::format("pair {}: {}", number, why), 2);
  if (!options.quiet) {
    std::cout << fmt::format("{}{} pairs answered in {}/: {} now, {} before\n", tally.interrupted ? "stopped: " : "",
                             tally.kept + tally.made, options.order.out, tally.made, tally.kept);
  }
  return tally.interrupted ? cli::kInterrupted : cli::kDone;
}

struct ScorePairsOptions {
  std::string set;
  std::string answers;
  std::string json;
};

int score_pairs_command(const ScorePairsOptions& options) {
  const PairScore score = score_pairs(options.set, place_in(options.set, "answers", options.answers));
  std::cout << format_table(make_shares_table(score), 0);
  for (const std::string& missed : score.missed) std::cout << wrap(missed, 2);
  std::cout << fmt::format("CPU time of an answer, median: {:.1f} s\n", score.cpu_seconds);
  if (!options.json.empty()) write_output(options.json, to_text(make_score_json(score), 1));
  return cli::kDone;
}

}  // namespace

void add_pair_commands(CLI::App& app, cli::Action& action) {
  const auto [make, make_options] = cli::add_command<MakePairsOptions>(
      app, action, "make-pairs", "Pairs of machines that test the same tire, with an effect on one of them",
      make_pairs_command);
  generator::PairsOrder& order = make_options->order;
  make->add_option("--seed", order.seed, "Decides all that is drawn [1]");
  make->add_option("--differing", order.differing, "Pairs that differ by one effect [200]")
      ->check(cli::in_range(0, kMostPairs));
  make->add_option("--none", order.none, "Pairs that do not differ [40]")->check(cli::in_range(0, kMostPairs));
  make->add_option("--runs", order.runs, "Runs of each machine [3]")->check(cli::in_range(1, generator::kMostRuns));
  cli::add_threads(*make, make_options->threads, "Pairs at a time [as many as there are cores]");
  cli::add_output_option(*make, "--out", order.out, "Folder of the pairs, new or empty")->required();
  const auto [run, run_options] = cli::add_command<RunPairsOptions>(
      app, action, "run-pairs", "Compare the machines of each pair, the truth unopened; goes on where it stopped",
      run_pairs_command);
  run->add_option("set", run_options->order.set, "Folder made by rollrig_validation make-pairs")->required();
  cli::add_output_option(*run, "--out", run_options->order.out, "Folder of the answers [answers in that folder]");
  cli::add_threads(*run, run_options->order.threads, "Pairs at a time [as many as there are cores]");
  run->add_flag("--quiet", run_options->quiet, "Print nothing but errors");
  const auto [score, score_options] = cli::add_command<ScorePairsOptions>(
      app, action, "score-pairs", "Open the truth: in which pairs the differing effect is named", score_pairs_command);
  score->add_option("set", score_options->set, "Folder made by rollrig_validation make-pairs")->required();
  score->add_option("--answers", score_options->answers, "Folder of the answers [answers in that folder]");
  cli::add_output_option(*score, "--json", score_options->json, "File for the score, - for standard output");
}

}  // namespace rollrig::validation
