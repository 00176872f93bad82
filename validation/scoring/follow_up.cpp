#include "validation/scoring/follow_up.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "diagnosis/next_test/next_test.h"
#include "diagnosis/next_test/plan_files.h"
#include "diagnosis/next_test/test_menu.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/interrupt.h"
#include "sim/core/parse_json.h"
#include "sim/core/random.h"
#include "sim/core/units.h"
#include "validation/files.h"
#include "validation/scoring/case.h"

namespace fs = std::filesystem;

namespace rollrig::validation {
namespace {

using diagnosis::PlannedTest;
using measurements::MeasuredRun;
using measurements::MeasurementSet;

constexpr const char* kPlansFormat = "rollrig-blind-plans/1";

const char* flag_of(Choice choice) { return choice == Choice::kDrawn ? " --drawn" : ""; }

/// Whether the verdict is explained, by a cause that the case cannot tell from others.
bool leaves_open(const Answer& answer) {
  const diagnosis::Diagnosis& said = answer.diagnosis;
  return answer.failure.empty() && said.verdict == diagnosis::Verdict::kExplained && !said.causes.empty() &&
         !said.causes.front().indistinguishable_from.empty();
}

/// Spans in which nothing is to be read.
Json list_unread_s(const MeasuredRun& run, const measurements::MachineKind& kind) {
  const std::vector<Quantity> channels = measurements::measured_channels(kind);
  const auto is_read = [&](std::size_t row) {
    return std::any_of(channels.begin(), channels.end(), [&](const Quantity& channel) {
      return run.has(channel) && !std::isnan(run.column(channel)[row]);
    });
  };
  Json spans = Json::array();
  for (std::size_t row = 0; row + 1 < run.time_s.size(); ++row) {
    if (is_read(row)) continue;
    if (!spans.empty() && spans.back()[1] == run.time_s[row]) {
      spans.back()[1] = run.time_s[row + 1];
    } else {
      spans.push_back({run.time_s[row], run.time_s[row + 1]});
    }
  }
  return spans;
}

Json make_run_json(const MeasuredRun& run, bool force_at_standstill, const measurements::MachineKind& kind) {
  return {{"id", run.id},
          {"file", run.id + ".csv"},
          {"session", run.session},
          {"cold_pressure_kPa", run.cold_pressure_Pa / 1e3},
          {"initial_tire_temperature_degC", run.initial_tire_temperature_K - kZeroCelsius_K},
          {"force_at_standstill", force_at_standstill},
          {"reversed", run.reversed},
          {"not_read_s", list_unread_s(run, kind)}};
}

/// What the generator needs of a test beside the inputs of its runs.
Json make_plan_json(const FollowUpPlan& plan, const MeasurementSet& set, const PlannedTest& test) {
  Json runs = Json::array();
  for (const MeasuredRun& run : test.runs) {
    runs.push_back(make_run_json(run, test.extra.force_at_standstill, *set.kind));
  }
  return {{"format", kPlanFormat},
          {"set", plan.number},
          {"set_sha256", plan.set_sha256},
          {"kind", set.kind->word},
          {"test", test.description},
          {"soaked", test.soaked},
          {"soak_h", test.soaked ? diagnosis::kSoak_h : 0.0},
          {"by_hand", test.by_hand},
          {"runs", runs}};
}

PlannedTest find_test(std::vector<PlannedTest> menu, const FollowUpPlan& plan, const std::string& file) {
  const auto at = std::find_if(menu.begin(), menu.end(),
                               [&plan](const PlannedTest& test) { return test.description == plan.test; });
  if (at != menu.end()) return *at;
  throw InputError({fmt::format("no test of the menu is the one proposed for case {}", plan.number), file, 0,
                    "next_test", plan.test, "an answer by this version of rollrig", ""});
}

PlannedTest draw_test(std::vector<PlannedTest> menu, std::uint64_t seed, const std::string& number) {
  menu.erase(
      std::remove_if(menu.begin(), menu.end(), [](const PlannedTest& one) { return !find_obstacle(one).empty(); }),
      menu.end());
  RandomStream draws(seed, "next test/" + number);
  return menu.at(static_cast<std::size_t>(draws.uniform() * static_cast<double>(menu.size())));
}

std::vector<Answer> read_answers(const PlanOrder& order) {
  std::vector<Answer> answers;
  const std::vector<std::string> numbers = list_cases(order.set);
  for (const std::string& number : numbers) {
    std::optional<Answer> answer = find_answer_to(order.set, order.answers, number);
    if (answer.has_value()) answers.push_back(*std::move(answer));
  }
  require_answers(numbers.size() - answers.size(), numbers.size(), order.answers,
                  "rollrig_validation run " + order.set);
  return answers;
}

void write_test(const FollowUpPlan& plan, const MeasurementSet& set, const PlannedTest& test, OutputFolder& out) {
  diagnosis::Diagnosis of;
  of.plan = diagnosis::make_proposed_test(test);
  const std::string folder = "plans/" + plan.number + "/";
  for (auto& [name, content] : diagnosis::write_plan(set, of)) {
    if (fs::path(name).extension() == ".csv") out.add(folder + name, content);
  }
  out.add(folder + "plan.json", to_text(make_plan_json(plan, set, test), 1));
}

/// The next test of a case, written where it can be made.
FollowUpPlan plan_case(const PlanOrder& order, const Answer& answer, OutputFolder& out) {
  FollowUpPlan plan{answer.number, answer.set_sha256, list_named(answer.diagnosis), "", ""};
  const std::vector<diagnosis::NextTest>& proposed = answer.diagnosis.next_tests;
  const MeasurementSet set = measurements::read_measurement_set(case_folder(order.set, plan.number));
  if (order.choice == Choice::kProposed && proposed.empty()) {
    plan.not_made = "no test is proposed";
    return plan;
  }
  std::vector<PlannedTest> menu = make_test_menu(diagnosis::PreparedSet(set));
  if (order.choice == Choice::kProposed) plan.test = proposed.front().test;
  const PlannedTest test = order.choice == Choice::kDrawn
                               ? draw_test(std::move(menu), order.seed, plan.number)
                               : find_test(std::move(menu), plan, answer_file(order.answers, plan.number));
  plan.test = test.description;
  plan.not_made = find_obstacle(test);
  if (plan.not_made.empty()) write_test(plan, set, test, out);
  return plan;
}

std::vector<FollowUpPlan> read_plans(const std::string& folder) {
  const std::string file = (fs::path(folder) / "plans.json").string();
  std::vector<FollowUpPlan> plans;
  try {
    const Json json = read_json(file);
    if (json.at("format") != kPlansFormat) {
      throw InputError(
          {"not the plans of a validation set", file, 0, "format", json.at("format").dump(), kPlansFormat, ""});
    }
    for (const Json& one : json.at("sets")) {
      plans.push_back({one.at("set").get<std::string>(), one.at("set_sha256").get<std::string>(),
                       one.at("named").get<std::vector<std::string>>(), one.at("test").get<std::string>(),
                       one.at("not_made").get<std::string>()});
    }
  } catch (const Json::exception& error) {
    throw InputError(
        {fmt::format("not the plans of a validation set: {}", error.what()), file, 0, "sets", "", kPlansFormat, ""});
  }
  return plans;
}

/// Whether a plan was made for this answer.
bool is_for(const FollowUpPlan& plan, const Answer& answer, Choice choice) {
  const std::vector<diagnosis::NextTest>& proposed = answer.diagnosis.next_tests;
  const bool is_its_test =
      choice == Choice::kDrawn || plan.test == (proposed.empty() ? std::string() : proposed.front().test);
  return plan.set_sha256 == answer.set_sha256 && plan.named == list_named(answer.diagnosis) && is_its_test;
}

}  // namespace

const char* folder_of(Choice choice) { return choice == Choice::kDrawn ? kDrawnFollowUpFolder : kFollowUpFolder; }

std::string find_obstacle(const PlannedTest& test) {
  if (!test.extra.sensors.empty()) return "a further sensor: the generator has none";
  if (!test.numbers.empty()) return "a number of the files: the generator does not determine it again";
  if (test.clock_pulse) return "a common pulse: a set does not hold when it came";
  return "";
}

std::map<std::string, std::string> write_generator_plan(const std::string& number, const std::string& set_sha256,
                                                        const MeasurementSet& set,
                                                        const std::vector<diagnosis::ProposedTest>& tests) {
  std::map<std::string, std::string> files;
  Json runs = Json::array();
  for (const diagnosis::ProposedTest& test : tests) {
    for (const MeasuredRun& run : test.runs) runs.push_back(make_run_json(run, test.force_at_standstill, *set.kind));
  }
  for (auto& [name, content] : diagnosis::write_test_files(set, tests)) {
    if (fs::path(name).extension() == ".csv") files[name] = std::move(content);
  }
  const Json plan = {
      {"format", kPlanFormat}, {"set", number}, {"set_sha256", set_sha256}, {"kind", set.kind->word}, {"runs", runs}};
  files["plan.json"] = to_text(plan, 1);
  return files;
}

std::vector<std::string> list_named(const diagnosis::Diagnosis& diagnosis) {
  if (diagnosis.causes.empty()) return {};
  std::vector<std::string> all = diagnosis.causes.front().effects;
  const std::vector<std::string>& others = diagnosis.causes.front().indistinguishable_from;
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

bool FollowUp::is_promised(const Answer& before) const {
  if (before.diagnosis.next_tests.empty()) return false;
  const std::vector<std::string>& splits = before.diagnosis.next_tests.front().splits;
  const auto said = std::count_if(plan.named.begin(), plan.named.end(), [&](const std::string& id) {
    return std::find(splits.begin(), splits.end(), id) != splits.end();
  });
  return said >= 2;
}

std::vector<FollowUpPlan> plan_follow_ups(const PlanOrder& order) {
  const std::string folder = (fs::path(order.set) / folder_of(order.choice)).string();
  require_new_folder(folder, "plan");
  OutputFolder out(folder, false);
  const std::vector<Answer> answers = read_answers(order);
  std::vector<FollowUpPlan> plans;
  Json sets = Json::array();
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (leaves_open(answers[i])) {
      const FollowUpPlan& plan = plans.emplace_back(plan_case(order, answers[i], out));
      sets.push_back({{"set", plan.number},
                      {"set_sha256", plan.set_sha256},
                      {"named", plan.named},
                      {"test", plan.test},
                      {"not_made", plan.not_made}});
    }
    if (order.progress) order.progress(i + 1, answers.size());
  }
  const Json all = {{"format", kPlansFormat}, {"choice", folder_of(order.choice)}, {"sets", sets}};
  out.add("plans.json", to_text(all, 1));
  throw_if_interrupted();
  out.commit();
  return plans;
}

void read_follow_ups(const std::string& set, Choice choice, const std::string& folder, std::vector<Case>& cases) {
  if (folder.empty()) return;
  const std::vector<FollowUpPlan> plans = read_plans(folder);
  const std::string answers = (fs::path(folder) / "answers").string();
  std::size_t lacking = 0;
  for (Case& one : cases) {
    if (!leaves_open(one.answer)) continue;
    const auto plan = std::find_if(plans.begin(), plans.end(),
                                   [&one](const FollowUpPlan& of) { return of.number == one.truth.number; });
    if (plan == plans.end() || !is_for(*plan, one.answer, choice)) {
      throw InputError({fmt::format("these are no plans for the answer to case {}", one.truth.number), folder, 0,
                        "case", one.truth.number,
                        fmt::format("without that folder: rollrig_validation plan {}{}", set, flag_of(choice)), ""});
    }
    FollowUp follow_up{*plan, {}};
    if (plan->not_made.empty()) {
      const bool is_done = fs::is_directory(case_folder(folder, plan->number));
      if (is_done) follow_up.answer = find_answer_to(folder, answers, plan->number);
      lacking += follow_up.answer.has_value() ? 0 : 1;
    }
    (choice == Choice::kDrawn ? one.drawn_test : one.next_test) = std::move(follow_up);
  }
  if (lacking == 0) return;
  throw InputError(
      {fmt::format("{} cases have no answer to their next test", lacking), folder, 0, "answers", "",
       fmt::format("first: rollrig_validation follow-up {}{}, rollrig_validation run {}", set, flag_of(choice), folder),
       ""});
}

}  // namespace rollrig::validation
