#include "validation/program/loop_cases.h"

#include <fmt/format.h>

#include <stdlib.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <set>

#include "diagnosis/campaign/campaign.h"
#include "diagnosis/loop/test_loop.h"
#include "diagnosis/next_test/next_test.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/interrupt.h"
#include "sim/core/parallel.h"
#include "sim/core/random.h"
#include "validation/files.h"
#include "validation/generator/follow_up.h"
#include "validation/scoring/follow_up.h"

namespace rollrig::validation {
namespace {

namespace fs = std::filesystem;
using diagnosis::LoopState;
using diagnosis::LoopTestState;
using diagnosis::ProposedTest;
using measurements::MeasurementSet;

/// A folder for the files of one loop, which is removed with the object.
class LoopFolder {
 public:
  LoopFolder() {
    std::string path = (fs::temp_directory_path() / "rollrig-loop-XXXXXX").string();
    if (::mkdtemp(path.data()) == nullptr) {
      throw InputError({"no folder can be made there", fs::temp_directory_path().string(), 0, "", "",
                        "a folder for temporary files that can be written (TMPDIR)", ""});
    }
    path_ = path;
  }
  ~LoopFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  LoopFolder(const LoopFolder&) = delete;
  LoopFolder& operator=(const LoopFolder&) = delete;

  /// Writes files into a new folder below it, and returns that folder.
  template <class Files>
  std::string write(const std::string& name, const Files& files) const {
    const std::string folder = (fs::path(path_) / name).string();
    fs::remove_all(folder);
    fs::create_directories(folder);
    for (const auto& [file, content] : files) write_file_atomically((fs::path(folder) / file).string(), content);
    return folder;
  }

