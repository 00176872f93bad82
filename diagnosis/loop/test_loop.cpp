#include "diagnosis/loop/test_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "diagnosis/next_test/plan_files.h"
#include "diagnosis/next_test/test_menu.h"
#include "diagnosis/thresholds.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/text.h"

namespace rollrig::diagnosis {
namespace {

namespace fs = std::filesystem;
using measurements::MeasuredRun;
using measurements::MeasurementSet;

constexpr const char* kLedgerFile = "loop.json";

std::string ledger_file(const std::string& folder) { return (fs::path(folder) / kLedgerFile).string(); }

std::string test_folder(const std::string& folder, std::size_t number) {
  return (fs::path(folder) / fmt::format("test-{}", number)).string();
}

/// Over all files of a set: set.toml, tire, rig or vehicle, runs.
std::string hash_set(const MeasurementSet& set) {
  std::string all = read_text_file(set.path) + set.tire.content;
  if (set.rig.has_value()) all += set.rig->content;
  if (set.vehicle.has_value()) all += set.vehicle->content;
  for (const MeasuredRun& run : set.runs) all += calc_sha256(read_table_file(run.file));
  return calc_sha256(all);
}

LoopLedger begin_ledger(const LoopInput& input, const MeasurementSet& set) {
  LoopLedger ledger;
  ledger.set = input.set;
  ledger.set_sha256 = hash_set(set);
  ledger.hours = input.hours.value_or(kUsualLoop_h);
  ledger.only = input.diagnosis.only;
  ledger.without = input.diagnosis.without;
  return ledger;
}

/// Throws InputError if the loop in the folder began with another set, or compares other effects.
void require_same(const LoopLedger& ledger, const LoopInput& input, const MeasurementSet& set) {
  const std::string file = ledger_file(input.folder);
  if (ledger.set_sha256 != hash_set(set)) {
    throw InputError({"the loop began with other files", file, 0, "set", input.set,
                      fmt::format("{} as it was then; or a new folder for --loop", ledger.set), ""});
  }
  const auto require_effects = [&](const char* key, const std::vector<std::string>& began,
                                   const std::vector<std::string>& given) {
    if (given.empty() || given == began) return;
    throw InputError({"the loop compares other effects", file, 0, key, fmt::format("{}", fmt::join(given, ",")),
                      fmt::format("those that it began with ({}); or a new folder for --loop",
                                  began.empty() ? "all" : fmt::format("{}", fmt::join(began, ","))),
                      ""});
  };
  require_effects("--only", ledger.only, input.diagnosis.only);
  require_effects("--without", ledger.without, input.diagnosis.without);
}

/// Measured files of the planned test that are not there yet.
std::vector<std::string> find_missing(const LoopInput& input, const LoopLedger& ledger) {
  std::vector<std::string> missing;
  for (const std::string& run : ledger.tests.back().runs) {
    const std::string file =
        (fs::path(test_folder(input.folder, ledger.tests.size())) / (run + "_measured.csv")).string();
    if (!fs::exists(file)) missing.push_back(file);
  }
  return missing;
}

/// Throws InputError for a folder that holds files and no loop, unless a first step was cut short there.
void require_own_folder(const std::string& folder) {
  if (!fs::exists(folder)) return;
  if (!fs::is_directory(folder)) {
    throw InputError({"not a folder", folder, 0, "--loop", folder, "a new folder, or that of a loop", ""});
  }
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename() == "test-1") continue;
    throw InputError({"the folder holds files and no loop", folder, 0, "--loop", entry.path().filename().string(),
                      "a new folder, or that of a loop", ""});
  }
}

/// Throws InputError where the planned test is no longer in its folder.
void require_test_folder(const std::string& folder) {
  if (fs::exists(fs::path(folder) / "set.toml")) return;
  throw InputError({"the folder of the planned test is gone", folder, 0, "", "",
                    "its plan as it was; or --test-failed, which gives the test up", ""});
}

/// Throws InputError where what a test measured is a copy of a run that the loop has already.
void require_new_samples(const MeasurementSet& known, const MeasurementSet& test) {
  for (const MeasuredRun& run : test.runs) {
    for (const MeasuredRun& other : known.runs) {
      if (read_table_file(other.file) != read_table_file(run.file)) continue;
      throw InputError({fmt::format("the samples are those of the run '{}'", other.id), run.file, 0, "", "",
                        "what the rig recorded in the planned test", ""});
    }
  }
}

/// The set with the runs of all measured tests.
MeasurementSet join_tests(MeasurementSet set, const LoopLedger& ledger, const LoopInput& input) {
  for (std::size_t i = 0; i < ledger.tests.size(); ++i) {
    if (ledger.tests[i].state != LoopTestState::kMeasured) continue;
    MeasurementSet test = measurements::read_measurement_set(test_folder(input.folder, i + 1), input.bad_rows);
    require_new_samples(set, test);
    set.sensors.merge(test.sensors);  // those of channels that the first set does not record
    for (MeasuredRun& run : test.runs) set.runs.push_back(std::move(run));
  }
  return set;
}

