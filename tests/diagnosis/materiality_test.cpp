// Which causes are too small to matter.
#include "diagnosis/findings/materiality.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "diagnosis/findings/energy_scale.h"
#include "sim/core/error.h"
#include "tests/diagnosis/answers.h"
#include "tests/diagnosis/compared_set.h"
#include "tests/diagnosis/gap_sets.h"
#include "tests/support/fit_study.h"

using namespace rollrig;
using diagnosis::Candidate;
using diagnosis::Cause;
using diagnosis::CauseChange;
using diagnosis::is_immaterial;
using diagnosis::Verdict;

namespace {

constexpr double kUsual_percent = 0.5;

double sum_of(const std::map<std::string, double>& probability) {
  double sum = 0.0;
  for (const auto& [name, value] : probability) sum += value;
  return sum;
}

/// A torque gain of `u` prior units beside the numbers of the baseline's fit, and what it is as a share. Its shape is
/// that of a gain of all readings alike.
Candidate make_gain(const tests::FittedBaseline& fitted, double u, double& gain) {
  Candidate candidate = fitted.null;
  candidate.fit.hypothesis = diagnosis::Hypothesis{}.with({&diagnosis::find_term("torque_gain"), 1});
  const diagnosis::Model model = fitted.make_model(candidate.fit.hypothesis);
  Eigen::VectorXd own = Eigen::VectorXd::Zero(diagnosis::to_index(model.own_count()));
  own[0] = u;
  candidate.fit.unknowns.resize(own.size() + fitted.null.fit.unknowns.size());
  candidate.fit.unknowns << own, fitted.null.fit.unknowns;
  gain = model.own_parameters().front().value_at(u).value_SI;
  REQUIRE(model.simulate(candidate.fit.unknowns, 1, candidate.fit.simulated, nullptr));
  return candidate;
}

}  // namespace

TEST_CASE("a cause is a trace only where it is small both in energy and in what is read", "[fast]") {
  CHECK(is_immaterial({0.1, 0.2}, kUsual_percent));
  CHECK_FALSE(is_immaterial({0.1, 0.6}, kUsual_percent));  // retuned numbers hide it
  CHECK_FALSE(is_immaterial({0.4, 0.2}, kUsual_percent));  // it comes and goes, or is read as a temperature
  CHECK_FALSE(is_immaterial({0.4, 0.6}, kUsual_percent));
  CHECK(is_immaterial({0.1, std::nullopt}, kUsual_percent));
}

TEST_CASE("the smallest effect of interest scales both limits, and 0 turns them off", "[fast]") {
  CHECK(is_immaterial({0.5, 0.9}, 1.0));
  CHECK_FALSE(is_immaterial({0.7, 0.9}, 1.0));
  CHECK_FALSE(is_immaterial({0.0, 0.0}, 0.0));
}

TEST_CASE("a trace leaves the causes, and its probability goes to none", "[fast]") {
  Cause small;
  small.effects = {"torque_gain"};
  small.indistinguishable_from = {"inertia_error"};
  small.probability = 0.9;
  Cause other;
  other.effects = {"slow_leak"};
  other.probability = 0.02;
  std::vector<Cause> causes{small, other};
  std::map<std::string, double> probability{
      {"none", 0.05}, {"unknown", 0.03}, {"torque_gain", 0.7}, {"inertia_error", 0.2}, {"slow_leak", 0.02}};
  const double before = sum_of(probability);
  const Cause trace = diagnosis::set_aside_trace(causes, probability);
  CHECK(trace.effects == small.effects);
  CHECK(trace.probability == 0.9);
  REQUIRE(causes.size() == 1);
  CHECK(causes.front().effects == other.effects);
  CHECK(probability.at("none") == Approx(0.95));
  CHECK(probability.at("torque_gain") == Approx(0.0).margin(1e-12));
  CHECK(probability.at("slow_leak") == 0.02);
  CHECK(sum_of(probability) == Approx(before));
}

