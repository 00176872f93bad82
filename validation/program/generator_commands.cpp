#include <fmt/format.h>

#include <iostream>
#include <optional>

#include "cli/output_files.h"
#include "cli/progress.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "validation/files.h"
#include "validation/generator/follow_up.h"
#include "validation/generator/options.h"
#include "validation/generator/upper_bound.h"
#include "validation/program/commands.h"
#include "validation/program/made_items.h"

namespace rollrig::validation {
namespace {

using namespace generator;

constexpr int kMostCases = 2000;

constexpr const char* kThreads = "Cases at a time [as many as there are cores]";

generator::Progress show_share_of_cases(cli::ProgressLine& line) {
  return [&line](double share_done) { line.update(share_done, "cases"); };
}

struct CaseOptions {
  CaseWords words;
  std::string out;
  std::string truth;
  std::string counterfactual;
  SetOrder order;
};

void check_places(const CaseOptions& options) {
  require_new_folder(options.out, "--out");
  if (!options.truth.empty()) {
    require_writable(options.truth);
    if (lies_within(options.truth, options.out)) {
      throw InputError(
          {"the truth may not lie in the case", "", 0, "--truth", options.truth, "a file outside of --out", ""});
    }
  }
  if (options.counterfactual.empty()) return;
  require_new_folder(options.counterfactual, "--counterfactual");
  if (lies_within(options.counterfactual, options.out) || lies_within(options.out, options.counterfactual)) {
    throw InputError({"case and counterfactual may not lie in each other", "", 0, "--counterfactual",
                      options.counterfactual, "a folder beside --out", ""});
  }
}

int make_case_command(CaseOptions options) {
  read_case(options.words, options.order);
  check_places(options);
  OutputFolder set(options.out, false);
  std::optional<OutputFolder> without;
  if (!options.counterfactual.empty()) without.emplace(options.counterfactual, false);
  MadeSet made = make_set(options.order, without.has_value());
  for (auto& [name, content] : made.files) set.add(name, std::move(content));
  for (auto& [name, content] : made.counterfactual) without->add(name, std::move(content));
  std::vector<StagedOutput> truth;
  if (!options.truth.empty()) truth.emplace_back(options.truth, to_text(made.truth));
  std::vector<OutputFolder*> folders{&set};
  if (without.has_value()) folders.push_back(&*without);
  for (OutputFolder* folder : folders) folder->flush();
  cli::commit_all(truth, folders);
  return cli::kDone;
}

struct MakeOptions {
  ValidationSetOrder order;
  std::string effects;
  std::string outside_list = kOutsideListNames.front();
  int threads = 0;
};

int make_command(MakeOptions options) {
  cli::require_one_process("rollrig_validation make");
  ValidationSetOrder& order = options.order;
  order.campaigns = read_campaigns(order.kind);
  order.outside_list = read_outside_list(options.outside_list);
  order.effects = options.effects.empty() ? drawn_effects(order.campaigns) : read_effects(options.effects);
  check_drawn(order);
  cli::ProgressLine line("validation", false);
  const auto hashed = [&order, &line](const std::string& sha256) {
    line.clear();
    std::cout << fmt::format("SHA-256 of {}/truth.json: {}\n", order.out, sha256);
    flush_standard_output();
  };
  write_validation_set(order, make_by_campaign(options.threads, line, "cases"), hashed);
  return cli::kDone;
}

int upper_bound_command(UpperBoundOrder order) {
  cli::require_one_process("rollrig_validation upper-bound");
  cli::ProgressLine line("validation", false);
  const std::size_t cases = write_upper_bounds(order, show_share_of_cases(line));
  line.clear();
  std::cout << fmt::format("upper bound of {} cases with effects written to {}\n", cases, order.out);
  return cli::kDone;
}

int follow_up_command(const FollowUpOrder& order) {
  cli::require_one_process("rollrig_validation follow-up");
  cli::ProgressLine line("validation", false);
  const std::size_t cases = write_follow_up(order, show_share_of_cases(line));
  line.clear();
  std::cout << fmt::format("{} cases with their next test in {}/sets\n", cases, follow_up_folder(order));
  return cli::kDone;
}

/// What `list` says beside the id.
std::string describe_place(const EffectKind& kind) {
  if (!kind.outside) return "";
  if (kind.outside_list == OutsideList::kFirst) return " (outside of the catalog)";
  return fmt::format(" (outside of the catalog, {} list)",
                     kOutsideListNames[static_cast<std::size_t>(kind.outside_list)]);
}

int list_command() {
  for (const EffectKind* kind : effect_kinds()) {
    std::cout << fmt::format("{}{}\n  size     {} [{}]; {:g} does nothing\n", kind->id, describe_place(*kind),
                             kind->size.meaning, kind->size.unit, kind->size.neutral);
    for (const Form& form : kind->forms) std::cout << fmt::format("  form     {}: {}\n", form.name, form.law);
    std::cout << fmt::format("  made on  {}\n  drawn on {}\n", list_grounds(kind->acts), list_grounds(kind->drawn));
  }
  return cli::kDone;
}

void add_make_case(CLI::App& app, cli::Action& action) {
  const auto [command, options] = cli::add_command<CaseOptions>(
      app, action, "make-case", "One case: a measurement set with a hidden cause", make_case_command);
  command->add_option("--kind", options->words.kind,
                      fmt::format("{} [{}]", fmt::join(machine_words(), ", "), options->words.kind));
  command->add_option("--baseline", options->words.baseline, "Of a road set: combined or constant_rrc [drawn]");
  command->add_option("--effect", options->words.effects, "Effect, two as a,b, or none [none]");
  command->add_option("--size", options->words.sizes, "Its size in its own unit, for two a,b [drawn]");
  command->add_option("--form", options->words.forms, "Its functional form, for two a,b [drawn]");
  add_seed(*command, options->order.seed, "Decides all that is drawn");
  cli::add_output_option(*command, "--out", options->out, "Folder of the case, new or empty")->required();
  cli::add_output_option(*command, "--truth", options->truth, "File for the truth, outside of the case");
  cli::add_output_option(*command, "--counterfactual", options->counterfactual,
                         "Folder for the same case without effect and without noise");
  command->add_option("--runs", options->order.runs, "Number of runs [6]")->check(cli::in_range(1, kMostRuns));
  command->add_flag("--noise-free", options->order.noise_free, "No errors of sensors, no drop-outs");
  command->add_flag("--nominal-base", options->order.nominal_base, "Base parameters as the files have them");
}

CLI::App* add_make(CLI::App& app, cli::Action& action, const char* name, const ValidationSetOrder& defaults) {
  const auto made = cli::add_command<MakeOptions>(
      app, action, name, "A validation set: cases in shuffled order, and one truth whose SHA-256 is printed",
      make_command);
  CLI::App* command = made.first;
  MakeOptions* options = made.second.get();
  options->order = defaults;
  ValidationSetOrder& order = options->order;
  const auto add_count = [command](const char* option, int& count, const char* what) {
    command->add_option(option, count, fmt::format("{} [{}]", what, count))->check(cli::in_range(0, kMostCases));
  };
  command->add_option(
      "--kind", order.kind,
      fmt::format("mixed: a campaign drawn for each case; or {} [{}]", fmt::join(machine_words(), ", "), order.kind));
  add_seed(*command, order.seed, "Decides all that is drawn");
  add_count("--singles", order.singles, "Cases of one effect, small, middle and large in turn");
  add_count("--each", order.each, "Cases of each effect");
  add_count("--pairs", order.pairs, "Cases of two effects");
  add_count("--triples", order.triples, "Cases of three effects");
  add_count("--none", order.none, "Cases without effect");
  add_count("--outside", order.outside, "Cases with an effect outside of the catalog");
  command->add_option(
      "--outside-list", options->outside_list,
      fmt::format("List of which these are: {} [{}]", fmt::join(kOutsideListNames, ", "), options->outside_list));
  command->add_option("--effects", options->effects, "Effects, as a,b,c [all of the catalog that the kind shows]");
  command->add_option("--runs", order.runs, "Number of runs of a case, at most [6]")
      ->check(cli::in_range(1, kMostRuns));
  command->add_flag("--counterfactual", order.counterfactual, "Also each case without effect and without noise");
  cli::add_threads(*command, options->threads, kThreads);
  cli::add_output_option(*command, "--out", order.out, "Folder of the validation set, new or empty")->required();
  return command;
}

/// As `rollrig_blind bank` was called.
ValidationSetOrder make_old_defaults() {
  ValidationSetOrder order;
  order.kind = all_machines().front()->word;
  order.each = 20;
  order.none = 100;
  order.singles = order.pairs = order.outside = 0;
  return order;
}

void add_upper_bound(CLI::App& app, cli::Action& action) {
  const auto [command, order] = cli::add_command<UpperBoundOrder>(
      app, action, "upper-bound", "Open the truth: what an ideal observer makes of the cases", upper_bound_command);
  add_set_to(*command, order->set);
  command->alias("ceiling");
  cli::add_output_option(*command, "--out", order->out, "File for the bound [upper_bound.json in the validation set]");
  command->add_option("--cases", order->cases, "Numbers of cases, as 0001,0002 [all]")->delimiter(',');
  command->add_option("--sets", order->cases)->delimiter(',')->group("");
  command->add_flag("--detection", order->detection_alone,
                    "Whether each is to be seen, and not what it can be told from: a tenth of the time");
  cli::add_threads(*command, order->threads, kThreads);
}

void add_follow_up(CLI::App& app, cli::Action& action) {
  const auto [command, order] = cli::add_command<FollowUpOrder>(
      app, action, "follow-up", "Open the truth: its cases again, with the follow-up tests that plan wrote",
      follow_up_command);
  add_set_to(*command, order->set);
  command->alias("followup");
  command->add_flag("--drawn", order->drawn, "The tests drawn from the menu, not those proposed");
  cli::add_threads(*command, order->threads, kThreads);
}

}  // namespace

void add_generator_commands(CLI::App& app, cli::Action& action) {
  add_make(app, action, "make", {});
  add_make(app, action, "bank", make_old_defaults())->group("");
  add_make_case(app, action);
  CLI::App* list = app.add_subcommand("list", "Effects, their sizes and laws");
  list->callback([&action] { action = list_command; });
  add_upper_bound(app, action);
  add_follow_up(app, action);
}

}  // namespace rollrig::validation
