#include <fmt/format.h>

#include <algorithm>

#include "diagnosis/loop/ledger.h"
#include "diagnosis/output/summary.h"
#include "report/blocks.h"
#include "report/diagnosis_page.h"
#include "sim/core/text.h"

namespace rollrig::report {
namespace {

constexpr double kNamedAt_percent = 95.0;  // docs/test_loop.md

/// Steps of a probability over the hours, to the hours that are used.
Json make_probability_steps(const LoopLedger& ledger, const std::string& name, double LoopAnswer::*probability) {
  ChartSeries steps;
  for (const LoopAnswer& answer : ledger.answers) steps.add(answer.hours, 100.0 * (answer.*probability));
  const double used_h = diagnosis::calc_hours_used(ledger);
  if (used_h > ledger.answers.back().hours) steps.add(used_h, 100.0 * (ledger.answers.back().*probability));
  return steps.finish(name, "steps");
}

std::string describe_loop_test(const LoopLedger& ledger, const LoopAnswer& answer) {
  if (answer.tests == 0) return "the set";
  const LoopTest& test = ledger.tests[answer.tests - 1];
  return fmt::format("test-{}: {}{}", answer.tests, test.test, test.state == LoopTestState::kFailed ? " (failed)" : "");
}

std::string describe_first_cause(const LoopAnswer& answer) {
  if (answer.effects.empty()) return "-";
  std::vector<std::string> names;
  for (const std::string& id : answer.effects) names.push_back(name_effect(id));
  std::string text = fmt::format("{}{}", answer.is_trace ? "a trace of " : "", fmt::join(names, " with "));
  for (const std::string& other : answer.indistinguishable_from) text += " or " + other;
  return text;
}

/// What comes next, or why nothing does.
std::string describe_loop_state(const LoopLedger& ledger) {
  switch (ledger.state) {
    case LoopState::kNamed:
      return "A cause has at least 95 %: no further test is needed";
    case LoopState::kHoursGone:
      return "Too few hours are left for a test";
    case LoopState::kNothingToTest:
      return "No test that fits into the hours left would tell more";
    case LoopState::kWaiting:
      break;
  }
  if (ledger.tests.empty()) return "The next test is not planned yet";
  const LoopTest& next = ledger.tests.back();
  return fmt::format("Next: test-{}, {} ({:.1f} h)", ledger.tests.size(), next.test, next.hours);
}

/// "1 test done, 1 failed".
std::string count_loop_tests(const LoopLedger& ledger) {
  const auto count = [&ledger](LoopTestState state) {
    return static_cast<std::size_t>(std::count_if(ledger.tests.begin(), ledger.tests.end(),
                                                  [state](const LoopTest& test) { return test.state == state; }));
  };
  const std::size_t failed = count(LoopTestState::kFailed);
  return fmt::format("{} done{}", format_count(count(LoopTestState::kMeasured), "test"),
                     failed > 0 ? fmt::format(", {} failed", failed) : "");
}

}  // namespace

void add_loop(const LoopLedger& ledger, Page& page) {
  const std::string hours = fmt::format("{:.1f} of {:.1f}", diagnosis::calc_hours_used(ledger), ledger.hours);
  page.subtitle += fmt::format(". Loop of tests: {}", count_loop_tests(ledger));
  for (Block& block : page.sections.front().blocks) {
    if (block["type"] == "lead") {
      block["more"] = fmt::format("Loop of tests: {}, {} h of the machine used. {}.", count_loop_tests(ledger), hours,
                                  describe_loop_state(ledger));
    }
    if (block["type"] != "tiles") continue;
    const Tile used{"Hours of the loop used", hours, "h",
                    fmt::format("{}. {}", count_loop_tests(ledger), describe_loop_state(ledger))};
    const Block tiles = make_tiles({used});
    block["tiles"].insert(block["tiles"].begin() + 1, tiles["tiles"].front());
  }
  page.sections.insert(page.sections.begin() + 1, make_loop_section(ledger));  // after the verdict
}

Section make_loop_section(const LoopLedger& ledger) {
  Section section{"Hours of the machine against probability",
                  fmt::format("{:.1f} of {:.1f} hours are used.", diagnosis::calc_hours_used(ledger), ledger.hours)};
  if (ledger.answers.empty()) return section;
  Block chart = make_curves({"Hours of the machine", "h", true}, {"Probability", "%", true},
                            Json::array({make_probability_steps(ledger, "first cause", &LoopAnswer::probability),
                                         make_probability_steps(ledger, "no effect", &LoopAnswer::none),
                                         make_probability_steps(ledger, "not in the catalog", &LoopAnswer::unknown)}),
                            "Each test ends where a step is. The dashed line is the probability at which a cause is "
                            "named. The first cause may be another one after a test: the table says which.");
  chart["marks"] = {kNamedAt_percent};
  section.blocks.push_back(std::move(chart));
  Table answers{"", {"after", "hours", "first cause", "probability", "chance expected"}, {}};
  for (const LoopAnswer& answer : ledger.answers) {
    const std::string chance =
        answer.tests == 0 ? "-" : diagnosis::show_probability(ledger.tests[answer.tests - 1].naming_chance);
    answers.rows.push_back({describe_loop_test(ledger, answer), fmt::format("{:.1f}", answer.hours),
                            describe_first_cause(answer), diagnosis::show_probability(answer.probability), chance});
  }
  section.blocks.push_back(make_table(answers));
  return section;
}

}  // namespace rollrig::report
