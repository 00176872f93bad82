#include "diagnosis/next_test/next_test.h"

#include <algorithm>
#include <functional>
#include <optional>

#include "diagnosis/checks/rig_sensors.h"
#include "diagnosis/kinds/measurement_kind.h"
#include "diagnosis/next_test/naming_chance.h"
#include "diagnosis/next_test/predicted_test.h"
#include "diagnosis/thresholds.h"
#include "sim/core/parallel.h"

namespace rollrig::diagnosis {
namespace {

/// Whether two predictions overlap as little as two of equal covariance whose expected log Bayes factor is 3: their
/// distance of Bhattacharyya is a quarter of it. Unlike the divergence it does not depend on which is true.
bool are_told_apart(const PredictedOutcome& a, const PredictedOutcome& b) {
  return 4.0 * calc_overlap_distance_nats(a, b) >= thresholds::kToldApart_nats;
}

/// What a test splits.
struct Splits {
  std::vector<std::string> effects;
  bool likeliest = false;  // tells two of the likeliest hypotheses apart
};

/// Effects in one hypothesis of a pair and not in the other, of all pairs of a likeliest hypothesis and any other that
/// are told apart; "unknown" for families of unknown effects.
Splits find_splits(const std::vector<OpenHypothesis>& open,
                   const std::function<bool(std::size_t, std::size_t)>& are_apart) {
  Splits splits;
  const auto add = [&](const Hypothesis& in, const Hypothesis& not_in) {
    for (const SignedTerm& one : in.terms) {
      const std::string name = one.term->is_unknown() ? "unknown" : one.term->name();
      const bool known = std::find(splits.effects.begin(), splits.effects.end(), name) != splits.effects.end();
      if (!known && !not_in.contains(*one.term)) splits.effects.push_back(name);
    }
  };
  const auto is_likeliest = [&](std::size_t i) { return open[i].probability >= open.front().probability; };
  for (std::size_t i = 0; i < open.size() && is_likeliest(i); ++i) {
    for (std::size_t j = i + 1; j < open.size(); ++j) {
      if (!are_apart(i, j)) continue;
      add(open[i].hypothesis, open[j].hypothesis);
      add(open[j].hypothesis, open[i].hypothesis);
      splits.likeliest = splits.likeliest || is_likeliest(j);
    }
  }
  return splits;
}

std::vector<double> list_probabilities(const std::vector<OpenHypothesis>& open) {
  std::vector<double> probabilities;
  for (const OpenHypothesis& one : open) probabilities.push_back(one.probability);
  return probabilities;
}

constexpr double kWorthwhile_bits = 0.01;

ProposedTest describe_judged(const JudgedTest& one, std::optional<double> naming_chance) {
  ProposedTest proposed = make_proposed_test(one.test);
  proposed.splits = one.splits;
  proposed.expected_bits_per_hour = one.bits / one.test.hours;
  proposed.naming_chance = naming_chance;
  return proposed;
}

/// Whether a loop may propose a test: its runs alone hold all that it tells.
bool is_allowed(const TestBudget& budget, const rigs::MachineKind& kind, const PlannedTest& test) {
  const bool is_left_out = std::find(budget.without.begin(), budget.without.end(), test.id) != budget.without.end();
  return !is_left_out && test.numbers.empty() && test.hours <= budget.hours && is_held_by_sets(test, kind);
}

/// Tests of those given (that which tells most an hour first) that fit a budget, the best to begin with first.
std::vector<ProposedTest> propose_within(const TestBudget& budget, const rigs::MachineKind& kind,
                                         const std::vector<JudgedTest>& judged,
                                         const std::vector<double>& probabilities) {
  constexpr double kAsGood = 0.02;  // Assumed: chances so near each other are alike, as few draws show them
  std::vector<const JudgedTest*> allowed;
  std::vector<PossibleTest> possible;
  for (const JudgedTest& one : judged) {
    if (!is_allowed(budget, kind, one.test)) continue;
    allowed.push_back(&one);
    possible.push_back({one.test.hours, OutcomeDraws(one.outcomes, one.test.id)});
  }
  const std::vector<double> chances = find_naming_chances(probabilities, possible, budget.hours, thresholds::kNamed);
  std::vector<ProposedTest> proposed;
  for (std::size_t i = 0; i < allowed.size(); ++i) proposed.push_back(describe_judged(*allowed[i], chances[i]));
  if (proposed.empty()) return proposed;
  const double best = *std::max_element(chances.begin(), chances.end());
  std::stable_partition(proposed.begin(), proposed.end(),
                        [&](const ProposedTest& one) { return *one.naming_chance >= best - kAsGood; });
  return proposed;
}

}  // namespace

ProposedTest make_proposed_test(const PlannedTest& test) {
  return {{test.description, {}, 0.0, test.hours, test.by_hand, test.id},
          test.soaked,
          test.extra.force_at_standstill,
          test.runs};
}

std::vector<JudgedTest> judge_tests(const Study& study, const std::vector<OpenHypothesis>& open) {
  std::vector<JudgedTest> judged;
  for (PlannedTest& test : make_test_menu(study.set)) judged.push_back({std::move(test), 0.0, {}, false, {}});
  const std::vector<double> probabilities = list_probabilities(open);
  parallel_for(
      judged.size(), study.settings.threads,
      [&](std::size_t i) {
        const PredictedTest predicted(study, open, judged[i].test);
        if (!predicted.is_possible()) return;
        judged[i].outcomes = predicted.find_outcomes();
        const std::vector<PredictedOutcome>& outcomes = judged[i].outcomes;
        judged[i].bits = calc_information_bits(probabilities, outcomes);
        const Splits splits =
            find_splits(open, [&](std::size_t a, std::size_t b) { return are_told_apart(outcomes[a], outcomes[b]); });
        judged[i].splits = splits.effects;
        judged[i].splits_likeliest = splits.likeliest;
      },
      study.settings.advance());
  return judged;
}

std::vector<ProposedTest> propose_tests(const Study& study, const std::vector<OpenHypothesis>& open,
                                        const std::optional<TestBudget>& budget) {
  constexpr std::size_t kProposed = 3;
  if (open.size() < 2) return {};
  std::vector<JudgedTest> judged = judge_tests(study, open);
  judged.erase(
      std::remove_if(judged.begin(), judged.end(), [](const JudgedTest& one) { return one.bits < kWorthwhile_bits; }),
      judged.end());
  std::stable_sort(judged.begin(), judged.end(), [](const JudgedTest& a, const JudgedTest& b) {
    if (a.splits_likeliest != b.splits_likeliest) return a.splits_likeliest;
    return a.bits / a.test.hours > b.bits / b.test.hours;
  });
  if (budget.has_value()) return propose_within(*budget, *study.set.source().kind, judged, list_probabilities(open));
  std::vector<ProposedTest> proposed;
  for (const JudgedTest& one : judged) {
    if (proposed.size() < kProposed) proposed.push_back(describe_judged(one, std::nullopt));
  }
  return proposed;
}

std::vector<NextSensor> propose_sensors(const Study& study, const std::vector<OpenHypothesis>& open) {
  const std::optional<PlannedTest> run = open.size() < 2 ? std::nullopt : study.set.kind().make_sensor_test(study.set);
  if (!run.has_value()) return {};
  const PredictedTest predicted(study, open, *run);
  if (!predicted.is_possible()) return {};
  const std::vector<Quantity>& added = run->extra.sensors;
  const auto is_added = [&](const Quantity& channel) {
    return std::find(added.begin(), added.end(), channel) != added.end();
  };
  const std::vector<double> probabilities = list_probabilities(open);
  const std::vector<PredictedOutcome> without =
      predicted.find_outcomes([&](const Quantity& channel) { return !is_added(channel); });
  const double bits_without = calc_information_bits(probabilities, without);
  std::vector<NextSensor> proposed;
  for (const Quantity& sensor : added) {
    const std::vector<PredictedOutcome> with =
        predicted.find_outcomes([&](const Quantity& channel) { return channel == sensor || !is_added(channel); });
    const double bits = calc_information_bits(probabilities, with) - bits_without;
    if (bits < kWorthwhile_bits) continue;
    const Splits splits = find_splits(open, [&](std::size_t a, std::size_t b) {
      return are_told_apart(with[a], with[b]) && !are_told_apart(without[a], without[b]);
    });
    const RigSensor& named = find_rig_sensor(sensor);
    proposed.push_back({named.description, splits.effects, bits, named.hours});
  }
  std::stable_sort(proposed.begin(), proposed.end(), [](const NextSensor& a, const NextSensor& b) {
    return a.expected_bits / a.hours > b.expected_bits / b.hours;
  });
  return proposed;
}

}  // namespace rollrig::diagnosis
