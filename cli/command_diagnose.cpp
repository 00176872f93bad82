#include <fmt/format.h>

#include <iostream>
#include <optional>

#include "cli/command.h"
#include "cli/output_files.h"
#include "cli/progress.h"
#include "rollrig/diagnose.h"
#include "rollrig/loop.h"
#include "rollrig/machine_pair.h"

namespace rollrig::cli {
namespace {

struct DiagnoseOptions {
  std::string set;
  std::string against;
  std::string explain;
  OutputOptions output;
  std::string plan;
  bool force = false;
  std::string loop;
  std::optional<double> hours;
  bool test_failed = false;
  ComparisonOptions comparison;
  BadRows bad_rows = BadRows::kRefuse;
  int threads = 0;
  double smallest_effect_percent = DiagnosisOptions{}.smallest_effect_percent;
};

void require_consistent(const DiagnoseOptions& options) {
  if (options.set.empty() == options.explain.empty()) {
    throw usage_error(
        options.set.empty() ? "nothing to diagnose or to explain" : "a set and --explain exclude each other",
        options.set.empty() ? "set" : "--explain", options.explain,
        "a folder with a measurement set, or --explain and the name of an effect");
  }
  if (!options.plan.empty() && options.set.empty()) {
    throw usage_error("there is no test to plan without a set", "--plan", options.plan, "a set beside it");
  }
  if (!options.loop.empty() && (options.set.empty() || !options.plan.empty())) {
    throw usage_error("a loop plans its tests itself, for one set", "--loop", options.loop,
                      "a set beside it, without --plan");
  }
  if (options.loop.empty() && (options.hours.has_value() || options.test_failed)) {
    throw usage_error("only a loop of tests takes this option", options.test_failed ? "--test-failed" : "--hours", "",
                      "--loop and its folder beside it");
  }
  if (options.against.empty()) {
    options.comparison.check();
    return;
  }
  if (options.set.empty() || !options.plan.empty() || !options.loop.empty()) {
    throw usage_error("two machines are compared, and no test is planned for one of them", "--against", options.against,
                      "the set of each machine, without --plan and --loop");
  }
}

/// What the options ask for; `progress` shows how far it is.
DiagnosisOptions make_options(const DiagnoseOptions& options, ProgressLine& progress) {
  return {options.comparison.without, options.comparison.only, options.threads, progress.callback(),
          options.smallest_effect_percent};
}

/// A folder of sets.
int diagnose_all(const DiagnoseOptions& options, const std::vector<std::string>& sets) {
  require_one_process("rollrig diagnose", "rollrig campaign new-diagnoses and run", options.output.quiet);
  Output output(options.output);
  const FleetDiagnosis fleet = [&] {
    ProgressLine progress("diagnose", options.output.quiet);
    return diagnose_fleet(sets, make_options(options, progress), options.bad_rows);
  }();
  output.show(fleet);
  int status = kDone;
  for (const FleetMember& member : fleet.members) {
    if (member.failure.empty()) continue;
    if (options.output.is_silent()) std::cerr << "error: " << member.folder << ": " << member.failure << '\n';
    if (status != kInputError) status = member.problem.has_value() ? kInputError : kRunFailed;
  }
  return status;
}

/// Stages the first proposed test for the folder. What it says to a person: where it is, or that there is none.
std::string stage_plan(const FolderFiles& files, OutputFolder& folder, Output& output) {
  if (files.empty()) return fmt::format("no test is proposed, so no plan is written to {}/\n", folder.path());
  output.stage(folder, files);
  return fmt::format("next test written to {0}/: {0}/plan.txt says how\n", folder.path());
}

/// One step of a loop of tests.
int advance(const DiagnoseOptions& options) {
  Output output(options.output);
  const Loop loop = [&] {
    ProgressLine progress("diagnose", options.output.quiet);
    LoopInput input{options.set, options.loop, options.hours, options.test_failed, options.bad_rows};
    input.diagnosis = make_options(options, progress);
    return advance_loop(input);
  }();
  output.show(loop);
  return kDone;
}

/// Two machines.
int compare_machines(const DiagnoseOptions& options) {
  for (const std::string& folder : {options.set, options.against}) {
    if (find_sets(folder).empty()) continue;
    throw usage_error("two machines are compared by one set each", "--against", folder,
                      "the folder of one set, without sets below it");
  }
  const MeasurementSet a(options.set, options.bad_rows);
  const MeasurementSet b(options.against, options.bad_rows);
  Output output(options.output);
  const PairDiagnosis found = [&] {
    ProgressLine progress("diagnose", options.output.quiet);
    return diagnose_pair(a, b, make_options(options, progress));
  }();
  output.show(found);
  return kDone;
}

int diagnose_command(const DiagnoseOptions& options) {
  require_consistent(options);
  if (!options.against.empty()) return compare_machines(options);
  if (!options.explain.empty()) {
    std::cout << explain_effect(options.explain);
    return kDone;
  }
  const std::vector<std::string> sets = find_sets(options.set);
  if (!sets.empty()) {
    if (!options.plan.empty() || !options.loop.empty()) {
      throw usage_error("a plan is made for one set", options.plan.empty() ? "--loop" : "--plan",
                        options.plan.empty() ? options.loop : options.plan,
                        "the folder of one set, without sets below it");
    }
    if (!options.output.quiet) warn_of_undescribed(options.set);
    return diagnose_all(options, sets);
  }
  if (!options.loop.empty()) return advance(options);
  const MeasurementSet set(options.set, options.bad_rows);
  Output output(options.output, {{"--plan", options.plan}});
  std::optional<OutputFolder> plan;
  if (!options.plan.empty()) plan.emplace(options.plan, options.force);
  const Diagnosis found = [&] {
    ProgressLine progress("diagnose", options.output.quiet);
    return diagnose(set, make_options(options, progress));
  }();
  const FolderFiles plan_files = plan.has_value() ? found.make_plan() : FolderFiles();
  output.stage(found);
  const std::string planned = plan.has_value() ? stage_plan(plan_files, *plan, output) : "";
  output.finish(found.text, planned);
  return kDone;
}

}  // namespace

void add_diagnose_command(CLI::App& app, Action& action) {
  const auto [command, options] = add_command<DiagnoseOptions>(
      app, action, "diagnose", "Why a measurement and the simulation differ: where, by which effect, how much",
      &diagnose_command);
  command->add_option("set", options->set, "Folder of a measurement set, or its set.toml; or a folder of such folders");
  command->add_option("--against", options->against,
                      "Set of another machine that tested the same tire: in which effect the two machines differ, by "
                      "how much their rolling resistance coefficients differ, and what of it remains");
  command->add_option("--explain", options->explain,
                      "Tell of an effect instead: equation, source, priors, what reveals it, what it is confused with, "
                      "which tests separate them; also none, unknown");
  options->output.add_to(*command, "File for the diagnosis, - for standard output");
  add_output_option(*command, "--plan", options->plan,
                    "Folder for the first proposed next test as run files, with a plan for a person");
  command->add_flag("--force", options->force, "Write the plan into a folder that holds files");
  add_output_option(*command, "--loop", options->loop,
                    "Folder of a loop of tests: reads what its planned test measured, diagnoses, plans the next test. "
                    "The loop ends when a cause has 95 % and acts alone with 90 %, when the hours are used up, or when "
                    "no test tells more");
  command->add_option("--hours", options->hours, "Hours of the machine that the loop may take [8]");
  command->add_flag("--test-failed", options->test_failed,
                    "The planned test of the loop could not be done; its hours count all the same");
  options->comparison.add_to(*command);
  add_smallest_effect(*command, options->smallest_effect_percent)->excludes("--against");
  add_skip_bad_rows(*command, options->bad_rows);
  add_threads(*command, options->threads);
}

}  // namespace rollrig::cli