/// Ids of tests that failed twice. They are not planned a third time.
std::vector<std::string> list_hopeless(const LoopLedger& ledger) {
  constexpr std::size_t kTries = 2;
  std::map<std::string, std::size_t> failures;
  for (const LoopTest& test : ledger.tests) failures[test.id] += test.state == LoopTestState::kFailed ? 1 : 0;
  std::vector<std::string> hopeless;
  for (const auto& [id, count] : failures) {
    if (count >= kTries) hopeless.push_back(id);
  }
  return hopeless;
}

LoopTest make_ledger_test(const ProposedTest& test) {
  LoopTest entry{test.id,
                 test.test,
                 test.hours,
                 test.expected_bits_per_hour,
                 test.naming_chance.value_or(0.0),
                 test.splits,
                 {},
                 LoopTestState::kPlanned};
  for (const MeasuredRun& run : test.runs) entry.runs.push_back(run.id);
  return entry;
}

std::string write_loop_plan(const LoopInput& input, const LoopLedger& ledger, const MeasurementSet& set,
                            const ProposedTest& test) {
  const double left_h = ledger.hours - calc_hours_used(ledger);
  std::string text =
      fmt::format("Test {} of the loop on the set '{}'\n\n{}\n", ledger.tests.size() + 1, set.name, wrap(test.test, 2));
  text +=
      wrap(fmt::format("Takes {:.1f} of the {:.1f} h that are left, set-up included. Chance of a cause at 95 % within "
                       "them, with the tests after it: {:.0f} %",
                       test.hours, left_h, 100.0 * test.naming_chance.value_or(0.0)),
           2);
  if (!test.splits.empty()) text += wrap(fmt::format("Separates: {}", fmt::join(test.splits, ", ")), 2);
  text += "\nIn this order\n\n" + describe_runs(test, 0, *set.kind);
  text += "Afterwards\n\n";
  for (const MeasuredRun& run : test.runs) {
    text +=
        wrap(fmt::format("Put what was recorded of run {0} beside this file as {0}_measured.csv, with the columns of "
                         "the set's own runs.",
                         run.id),
             2);
  }
  text += wrap("Correct temperatures and pressures in set.toml to what they were.", 2);
  text += fmt::format("\n  rollrig validate {}\n  rollrig diagnose {} --loop {}\n",
                      test_folder(input.folder, ledger.tests.size() + 1), input.set, input.folder);
  return text + "\n" + wrap("If the test could not be done, add --test-failed to the second command.", 2);
}

/// Writes the folder of the next test, and adds the test to the ledger.
void plan_test(const LoopInput& input, const MeasurementSet& set, const ProposedTest& proposed, LoopLedger& ledger) {
  const ProposedTest test = rename_runs(proposed, ledger.tests.size() + 1);
  OutputFolder folder(test_folder(input.folder, ledger.tests.size() + 1), true);
  for (auto& [name, content] : write_test_files(set, {test})) folder.add(name, content);
  folder.add("set.toml", write_set_to_fill(set, {test}));
  folder.add("plan.txt", write_loop_plan(input, ledger, set, test));
  folder.commit();
  ledger.tests.push_back(make_ledger_test(test));
}

/// What follows from the last answer: the loop ends, or the next test is planned.
void decide(const LoopInput& input, const MeasurementSet& set, const Diagnosis& found, LoopLedger& ledger) {
  if (is_settled(ledger.answers.back())) {
    ledger.state = LoopState::kNamed;
  } else if (found.plan.has_value()) {
    ledger.state = LoopState::kWaiting;
    plan_test(input, set, *found.plan, ledger);
  } else {
    ledger.state = find_end_without_test(ledger);
  }
}

/// Sets the hours of the ledger to those of the input. Returns whether a loop that had too few may now go on.
bool take_hours(const LoopInput& input, LoopLedger& ledger) {
  if (!input.hours.has_value() || *input.hours == ledger.hours) return false;
  const bool is_more = *input.hours > ledger.hours;
  ledger.hours = *input.hours;
  const bool is_over = ledger.state == LoopState::kNamed && is_settled(ledger.answers.back());
  return is_more && !is_over;
}

void save_ledger(const LoopLedger& ledger, const LoopInput& input) {
  write_file_atomically(ledger_file(input.folder), to_text(make_ledger_json(ledger)));
}

bool is_waiting(const LoopLedger& ledger) {
  return !ledger.tests.empty() && ledger.tests.back().state == LoopTestState::kPlanned;
}

}  // namespace

LoopAnswer make_answer(const LoopLedger& ledger, const Diagnosis& found) {
  LoopAnswer answer;
  answer.tests = ledger.tests.size();
  answer.hours = calc_hours_used(ledger);
  answer.verdict = found.verdict;
  answer.none = probability_of(found, "none");
  answer.unknown = probability_of(found, "unknown");
  answer.nothing_detectable = found.nothing_detectable;
  answer.is_trace = found.verdict == Verdict::kNoGap && found.trace.has_value();
  if (!answer.is_trace && found.causes.empty()) return answer;
  const Cause& first = answer.is_trace ? *found.trace : found.causes.front();
  answer.alone = first.alone;
  answer.effects = first.effects;
  answer.indistinguishable_from = first.indistinguishable_from;
  answer.probability = first.probability;
  return answer;
}

