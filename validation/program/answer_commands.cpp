#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <set>

#include "campaigns/mpi/ranks.h"
#include "campaigns/part.h"
#include "cli/message.h"
#include "cli/output_files.h"
#include "cli/progress.h"
#include "sim/core/error.h"
#include "sim/core/text.h"
#include "validation/program/commands.h"
#include "validation/scoring/baselines/baselines.h"
#include "validation/scoring/run_cases.h"

namespace rollrig::validation {
namespace {

struct RunOptions {
  std::string set;
  std::string out;
  std::string shard;
  int threads = 0;
  cli::ComparisonOptions comparison;
  bool quiet = false;
  std::string hash;                  // of known-cause
  std::string cause = "alone";       // likewise
  bool confusable = false;           // likewise
  std::vector<std::string> methods;  // of baselines
};

/// Which cases this process answers: those of --shard, else what mpirun, srun or a batch system says, else all.
campaigns::Part choose_part(const campaigns::Ranks& ranks, const std::string& shard) {
  if (shard.empty()) {
    return campaigns::find_part([](const char* name) -> const char* { return std::getenv(name); })
        .value_or(campaigns::Part{ranks.rank() + 1, ranks.count()});
  }
  if (ranks.count() == 1) return campaigns::read_part(shard);
  throw cli::usage_error("mpirun has divided the cases already", "--shard", shard, "mpirun or --shard");
}

/// Answers what is to be answered by all processes together, and says how it went.
int run_tasks(const campaigns::Ranks& ranks, const RunOptions& options, const std::string& out, std::vector<Task> tasks,
              const AnswerBy& answer_by = answer_by_diagnosis) {
  const std::size_t all = tasks.size();
  RunOrder order{options.set, out, std::move(tasks)};
  order.answer_by = answer_by;
  order.threads = options.threads > 0 ? options.threads : ranks.threads();
  const campaigns::Part part = choose_part(ranks, options.shard);
  order.part = part;
  cli::ProgressLine progress("validation", options.quiet || !ranks.is_first());
  order.progress = [&progress, &order](std::size_t done, std::size_t of) {
    progress.update(std::nan(""),
                    fmt::format("{} of {} cases{}", done, of, order.part.count > 1 ? " of this process" : ""));
  };
  const AnswerTally own = run_cases(order);
  progress.clear();
  const auto sums = ranks.sum({own.kept, own.made, own.failures.size(), own.interrupted ? 1U : 0U});
  const bool is_stopped = sums[3] > 0;
  if (!options.quiet) {
    for (const auto& [number, why] : own.failures) std::cerr << wrap(fmt::format("case {}: {}", number, why), 2);
  }
  if (ranks.is_first() && (is_stopped || !options.quiet)) {
    const bool is_part = ranks.count() == 1 && part.count > 1;
    std::string text = fmt::format(
        "{} of {} cases{} answered in {}/: {} now, {} before", sums[0] + sums[1], is_part ? part.count_of(all) : all,
        is_part ? fmt::format(" of part {} of {}", part.number, part.count) : "", out, sums[1], sums[0]);
    if (sums[2] > 0) text += fmt::format("; {} not diagnosed", sums[2]);
    if (ranks.count() > 1) text += fmt::format("; {} processes", ranks.count());
    if (is_stopped) text = "stopped: " + text;
    (is_stopped ? std::cerr : std::cout) << cli::wrap_message(text);
    if (is_stopped) std::cerr << "the same command goes on from here\n";
  }
  return is_stopped ? cli::kInterrupted : cli::kDone;
}

int run_command(const RunOptions& options) {
  options.comparison.check();
  std::vector<Task> tasks = plan_tasks(options.set, options.comparison.only, options.comparison.without);
  const campaigns::Ranks ranks;
  return run_tasks(ranks, options, place_in(options.set, "answers", options.out), std::move(tasks));
}

int baselines_command(const RunOptions& options) {
  options.comparison.check();
  const std::vector<Task> tasks = plan_tasks(options.set, options.comparison.only, options.comparison.without);
  const campaigns::Ranks ranks;
  const auto is_asked = [&options](const std::string& id) {
    return options.methods.empty() ||
           std::find(options.methods.begin(), options.methods.end(), id) != options.methods.end();
  };
  for (const BaselineMethod& method : all_baselines()) {
    if (!is_asked(method.id)) continue;
    const int status = run_tasks(ranks, options, baseline_folder(options.set, method), tasks,
                                 [&method](const measurements::MeasurementSet& set, const Settings& settings) {
                                   return diagnose_by(method, set, settings);
                                 });
    if (status != cli::kDone) return status;
  }
  return cli::kDone;
}

int known_cause_command(const RunOptions& options) {
  options.comparison.check();
  const bool is_alone = options.cause == "alone";
  if (is_alone && (options.confusable || !options.comparison.only.empty())) {
    throw cli::usage_error("the true effect is alone in the comparison", options.confusable ? "--confusable" : "--only",
                           "", "--cause left_out beside it");
  }
  const std::vector<Truth> truths = read_truths(options.set, options.hash);
  Twins twins = is_alone ? Twins{} : find_twins(truths, place_in(options.set, "answers"));
  if (options.confusable) add_confusable(truths, twins);
  const campaigns::Ranks ranks;
  return run_tasks(
      ranks, options, place_in(options.set, is_alone ? kAloneFolder : kLeftOutFolder, options.out),
      plan_known_cause(truths, is_alone ? KnownCause::kAlone : KnownCause::kLeftOut, options.comparison.only, twins));
}

void add_common(CLI::App& command, RunOptions& options) {
  add_set_to(command, options.set);
  cli::add_threads(command, options.threads, "Cases at the same time [as many as the machine has cores]");
  command.add_option("--shard", options.shard,
                     "I/N: every N-th case, from the I-th [what Slurm, Grid Engine, srun or mpirun says, else all]");
  command.add_flag("--quiet", options.quiet, "Print nothing but errors");
}

void add_run(CLI::App& app, cli::Action& action) {
  const auto [command, options] = cli::add_command<RunOptions>(
      app, action, "run",
      "Diagnose the cases, the truth unopened; goes on where it was interrupted; under mpirun shared", run_command);
  add_common(*command, *options);
  cli::add_output_option(*command, "--out", options->out, "Folder of the answers [answers in the validation set]");
  options->comparison.add_to(*command);
}

void add_baselines(CLI::App& app, cli::Action& action) {
  const auto [command, options] = cli::add_command<RunOptions>(
      app, action, "baselines",
      "Answer the cases, the truth unopened, by the methods that the diagnosis has to beat, into answers-<method> in "
      "the validation set; goes on where it was interrupted; under mpirun shared",
      baselines_command);
  add_common(*command, *options);
  std::set<std::string> ids;
  for (const BaselineMethod& method : all_baselines()) ids.insert(method.id);
  command->add_option("--methods", options->methods, "nearest, aic, bic, sparse, gp [all]")
      ->delimiter(',')
      ->check(CLI::IsMember(ids));
  options->comparison.add_to(*command);
}

void add_known_cause(CLI::App& app, cli::Action& action) {
  const auto [command, options] = cli::add_command<RunOptions>(
      app, action, "known-cause",
      "Open the truth and diagnose with it: the true effects alone in the comparison, or left out of it with what the "
      "answers could not tell from them",
      known_cause_command);
  add_common(*command, *options);
  command->alias("oracle");
  const CLI::IsMember causes({"alone", "left_out"});
  command->add_option("--cause", options->cause, "alone or left_out [alone]")->check(causes);
  command->add_option("--race", options->cause)->check(causes)->group("");
  command->add_flag("--confusable", options->confusable,
                    "With left_out: without all that the catalog calls confusable with the truth, too");
  command->add_option("--hash", options->hash, "SHA-256 of truth.json [what truth.sha256 says]");
  command->add_option("--seal", options->hash)->group("");
  cli::add_output_option(*command, "--out", options->out,
                         "Folder of the answers [answers-alone or answers-left-out in the validation set]");
  command->add_option("--only", options->comparison.only, "Effects in the comparison, the true ones left out: a,b")
      ->delimiter(',');
}

}  // namespace

void add_answer_commands(CLI::App& app, cli::Action& action) {
  add_run(app, action);
  add_baselines(app, action);
  add_known_cause(app, action);
}

}  // namespace rollrig::validation
