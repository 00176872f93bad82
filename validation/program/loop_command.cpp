#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>

#include "cli/output_files.h"
#include "cli/progress.h"
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

/// A row for each kind of machine and case.
Table make_loop_table(const std::vector<LoopOfCase>& loops, double hours) {
  std::map<std::string, std::vector<const LoopOfCase*>> groups;
  for (const LoopOfCase& loop : loops) groups[kind_of_case(loop)].push_back(&loop);
  const std::vector<double> times_h{0.0, 0.25 * hours, 0.5 * hours, hours};
  Table table{"Named at 95 %, alone", {"cases", "of"}, {}};
  for (const double time_h : times_h) table.columns.push_back(fmt::format("right {:g} h", time_h));
  table.columns.insert(table.columns.end(), {"wrong", "mean h"});
  for (const auto& [name, group] : groups) {
    std::vector<std::string> row{name, fmt::format("{}", group.size())};
    const auto count = [&group = group](const auto& is) {
      return fmt::format("{}", std::count_if(group.begin(), group.end(), is));
    };
    for (const double time_h : times_h)
      row.push_back(count([&](const LoopOfCase* one) { return one->is_right_by(time_h); }));
    row.push_back(count([](const LoopOfCase* one) { return one->is_named() && !one->is_right(); }));
    double sum_h = 0.0;
    for (const LoopOfCase* one : group) sum_h += diagnosis::calc_hours_used(one->ledger);
    row.push_back(fmt::format("{:.1f}", sum_h / static_cast<double>(group.size())));
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
          {"slowest_step_s", loop.slowest_step_s},
          {"loop", diagnosis::make_ledger_json(loop.ledger)}};
}

int loop_command(const LoopCommandOptions& options) {
  if (!(options.failing_percent >= 0.0 && options.failing_percent <= 100.0)) {
    throw cli::usage_error("no share of tests", "--failing", fmt::format("{:g}", options.failing_percent), "0 to 100");
  }
  if (!options.json.empty()) require_writable(options.json);
  LoopOrder order = options.order;
  order.failing_share = options.failing_percent / 100.0;
  const std::vector<LoopOfCase> loops = [&] {
    cli::ProgressLine progress("loop", options.quiet);
    order.progress = [&progress](std::size_t done, std::size_t of) {
      progress.update(static_cast<double>(done) / static_cast<double>(of), fmt::format("{} of {} cases", done, of));
    };
    return loop_cases(order);
  }();
  if (!options.json.empty()) {
    const Json json = {{"format", "rollrig-loops/1"},
                       {"hours", order.hours},
                       {"seed", order.seed},
                       {"drawn", order.drawn},
                       {"failing_share", order.failing_share},
                       {"cases", make_list(loops, make_loop_json)}};
    throw_if_interrupted();
    write_output(options.json, to_text(json));
  }
  if (options.quiet || options.json == "-") return cli::kDone;
  std::cout << format_table(make_loop_table(loops, order.hours));
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
  command->add_flag("--drawn", options->order.drawn, "Tests drawn from the menu, instead of the best");
  command->add_option("--seed", options->order.seed, "Of failures and drawn tests")->capture_default_str();
  cli::add_output_option(*command, "--json", options->json, "File for all loops, - for standard output");
  cli::add_threads(*command, options->order.threads, "Cases at the same time [as many as the machine has cores]");
  command->add_flag("--quiet", options->quiet, "Print nothing but errors");
}

}  // namespace rollrig::validation