 private:
  std::string path_;
};

/// Ids of the tests of the menu that the generator cannot simulate.
std::vector<std::string> list_impossible(const MeasurementSet& set) {
  std::vector<std::string> impossible;
  for (const diagnosis::PlannedTest& test : make_test_menu(diagnosis::PreparedSet(set))) {
    if (!find_obstacle(test).empty()) impossible.push_back(test.id);
  }
  return impossible;
}

/// One of the tests that could be done, drawn with equal probability; no runs if there is none.
ProposedTest draw_test(const MeasurementSet& set, const diagnosis::TestBudget& budget, RandomStream& random) {
  std::vector<diagnosis::PlannedTest> possible;
  for (diagnosis::PlannedTest& test : make_test_menu(diagnosis::PreparedSet(set))) {
    const bool is_out = std::find(budget.without.begin(), budget.without.end(), test.id) != budget.without.end();
    if (!is_out && test.hours <= budget.hours) possible.push_back(std::move(test));
  }
  if (possible.empty()) return {};
  return diagnosis::make_proposed_test(
      possible[static_cast<std::size_t>(random.uniform() * static_cast<double>(possible.size()))]);
}

/// The campaign for the machine and tire of a set.
std::vector<diagnosis::PlannedTest> plan_campaign_for(const MeasurementSet& set, double hours) {
  diagnosis::CampaignInput input;
  input.rig = set.rig.has_value() ? set.rig->path : set.kind->word;
  input.tire = set.tire.path;
  if (set.vehicle.has_value()) input.vehicle = set.vehicle->path;
  input.hours = hours;
  input.threads = 1;
  return diagnosis::plan_campaign(input).tests;
}

/// The tests of the campaign that can be done with a set, in their order.
std::vector<ProposedTest> list_campaign(const MeasurementSet& set, double hours,
                                        const std::vector<std::string>& impossible) {
  const std::vector<diagnosis::PlannedTest> menu = make_test_menu(diagnosis::PreparedSet(set));
  std::vector<ProposedTest> tests;
  if (std::none_of(menu.begin(), menu.end(), [&](const auto& one) { return one.hours <= hours; })) return tests;
  for (const diagnosis::PlannedTest& planned : plan_campaign_for(set, hours)) {
    const auto same = std::find_if(menu.begin(), menu.end(), [&](const auto& one) { return one.id == planned.id; });
    const bool is_possible =
        same != menu.end() && std::find(impossible.begin(), impossible.end(), planned.id) == impossible.end();
    if (is_possible) tests.push_back(diagnosis::make_proposed_test(*same));
  }
  return tests;
}

/// Runs the loop of one case.
void loop_case(const LoopOrder& order, const Json& truth, LoopOfCase& loop) {
  const std::string& number = loop.truth.number;
  const std::string folder = case_folder(order.set, number);
  const LoopFolder place;
  const MeasurementSet first = measurements::read_measurement_set(folder);
  loop.kind = first.kind->word;
  const std::vector<std::string> impossible = list_impossible(first);
  RandomStream random(order.seed, "loop/" + number);  // of failures
  RandomStream draws(order.seed, "loop/" + number + "/tests");
  diagnosis::LoopLedger& ledger = loop.ledger;
  ledger.set = number;
  ledger.hours = order.hours;
  MeasurementSet set = first;
  std::vector<ProposedTest> measured;
  std::string plan;  // of the measured tests, for the generator
  const std::vector<ProposedTest> campaign =
      order.tests == LoopTests::kFixed ? list_campaign(first, order.hours, impossible) : std::vector<ProposedTest>{};
  const auto choose_test = [&](const diagnosis::Diagnosis& found, const diagnosis::TestBudget& budget) {
    if (order.tests == LoopTests::kDrawn) return draw_test(first, budget, draws);
    if (order.tests == LoopTests::kProposed) return found.plan.value_or(ProposedTest{});
    constexpr double kRounding_h = 1e-6;
    const std::size_t next = measured.size();  // a test that failed is done again
    const bool fits = next < campaign.size() && campaign[next].hours <= budget.hours + kRounding_h;
    return fits ? campaign[next] : ProposedTest{};
  };
  while (true) {
    diagnosis::DiagnosisOptions options;
    options.threads = 1;
    options.budget = diagnosis::TestBudget{order.hours - diagnosis::calc_hours_used(ledger), impossible};
    const auto start = std::chrono::steady_clock::now();
    const diagnosis::Diagnosis found = diagnosis::diagnose(set, options);
    loop.slowest_step_s =
        std::max(loop.slowest_step_s, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    ledger.answers.push_back(diagnosis::make_answer(ledger, found));
    if (order.with_ideal && !loop.truth.effects.empty()) {
      loop.separable.push_back(generator::find_upper_bound_after(order.set, number, truth, plan).is_separable());
    }
    if (diagnosis::is_settled(ledger.answers.back())) {
      ledger.state = LoopState::kNamed;
      return;
    }
    ProposedTest test = choose_test(found, *options.budget);
    if (test.runs.empty()) {
      ledger.state = diagnosis::find_end_without_test(ledger);
      return;
    }
    test = diagnosis::rename_runs(std::move(test), ledger.tests.size() + 1);
    const bool is_failed = random.uniform() < order.failing_share;
    ledger.tests.push_back({test.id,
                            test.test,
                            test.hours,
                            test.expected_bits_per_hour,
                            test.naming_chance.value_or(0.0),
                            test.splits,
                            {},
                            is_failed ? LoopTestState::kFailed : LoopTestState::kMeasured});
    if (is_failed) continue;
    measured.push_back(std::move(test));
    plan = place.write("plan", write_generator_plan(number, hash_case(folder), first, measured));
    set = measurements::read_measurement_set(
        place.write("set", generator::make_follow_up(order.set, number, truth, plan)));
  }
}

}  // namespace

bool LoopOfCase::names_truth(const diagnosis::LoopAnswer& answer) const {
  const std::vector<std::string>& named = answer.effects;
  const std::vector<std::string> ids = truth.ids();
  return diagnosis::is_named(answer) && !truth.outside &&
         std::set<std::string>(named.begin(), named.end()) == std::set<std::string>(ids.begin(), ids.end());
}

bool LoopOfCase::is_right() const { return is_named() && names_truth(ledger.answers.back()); }

bool LoopOfCase::is_right_by(double hours) const {
  const diagnosis::LoopAnswer* last = nullptr;
  for (const diagnosis::LoopAnswer& answer : ledger.answers) {
    if (answer.hours <= hours) last = &answer;
  }
  return last != nullptr && names_truth(*last);
}

bool LoopOfCase::is_separable_by(double hours) const {
  for (std::size_t i = 0; i < separable.size(); ++i) {
    if (separable[i] && ledger.answers[i].hours <= hours) return true;
  }
  return false;
}

std::vector<LoopOfCase> loop_cases(const LoopOrder& order) {
  const Json cases = open_truth(order.set, "").cases;
  std::vector<LoopOfCase> loops;
  for (Truth& truth : read_truths(order.set, "")) loops.push_back({std::move(truth), "", {}, {}, 0.0, ""});
  std::mutex mutex;
  std::size_t done = 0;
  parallel_for(loops.size(), order.threads, [&](std::size_t i) {
    try {
      loop_case(order, cases.at(loops[i].truth.number), loops[i]);
    } catch (const Interrupted&) {
      throw;
    } catch (const std::exception& error) {
      loops[i].failure = error.what();
    }
    const std::lock_guard<std::mutex> lock(mutex);
    if (order.progress) order.progress(++done, loops.size());
  });
  return loops;
}

}  // namespace rollrig::validation