bool is_named(const LoopAnswer& answer) {
  return (answer.verdict == Verdict::kExplained || answer.is_trace) && answer.indistinguishable_from.empty() &&
         answer.probability >= thresholds::kNamed;
}

bool is_settled(const LoopAnswer& answer) {
  return is_named(answer) && (answer.is_trace || answer.alone.value_or(1.0) >= thresholds::kNamedAlone);
}

ProposedTest rename_runs(ProposedTest test, std::size_t number) {
  const std::string usual = "next";
  for (MeasuredRun& run : test.runs) {
    run.id = fmt::format("test-{}-{}", number, run.id);
    run.session = fmt::format("test-{}{}", number, run.session.substr(std::min(usual.size(), run.session.size())));
  }
  return test;
}

LoopState find_end_without_test(const LoopLedger& ledger) {
  if (is_named(ledger.answers.back())) return LoopState::kNamed;
  constexpr double kShortest_h = 0.6;  // Assumed: set-up and a short run
  return ledger.hours - calc_hours_used(ledger) > kShortest_h ? LoopState::kNothingToTest : LoopState::kHoursGone;
}

LoopStep advance_loop(const LoopInput& input) {
  if (input.hours.has_value()) require_machine_hours(*input.hours);
  const MeasurementSet first = measurements::read_measurement_set(input.set, input.bad_rows);
  const bool is_begun = fs::exists(ledger_file(input.folder));
  if (!is_begun) require_own_folder(input.folder);
  LoopLedger ledger = is_begun ? read_ledger(ledger_file(input.folder)) : begin_ledger(input, first);
  if (is_begun) require_same(ledger, input, first);
  const bool has_more_hours = take_hours(input, ledger);
  const bool was_waiting = is_waiting(ledger);
  const auto wait = [&](std::vector<std::string> missing) {  // nothing new but the hours
    if (input.hours.has_value()) save_ledger(ledger, input);
    return LoopStep{ledger, join_tests(first, ledger, input), std::nullopt, std::move(missing)};
  };
  if (input.test_failed && !was_waiting) {
    throw InputError({"no test is planned that could have failed", input.folder, 0, "--test-failed", "",
                      "a loop that waits for a measurement", ""});
  }
  if (was_waiting && input.test_failed) {
    ledger.tests.back().state = LoopTestState::kFailed;
  } else if (was_waiting) {
    require_test_folder(test_folder(input.folder, ledger.tests.size()));
    std::vector<std::string> missing = find_missing(input, ledger);
    if (!missing.empty()) return wait(std::move(missing));
    ledger.tests.back().state = LoopTestState::kMeasured;
  } else if (is_begun && !has_more_hours) {
    return wait({});
  }
  MeasurementSet all = join_tests(first, ledger, input);
  DiagnosisOptions options = input.diagnosis;
  options.only = ledger.only;
  options.without = ledger.without;
  options.budget = TestBudget{ledger.hours - calc_hours_used(ledger), list_hopeless(ledger)};
  Diagnosis found = diagnose(all, options);
  ledger.answers.push_back(make_answer(ledger, found));
  fs::create_directories(input.folder);
  decide(input, all, found, ledger);
  save_ledger(ledger, input);
  return {std::move(ledger), std::move(all), std::move(found), {}};
}

std::string format_loop(const LoopStep& step, const std::string& folder) {
  const LoopLedger& ledger = step.ledger;
  const double left_h = ledger.hours - calc_hours_used(ledger);
  std::string text = format_ledger(ledger) + "\n";
  switch (ledger.state) {
    case LoopState::kNamed: {
      const LoopAnswer& last = ledger.answers.back();
      std::string more = last.is_trace ? " It is too small to matter." : "";
      if (!is_settled(last)) more = fmt::format(" That it acts alone has only {:.0f} %.", 100.0 * *last.alone);
      return text + wrap("The loop has ended: the cause is at 95 % or more." + more, 0);
    }
    case LoopState::kHoursGone:
      return text + wrap(fmt::format("The loop has ended: no test fits into the {:.1f} h left. --hours gives it more.",
                                     left_h),
                         0);
    case LoopState::kNothingToTest:
      return text +
             wrap(fmt::format("The loop has ended: no test that fits into the {:.1f} h left would tell more.", left_h),
                  0);
    case LoopState::kWaiting:
      break;
  }
  const LoopTest& next = ledger.tests.back();
  const std::string at = test_folder(folder, ledger.tests.size());
  text += wrap(fmt::format("Next test, {:.1f} h: {}", next.hours, next.test), 0);
  text += wrap(fmt::format("Chance of a cause at 95 % within the {:.1f} h left, with the tests after it: {:.0f} %",
                           left_h, 100.0 * next.naming_chance),
               0);
  text += step.missing.empty() ? fmt::format("{}/plan.txt says how\n", at)
                               : wrap(fmt::format("Waiting for {}", fmt::join(step.missing, ", ")), 0);
  return text;
}

}  // namespace rollrig::diagnosis
