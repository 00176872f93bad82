#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <map>

#include "cli/output_files.h"
#include "cli/progress.h"
#include "diagnosis/next_test/test_menu.h"
#include "sim/core/columns.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/interrupt.h"
#include "sim/core/text.h"
#include "validation/program/commands.h"
#include "validation/program/loop_cases.h"

namespace rollrig::validation {
namespace {

struct LoopCommandOptions {
  LoopOrder order;
  std::string tests = kLoopTestsNames.front();
  double failing_percent = 5.0;
  std::string json;
  bool quiet = false;
};

/// Kind of machine, and number of true effects: "drum, single".
std::string kind_of_case(const LoopOfCase& loop) {
  const std::size_t count = loop.truth.effects.size();
  const char* of = loop.truth.outside ? "outside" : count == 0 ? "none" : count == 1 ? "single" : "pair";
  return fmt::format("{}, {}", loop.kind, of);
}

using LoopsByKind = std::map<std::string, std::vector<const LoopOfCase*>>;

LoopsByKind sort_by_kind(const std::vector<LoopOfCase>& loops) {
  LoopsByKind groups;
  for (const LoopOfCase& loop : loops) groups[kind_of_case(loop)].push_back(&loop);
  return groups;
}

std::vector<double> list_times_h(double hours) { return {0.0, 0.25 * hours, 0.5 * hours, hours}; }

std::string count(const std::vector<const LoopOfCase*>& group, const std::function<bool(const LoopOfCase&)>& is) {
  return fmt::format("{}", std::count_if(group.begin(), group.end(), [&](const LoopOfCase* one) { return is(*one); }));
}

/// A row for each kind of machine and case.
Table make_loop_table(const LoopsByKind& groups, double hours) {
  Table table{"Loops that name the cause", {"cases", "of"}, {}};
  for (const double time_h : list_times_h(hours)) table.columns.push_back(fmt::format("right {:g} h", time_h));
  table.columns.insert(table.columns.end(), {"wrong", "mean h"});
  for (const auto& [name, group] : groups) {
    std::vector<std::string> row{name, fmt::format("{}", group.size())};
    for (const double time_h : list_times_h(hours)) {
      row.push_back(count(group, [&](const LoopOfCase& one) { return one.is_right_by(time_h); }));
    }
    row.push_back(count(group, [](const LoopOfCase& one) { return one.is_named() && !one.is_right(); }));
    double sum_h = 0.0;
    for (const LoopOfCase* one : group) sum_h += diagnosis::calc_hours_used(one->ledger);
    row.push_back(fmt::format("{:.1f}", sum_h / static_cast<double>(group.size())));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// Likewise of an ideal observer; cases without effect have no row.
Table make_ideal_table(const LoopsByKind& groups, double hours) {
  Table table{"What an ideal observer could separate with the same tests", {"cases", "of"}, {}};
  for (const double time_h : list_times_h(hours)) table.columns.push_back(fmt::format("by {:g} h", time_h));
  for (const auto& [name, group] : groups) {
    if (group.front()->truth.effects.empty()) continue;
    std::vector<std::string> row{name, fmt::format("{}", group.size())};
    for (const double time_h : list_times_h(hours)) {
      row.push_back(count(group, [&](const LoopOfCase& one) { return one.is_separable_by(time_h); }));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Json make_loop_json(const LoopOfCase& loop) {
  return {{"set", loop.truth.number},
          {"truth", loop.truth.ids()},
          {"kind", kind_of_case(loop)},
          {"right", loop.is_right()},
          {"failure", loop.failure},
          {"separable", loop.separable},
          {"slowest_step_s", loop.slowest_step_s},
          {"loop", diagnosis::make_ledger_json(loop.ledger)}};
}

LoopTests find_loop_tests(const std::string& name) {
  const auto at = std::find(kLoopTestsNames.begin(), kLoopTestsNames.end(), name);
  if (at == kLoopTestsNames.end()) {
    InputProblem problem = unknown_name("choice of tests", name, kLoopTestsNames);
    problem.file = "command line";
    problem.key = "--tests";
    throw InputError(problem);
  }
  return static_cast<LoopTests>(at - kLoopTestsNames.begin());
}

int loop_command(const LoopCommandOptions& options) {
  cli::require_one_process("rollrig_validation loop");
  if (!(options.failing_percent >= 0.0 && options.failing_percent <= 100.0)) {
    throw cli::usage_error("no share of tests", "--failing", fmt::format("{:g}", options.failing_percent), "0 to 100");
  }
  diagnosis::require_machine_hours(options.order.hours);
  const LoopTests tests = find_loop_tests(options.tests);
  if (!options.json.empty()) require_writable(options.json);
  LoopOrder order = options.order;
  order.failing_share = options.failing_percent / 100.0;
  order.tests = tests;
  const std::vector<LoopOfCase> loops = [&] {
    cli::ProgressLine progress("loop", options.quiet);
    order.progress = [&progress](std::size_t done, std::size_t of) {
      progress.update(static_cast<double>(done) / static_cast<double>(of), fmt::format("{} of {} cases", done, of));
    };
    return loop_cases(order);
  }();
  if (!options.json.empty()) {
    const Json json = {{"format", "rollrig-loops/2"},
                       {"hours", order.hours},
                       {"seed", order.seed},
                       {"tests", options.tests},
                       {"failing_share", order.failing_share},
                       {"cases", make_list(loops, make_loop_json)}};
    throw_if_interrupted();
    write_output(options.json, to_text(json));
  }
  if (options.quiet || options.json == "-") return cli::kDone;
  const LoopsByKind groups = sort_by_kind(loops);
  std::cout << format_table(make_loop_table(groups, order.hours));
  if (order.with_ideal) std::cout << format_table(make_ideal_table(groups, order.hours));
  for (const LoopOfCase& loop : loops) {
    if (!loop.failure.empty()) std::cout << wrap(fmt::format("case {}: {}", loop.truth.number, loop.failure), 2);
  }
  return cli::kDone;
}

}  // namespace

void add_loop_command(CLI::App& app, cli::Action& action) {
  const auto [command, options] = cli::add_command<LoopCommandOptions>(
      app, action, "loop", "Loops of tests on all cases, with the generator as the rig: how many causes are named",
      loop_command);
  add_set_to(*command, options->order.set);
  command->add_option("--hours", options->order.hours, "Hours of the machine for each case")->capture_default_str();
  command->add_option("--failing", options->failing_percent, "Percent of tests that fail")->capture_default_str();
  command->add_option("--tests", options->tests,
                      fmt::format("Which tests are done: {} [{}]", fmt::join(kLoopTestsNames, ", "), options->tests));
  command->add_flag("--ideal", options->order.with_ideal, "Also what an ideal observer makes of the same tests");
  add_seed(*command, options->order.seed, "Of failures and drawn tests");
  cli::add_output_option(*command, "--json", options->json, "File for all loops, - for standard output");
  cli::add_threads(*command, options->order.threads, "Cases at the same time [as many as the machine has cores]");
  command->add_flag("--quiet", options->quiet, "Print nothing but errors");
}

}  // namespace rollrig::validation