TEST_CASE("a gain of the torque changes the energy by its size, and more than it by the drum's own loss", "[fast]") {
  const tests::FittedBaseline fitted(tests::add_noise(tests::make_gap_set({}, 2), 4));
  double small = 0.0;
  double large = 0.0;
  const CauseChange by_small = diagnosis::measure_change(fitted, make_gain(fitted, 0.5, small));
  const CauseChange by_large = diagnosis::measure_change(fitted, make_gain(fitted, 1.0, large));
  REQUIRE(large != 0.0);
  REQUIRE(by_large.energy_percent.has_value());
  CHECK(*by_large.energy_percent > 100.0 * std::abs(large));
  // The torque of tire and drum, as a share of the tire's energy.
  const double of_all_percent = diagnosis::EnergyScale(fitted.set).calc_percent(fitted.null.fit.simulated).value();
  CHECK(*by_large.energy_percent == Approx(std::abs(large) * of_all_percent).epsilon(1e-3));
  CHECK(*by_small.energy_percent / *by_large.energy_percent == Approx(small / large).epsilon(1e-6));
  CHECK(by_small.floors / by_large.floors == Approx(small / large).epsilon(1e-6));
}

TEST_CASE("what retuned numbers hide is nothing that is read, and its energy counts", "[fast]") {
  const tests::FittedBaseline fitted(tests::add_noise(tests::make_gap_set({}, 2), 4));
  double gain = 0.0;
  Candidate hidden = make_gain(fitted, 1.0, gain);
  hidden.fit.simulated = fitted.null.fit.simulated;
  CHECK(diagnosis::measure_change(fitted, hidden).floors == Approx(0.0).margin(1e-9));
  hidden = make_gain(fitted, 1.0, gain);
  const double offset_of_torque = 1.0;  // prior units; an offset that hides nothing counts as well
  hidden.fit.unknowns[diagnosis::to_index(fitted.make_model(hidden.fit.hypothesis).parameter_count())] +=
      offset_of_torque;
  const CauseChange with_offset = diagnosis::measure_change(fitted, hidden);
  CHECK(with_offset.floors !=
        Approx(diagnosis::measure_change(fitted, make_gain(fitted, 1.0, gain)).floors).epsilon(0.01));
  CHECK(with_offset.energy_percent.value() ==
        Approx(diagnosis::measure_change(fitted, make_gain(fitted, 1.0, gain)).energy_percent.value()));
}

TEST_CASE("a cause below the smallest effect of interest is no gap, and a trace with its size and probability",
          "[slow]") {
  const auto set = tests::measure_on_drum({tests::act("bearing_warmup")}, {tests::plan_skim_run()});
  diagnosis::DiagnosisOptions options = tests::only({"bearing_warmup", "slow_leak"});
  const diagnosis::Diagnosis matters = diagnosis::diagnose(set, options);
  REQUIRE(matters.verdict == Verdict::kExplained);
  REQUIRE(matters.causes.front().change.has_value());
  CHECK(matters.causes.front().change->floors > 0.3);
  CHECK_FALSE(matters.trace.has_value());
  options.smallest_effect_percent = 50.0;
  const diagnosis::Diagnosis trace = diagnosis::diagnose(set, options);
  CHECK(trace.verdict == Verdict::kNoGap);
  REQUIRE(trace.trace.has_value());
  CHECK(trace.trace->effects == matters.causes.front().effects);
  CHECK(trace.trace->probability == Approx(matters.causes.front().probability));
  CHECK(trace.trace->change->floors == matters.causes.front().change->floors);
  CHECK(trace.probability.at("none") > 0.9);
  CHECK(sum_of(trace.probability) == Approx(sum_of(matters.probability)));
  for (const Cause& cause : trace.causes) CHECK(cause.effects != trace.trace->effects);
  for (const std::string& name : trace.not_excluded) CHECK(name != trace.trace->effects.front());
}

TEST_CASE("a smallest effect that is no share is refused", "[fast]") {
  const auto set = tests::measure_on_drum({}, {tests::plan_skim_run()});
  for (const double percent : {-1.0, 101.0, std::numeric_limits<double>::quiet_NaN()}) {
    diagnosis::DiagnosisOptions options = tests::only({"bearing_warmup"});
    options.smallest_effect_percent = percent;
    CHECK_THROWS_AS(diagnosis::diagnose(set, options), InputError);
  }
}
