#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <memory>
#include <set>

#include "cli/command.h"
#include "cli/command_blind_plan.h"
#include "cli/command_blind_score.h"
#include "cli/comparison_options.h"
#include "cli/progress.h"
#include "sim/core/error.h"
#include "sim/core/text.h"
#include "validation/scoring/bank.h"
#include "validation/scoring/baselines/baselines.h"
#include "validation/scoring/oracle.h"
#include "validation/scoring/ranks.h"
#include "validation/scoring/run_bank.h"

namespace fs = std::filesystem;

namespace rollrig::cli {
namespace {

constexpr const char* kGenerator = "rollrig_blind";

struct MakeOptions {
  std::string seed = "1";
  std::string out;
  std::string kind = "mixed";
  std::string effects;
  int singles = 200;
  int pairs = 30;
  int none = 40;
  int outside = 30;
  bool counterfactual = false;
};

/// The foreign generator, a program of its own beside this one. Throws InputError.
std::string find_generator() {
  const fs::path program = fs::read_symlink("/proc/self/exe").parent_path() / kGenerator;
  if (::access(program.c_str(), X_OK) == 0) return program.string();
  throw InputError({fmt::format("the generator '{}' is not there", program.string()), "", 0, "", "",
                    "the program rollrig_blind beside rollrig, where the build puts both", ""});
}

/// Becomes the generator, so that messages, exit status and Ctrl-C are its own.
int make_command(const MakeOptions& options) {
  const std::string program = find_generator();
  std::vector<std::string> words{kGenerator, "bank", "--each", "0", "--kind", options.kind, "--seed", options.seed};
  const auto add = [&words](const char* option, const std::string& value) {
    words.emplace_back(option);
    words.push_back(value);
  };
  add("--singles", std::to_string(options.singles));
  add("--pairs", std::to_string(options.pairs));
  add("--none", std::to_string(options.none));
  add("--outside", std::to_string(options.outside));
  add("--out", options.out);
  if (!options.effects.empty()) add("--effects", options.effects);
  if (options.counterfactual) words.emplace_back("--counterfactual");
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::cout << std::flush;
  ::execv(program.c_str(), arguments.data());
  throw RunFailure(fmt::format("cannot start '{}': {}", program, std::strerror(errno)));
}

struct RunOptions {
  std::string bank;
  std::string out;
  int threads = 0;
  RaceOptions race;
  bool quiet = false;
  std::string seal;                  // of oracle
  std::string kind = "alone";        // likewise
  bool confusable = false;           // likewise
  std::vector<std::string> methods;  // of baselines
};

std::string folder_or(const std::string& given, const std::string& bank, const char* name) {
  return given.empty() ? (fs::path(bank) / name).string() : given;
}

/// Answers what is to be answered by all processes together, and says how it went.
int run_tasks(const proof::Ranks& ranks, const RunOptions& options, const std::string& out,
              std::vector<proof::Task> tasks, const proof::AnswerBy& answer_by = proof::answer_by_diagnosis) {
  const std::size_t all = tasks.size();
  proof::RunOrder order{options.bank, out, std::move(tasks)};
  order.answer_by = answer_by;
  order.threads = options.threads > 0 ? options.threads : ranks.threads();
  order.rank = ranks.rank();
  order.ranks = ranks.count();
  ProgressLine progress("blind", options.quiet || !ranks.is_first());
  order.progress = [&progress, &order](std::size_t done, std::size_t of) {
    progress.show(fmt::format("{} of {} sets{}", done, of, order.ranks > 1 ? " of the first process" : ""));
  };
  const proof::RunTally own = proof::run_bank(order);
  const auto sums = ranks.sum({own.kept, own.made, own.failures.size(), own.interrupted ? 1U : 0U});
  const bool is_stopped = sums[3] > 0;
  if (!options.quiet) {
    for (const auto& [set, why] : own.failures) std::cerr << wrap(fmt::format("set {}: {}", set, why), 2);
  }
  if (ranks.is_first() && (is_stopped || !options.quiet)) {
    std::string text =
        fmt::format("{} of {} sets answered in {}/: {} now, {} before", sums[0] + sums[1], all, out, sums[1], sums[0]);
    if (sums[2] > 0) text += fmt::format("; {} not diagnosed", sums[2]);
    if (order.ranks > 1) text += fmt::format("; {} processes", order.ranks);
    if (is_stopped) text = "stopped: " + text;
    (is_stopped ? std::cerr : std::cout) << wrap(text, 2).substr(2);
    if (is_stopped) std::cerr << "the same command goes on from here\n";
  }
  return is_stopped ? kInterrupted : kDone;
}

int run_command(const RunOptions& options) {
  options.race.check();
  std::vector<proof::Task> tasks = proof::plan_race(options.bank, options.race.only, options.race.without);
  const proof::Ranks ranks;
  return run_tasks(ranks, options, folder_or(options.out, options.bank, "answers"), std::move(tasks));
}

int baselines_command(const RunOptions& options) {
  options.race.check();
  const std::vector<proof::Task> tasks = proof::plan_race(options.bank, options.race.only, options.race.without);
  const proof::Ranks ranks;
  const auto is_asked = [&options](const std::string& id) {
    return options.methods.empty() ||
           std::find(options.methods.begin(), options.methods.end(), id) != options.methods.end();
  };
  for (const proof::BaselineMethod& method : proof::all_baselines()) {
    if (!is_asked(method.id)) continue;
    const int status = run_tasks(ranks, options, proof::baseline_folder(options.bank, method), tasks,
                                 [&method](const measurements::MeasurementSet& set, const proof::Settings& settings) {
                                   return proof::diagnose_by(method, set, settings);
                                 });
    if (status != kDone) return status;
  }
  return kDone;
}

int oracle_command(const RunOptions& options) {
  options.race.check();
  const bool is_alone = options.kind == "alone";
  if (is_alone && options.confusable) {
    throw InputError(
        {"the true effect runs alone", "command line", 0, "--confusable", "", "--race left_out beside it", ""});
  }
  if (is_alone && !options.race.only.empty()) {
    throw InputError({"the true effect runs alone", "command line", 0, "--only", options.race.only.front(),
                      "--race left_out beside it", ""});
  }
  const auto race = is_alone ? proof::OracleRace::kAlone : proof::OracleRace::kLeftOut;
  const std::vector<proof::Truth> truths = proof::open_truth(options.bank, options.seal);
  proof::Twins twins = is_alone ? proof::Twins{} : proof::find_twins(truths, folder_or("", options.bank, "answers"));
  if (!is_alone && options.confusable) proof::add_confusable(truths, twins);
  const proof::Ranks ranks;
  return run_tasks(ranks, options, folder_or(options.out, options.bank, is_alone ? kAloneFolder : kLeftOutFolder),
                   proof::plan_oracle(truths, race, options.race.only, twins));
}

void add_make(CLI::App& blind, Action& action) {
  CLI::App* command = blind.add_subcommand("make", "A bank of sets and one sealed truth, by the program rollrig_blind");
  auto options = std::make_shared<MakeOptions>();
  command->add_option("--seed", options->seed, "Decides all that is drawn [1]");
  command->add_option("--out", options->out, "Folder of the bank, new or empty")->required();
  command->add_option("--kind", options->kind, "mixed, drum, dyno or road [mixed]");
  command->add_option("--singles", options->singles, "Sets of one effect, small, middle and large in turn [200]");
  command->add_option("--pairs", options->pairs, "Sets of two effects [30]");
  command->add_option("--none", options->none, "Sets without effect [40]");
  command->add_option("--outside", options->outside, "Sets with an effect outside of the catalog [30]");
  command->add_option("--effects", options->effects, "Effects, as a,b,c [all that the kind shows]");
  command->add_flag("--counterfactual", options->counterfactual, "Also each set without effect and without noise");
  command->callback([options, &action] { action = [options] { return make_command(*options); }; });
}

std::shared_ptr<RunOptions> add_run_options(CLI::App& command) {
  auto options = std::make_shared<RunOptions>();
  command.add_option("bank", options->bank, "Folder made by rollrig blind make")->required();
  command.add_option("--threads", options->threads, "Sets at the same time [as many as the machine has cores]")
      ->check(CLI::Range(1, 1024));
  command.add_flag("--quiet", options->quiet, "Print nothing but errors");
  return options;
}

void add_run(CLI::App& blind, Action& action) {
  CLI::App* command = blind.add_subcommand(
      "run", "Diagnose the sets of a bank, its truth unopened; goes on where it was interrupted; under mpirun shared");
  auto options = add_run_options(*command);
  command->add_option("--out", options->out, "Folder of the answers [answers in the bank]");
  options->race.add_to(*command);
  command->callback([options, &action] { action = [options] { return run_command(*options); }; });
}

void add_baselines(CLI::App& blind, Action& action) {
  CLI::App* command = blind.add_subcommand(
      "baselines",
      "Answer the sets of a bank, its truth unopened, by the methods that the diagnosis has to beat, into "
      "answers-<method> in the bank; goes on where it was interrupted; under mpirun shared");
  auto options = add_run_options(*command);
  std::set<std::string> ids;
  for (const proof::BaselineMethod& method : proof::all_baselines()) ids.insert(method.id);
  command->add_option("--methods", options->methods, "nearest, aic, bic, sparse, gp [all]")
      ->delimiter(',')
      ->check(CLI::IsMember(ids));
  options->race.add_to(*command);
  command->callback([options, &action] { action = [options] { return baselines_command(*options); }; });
}

void add_oracle(CLI::App& blind, Action& action) {
  CLI::App* command = blind.add_subcommand("oracle",
                                           "Open the seal and diagnose with the truth known: alone in the race, or "
                                           "left out of it with what the answers could not tell from it");
  auto options = add_run_options(*command);
  command->add_option("--race", options->kind, "alone or left_out [alone]")
      ->check(CLI::IsMember({"alone", "left_out"}));
  command->add_flag("--confusable", options->confusable,
                    "With left_out: without all that the catalog calls confusable with the truth, too");
  command->add_option("--seal", options->seal, "SHA-256 of truth.json [what seal.sha256 says]");
  command->add_option("--out", options->out, "Folder of the answers [answers-alone or answers-left-out in the bank]");
  command->add_option("--only", options->race.only, "Effects in the race, the true ones left out: a,b")->delimiter(',');
  command->callback([options, &action] { action = [options] { return oracle_command(*options); }; });
}

}  // namespace

void add_blind_command(CLI::App& app, Action& action) {
  CLI::App* blind = app.add_subcommand("blind", "Prove the diagnosis on sets whose cause is under seal");
  blind->require_subcommand(1);
  add_make(*blind, action);
  add_run(*blind, action);
  add_baselines(*blind, action);
  add_blind_score(*blind, action);
  add_blind_plan(*blind, action);
  add_oracle(*blind, action);
}

}  // namespace rollrig::cli
