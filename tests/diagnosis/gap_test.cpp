#include "diagnosis/findings/gap.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "diagnosis/thresholds.h"
#include "tests/diagnosis/gap_sets.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/fit_study.h"

using namespace rollrig;
using diagnosis::Candidate;
using diagnosis::Gap;
using diagnosis::PreparedSet;
using diagnosis::Series;
using tests::FittedBaseline;

namespace {

constexpr std::size_t kTorque = 0;
/// Noise floors. The mean of squares over some 300 times of a drift has a standard deviation of 0.08; root of three.
constexpr double kNoiseAlone = 0.5;

Gap find(const FittedBaseline& fitted, const Candidate* cause = nullptr) { return diagnosis::find_gap(fitted, cause); }

/// An effect fitted to a set by itself, of the likelier sign where both are possible.
Candidate fit_effect(const FittedBaseline& fitted, const char* id) {
  diagnosis::StudySettings settings;
  settings.terms = {&diagnosis::find_term(id)};
  diagnosis::Study study(fitted.set.source(), settings);
  const diagnosis::Comparison comparison = diagnosis::compare_models(study);
  REQUIRE_FALSE(comparison.candidates.empty());
  return comparison.candidates.front();
}

std::vector<models::ActiveEffect> warming_bearings(double fall_per_K = 0.02) {
  return {tests::make_active(models::find_effect("bearing_warmup"), {fall_per_K, 20.0, 15.0, 1.0})};
}

/// A torque that is off by turns to either side, a minute each: nothing that a base parameter or an offset could take.
void add_turns(double size_Nm, measurements::MeasurementSet& set) {
  for (measurements::MeasuredRun& run : set.runs) {
    tests::add_to_channel(run, "drum_torque_Nm", [size_Nm](double time_s) {
      return static_cast<long>(time_s / 60.0) % 2 == 0 ? size_Nm : -size_Nm;
    });
  }
}

double floor_of_torque(const PreparedSet& set) {
  for (const Series& series : set.series()) {
    if (series.channel == kTorque) return series.floor;
  }
  throw std::logic_error("no torque");
}

double share_of_torque(const PreparedSet& set) {
  double blocks = 0.0;
  for (const Series& series : set.series())
    blocks += series.channel == kTorque ? static_cast<double>(series.size()) : 0.0;
  return blocks / static_cast<double>(set.residual_count());
}

}  // namespace

TEST_CASE("of noise alone there is no gap: as often below the noise as above it", "[slow]") {
  constexpr int kSets = 20;
  const auto clean = tests::make_gap_set({}, 3);
  int above = 0;
  for (int seed = 1; seed <= kSets; ++seed) {
    const Gap gap = find(FittedBaseline(tests::add_noise(clean, static_cast<std::uint64_t>(seed))));
    INFO("seed " << seed);
    CHECK(gap.as_calibrated.before < kNoiseAlone);
    CHECK(gap.recalibrated.before < kNoiseAlone);
    above += gap.as_calibrated.before > 0.0 ? 1 : 0;
  }
  INFO("above in " << above << " of " << kSets);
  CHECK_FALSE(tests::is_rejected(above, kSets, 0.5, 0.01));
}

TEST_CASE("of noise alone nothing can shrink", "[slow]") {
  const auto clean = tests::make_gap_set({}, 3);
  for (const std::uint64_t seed : {1UL, 2UL}) {
    const FittedBaseline fitted(tests::add_noise(clean, seed));
    const Candidate cause = fit_effect(fitted, "bearing_warmup");
    const Gap gap = find(fitted, &cause);
    INFO("seed " << seed);
    CHECK_FALSE(gap.shrink_percent.has_value());
    CHECK_FALSE(gap.black_box_percent.has_value());
  }
}

TEST_CASE("of a curve that nothing explains the gap is its size, before and after recalibration", "[fast]") {
  auto set = tests::make_gap_set({}, 3);
  constexpr double kSize_Nm = 0.5;
  add_turns(kSize_Nm, set);
  const FittedBaseline fitted(tests::add_noise(set, 2));
  const Gap gap = find(fitted);
  const double expected = kSize_Nm / floor_of_torque(fitted.set) * std::sqrt(share_of_torque(fitted.set));
  CHECK(gap.as_calibrated.before == Approx(expected).epsilon(0.06));
  CHECK(gap.recalibrated.before == Approx(expected).epsilon(0.06));
  CHECK(std::abs(*gap.recalibration_percent) < 3.0);
  CHECK_FALSE(gap.shrink_percent.has_value());  // no cause
  CHECK(gap.recalibrated.after == gap.recalibrated.before);
  REQUIRE(gap.channels.size() == 3);
  CHECK(gap.channels[kTorque].channel == "drum_torque_Nm");
  CHECK(gap.channels[kTorque].unit == "N");
  CHECK(gap.channels[kTorque].before ==
        Approx(kSize_Nm / (fitted.set.source().rig->drum.diameter_m / 2.0)).epsilon(0.06));
  CHECK(gap.channels[1].unit == "degC");
  CHECK(gap.channels[1].before < 0.05);
  CHECK(gap.channels[2].unit == "kPa");
}

TEST_CASE("twice the curve is twice the gap", "[fast]") {
  const auto measure = [](double size_Nm) {
    auto set = tests::make_gap_set({}, 2);
    add_turns(size_Nm, set);
    return find(FittedBaseline(tests::add_noise(set, 2))).recalibrated.before;
  };
  CHECK(measure(2.0) == Approx(2.0 * measure(1.0)).epsilon(0.03));
}

TEST_CASE("an offset of the sensor is no gap", "[fast]") {
  auto set = tests::make_gap_set({}, 2);
  for (measurements::MeasuredRun& run : set.runs) {
    tests::add_to_channel(run, "drum_torque_Nm", [](double) { return 0.9; });
    tests::add_to_channel(run, "cavity_pressure_kPa", [](double) { return -400.0; });
  }
  const Gap gap = find(FittedBaseline(tests::add_noise(set, 3)));
  CHECK(gap.recalibrated.before < kNoiseAlone);
}

TEST_CASE("the true effect shrinks the gap by all of it, on runs that the fit did not see", "[fast]") {
  const FittedBaseline fitted(tests::add_noise(tests::make_gap_set(warming_bearings(), 4), 5));
  const Candidate cause = fit_effect(fitted, "bearing_warmup");
  const Gap gap = find(fitted, &cause);
  REQUIRE(gap.shrink_percent.has_value());
  CHECK(gap.recalibrated.after < kNoiseAlone);
  CHECK(*gap.shrink_percent == Approx(100.0 * (1.0 - gap.recalibrated.after / gap.recalibrated.before)));
  CHECK(gap.shrink_ci95_percent[0] <= *gap.shrink_percent);
  CHECK(gap.shrink_ci95_percent[1] >= *gap.shrink_percent);
  CHECK(gap.held_out == std::vector<std::string>{"run_1", "run_2", "run_3", "run_4"});
  CHECK(gap.as_calibrated.before > 1.0);
  CHECK(gap.as_calibrated.after < 0.1 * gap.as_calibrated.before);
  CHECK(gap.recalibrated.before < gap.as_calibrated.before);  // a part of it, recalibration hides
  REQUIRE(gap.black_box_percent.has_value());
  CHECK(*gap.black_box_percent < *gap.shrink_percent);
  CHECK(gap.channels[kTorque].after < 0.15 * gap.channels[kTorque].before);
  CHECK(gap.judged_by == diagnosis::JudgedBy::kRuns);
  CHECK(gap.judged_on.size() + gap.not_judged.size() == gap.held_out.size());
  REQUIRE(gap.left_out_nats.has_value());
  CHECK(*gap.left_out_nats > 10.0);
}

TEST_CASE(
    "what is left out is likelier with the true effect than with another, and no likelier with one that does not act",
    "[slow]") {
  const FittedBaseline fitted(tests::add_noise(tests::make_gap_set(warming_bearings(), 4), 5));
  const auto nats_of = [](const FittedBaseline& of, const char* id) {
    const Candidate cause = fit_effect(of, id);
    return find(of, &cause).left_out_nats.value();
  };
  CHECK(nats_of(fitted, "bearing_warmup") > nats_of(fitted, "torque_zero_drift") + 3.0);
  const FittedBaseline clean(tests::add_noise(tests::make_gap_set({}, 4), 5));
  CHECK(nats_of(clean, "bearing_warmup") < diagnosis::thresholds::kConfirmed_nats);
  CHECK_FALSE(find(clean).left_out_nats.has_value());
}

TEST_CASE("the true effect shrinks the gap in whatever way it is judged, and the energy that runs are off by",
          "[fast]") {
  const FittedBaseline fitted(tests::add_noise(tests::make_gap_set(warming_bearings(0.04), 4), 5));
  const Candidate cause = fit_effect(fitted, "bearing_warmup");
  const Gap gap = find(fitted, &cause);
  for (const auto& by : {gap.fitted, gap.stretches, gap.runs}) {
    REQUIRE(by.has_value());
    REQUIRE(by->percent.has_value());
    CHECK(*by->percent > 80.0);
    CHECK(by->ci95_percent[0] <= *by->percent);
    CHECK(by->ci95_percent[1] >= *by->percent);
    CHECK(by->ci95_percent[0] > 0.0);
    CHECK(by->gap.after < 0.2 * by->gap.before);
  }
  CHECK(*gap.shrink_percent == *gap.runs->percent);
  REQUIRE(gap.runs->energy_percent.has_value());
  CHECK(gap.runs->energy_percent->before > 0.2);
  CHECK(gap.runs->energy_percent->after < 0.3 * gap.runs->energy_percent->before);
  CHECK(gap.fitted->gap.before < gap.runs->gap.before);  // a fit hides a part from itself
}

/// Runs at 5.4 kN, and one at 3 kN.
measurements::MeasurementSet make_set_with_lone_load(const std::vector<models::ActiveEffect>& effects) {
  auto set = tests::make_gap_set(effects, 6);
  set.runs = {set.runs[0], set.runs[2], set.runs[3], set.runs[5]};
  return set;
}

TEST_CASE("a run that alone holds a load is no evidence against an effect of load", "[fast]") {
  // Without run_3 nothing says how large the exponent is: what is predicted of it is a guess.
  const models::Effect& effect = models::find_effect("load_exponent");
  std::vector<double> values;
  for (const models::EffectParameter& parameter : effect.info.parameters) values.push_back(parameter.prior.center());
  values.front() *= 1.5;  // more than retuning hides
  const FittedBaseline fitted(tests::add_noise(make_set_with_lone_load({tests::make_active(effect, values)}), 6));
  const Candidate cause = fit_effect(fitted, "load_exponent");
  const Gap gap = find(fitted, &cause);
  const auto lone = std::find_if(gap.not_judged.begin(), gap.not_judged.end(),
                                 [](const diagnosis::UnjudgedRun& at) { return at.run == "run_3"; });
  REQUIRE(lone != gap.not_judged.end());
  CHECK(std::count(lone->alone_in.begin(), lone->alone_in.end(), "load") == 1);
  CHECK(std::count(gap.judged_on.begin(), gap.judged_on.end(), "run_3") == 0);
  CHECK_FALSE((gap.shrink_percent.has_value() && *gap.shrink_percent < 0.0));
  CHECK(gap.fitted.value().gap.after < gap.fitted.value().gap.before);
}

TEST_CASE("of a large effect that is known, next to nothing is left in the middle of five campaigns", "[slow]") {
  const auto clean = tests::make_gap_set(warming_bearings(0.04), 4);
  std::vector<double> percents;
  for (const std::uint64_t seed : {1UL, 2UL, 3UL, 4UL, 5UL}) {
    const FittedBaseline fitted(tests::add_noise(clean, seed));
    const Candidate cause = fit_effect(fitted, "bearing_warmup");
    percents.push_back(find(fitted, &cause).shrink_percent.value());
  }
  std::sort(percents.begin(), percents.end());
  CHECK(percents[2] > 95.0);
  CHECK(percents[0] > 90.0);
}

TEST_CASE("a wrong effect shrinks it less", "[slow]") {
  const FittedBaseline fitted(tests::add_noise(tests::make_gap_set(warming_bearings(), 3), 5));
  const Candidate right = fit_effect(fitted, "bearing_warmup");
  const Candidate wrong = fit_effect(fitted, "slow_leak");
  const Gap by_right = find(fitted, &right);
  const Gap by_wrong = find(fitted, &wrong);
  REQUIRE(by_right.shrink_percent.has_value());
  CHECK(by_wrong.recalibrated.after > 0.8 * by_wrong.recalibrated.before);
  CHECK_FALSE((by_wrong.shrink_percent.has_value() && by_wrong.shrink_ci95_percent[0] > 0.0));
  CHECK(*by_right.shrink_percent > 80.0);
  CHECK(by_wrong.fitted.value().gap.before == by_right.fitted.value().gap.before);
}

/// Runs of which some have warm bearings.
measurements::MeasurementSet make_mixed_set(const std::vector<bool>& are_warming) {
  constexpr double kStrong_per_K = 0.05;
  auto mixed = tests::make_gap_set(warming_bearings(kStrong_per_K), are_warming.size());
  const auto cold = tests::make_gap_set({}, are_warming.size());
  for (std::size_t run = 0; run < are_warming.size(); ++run) {
    if (!are_warming[run]) mixed.runs[run] = cold.runs[run];
  }
  return tests::add_noise(mixed, 5);
}

TEST_CASE(
    "a cause that enlarges the gap of runs left out is not confirmed, and is not said to be worse where it may shrink "
    "it",
    "[slow]") {
  const FittedBaseline by_turns(make_mixed_set({false, true, false, true}));
  const Candidate wrong = fit_effect(by_turns, "bearing_warmup");
  const Gap worse = find(by_turns, &wrong);
  CHECK(worse.recalibrated.after > 1.1 * worse.recalibrated.before);
  REQUIRE(worse.shrink_percent.has_value());
  CHECK(*worse.shrink_percent < 0.0);
  CHECK(worse.shrink_ci95_percent[0] < 0.0);
  const FittedBaseline mostly(make_mixed_set({false, true, true, true}));
  const Candidate doubtful = fit_effect(mostly, "bearing_warmup");
  const Gap gap = find(mostly, &doubtful);
  REQUIRE(gap.shrink_ci95_percent[0] < 0.0);
  REQUIRE(gap.shrink_ci95_percent[1] > 0.0);
  CHECK_FALSE(gap.worse_where_certain);
}

TEST_CASE("a run is judged by fits that did not see it", "[fast]") {
  // The bearings of the second run are stiffer by 0.05 N s/m, which a fit that sees it takes for its base parameters.
  auto both = tests::make_gap_set({}, 2);
  const double radius_m = 0.5 * both.rig->drum.diameter_m;
  for (std::size_t row = 0; row < both.runs[1].time_s.size(); ++row) {
    both.runs[1].columns.at("drum_torque_Nm")[row] += 0.05 * radius_m * both.runs[1].columns.at("speed_km_h")[row];
  }
  both = tests::add_noise(both, 4);
  auto second = both;
  second.runs.erase(second.runs.begin());
  const double unseen = find(FittedBaseline(both)).channels[kTorque].before;
  const double seen = find(FittedBaseline(second)).channels[kTorque].before;
  INFO(unseen << " N unseen, " << seen << " N seen");
  CHECK(unseen > 3.0 * seen);
  CHECK(unseen > 0.2);
}

TEST_CASE("of one run no run can be left out: its stretches are", "[fast]") {
  const FittedBaseline fitted(tests::add_noise(tests::make_gap_set(warming_bearings(), 1), 5));
  const Candidate cause = fit_effect(fitted, "bearing_warmup");
  const Gap gap = find(fitted, &cause);
  CHECK(gap.held_out.empty());
  CHECK_FALSE(gap.black_box_percent.has_value());
  CHECK_FALSE(gap.runs.has_value());
  CHECK(gap.recalibrated.after < gap.recalibrated.before);
  CHECK(gap.fitted.value().gap.after < gap.fitted.value().gap.before);
}

TEST_CASE("where a fit without a run leads nowhere, nothing is said of what shrinks", "[fast]") {
  FittedBaseline fitted(tests::add_noise(tests::make_gap_set({}, 2), 5));
  const auto at = std::find_if(fitted.base.begin(), fitted.base.end(),
                               [](const auto& free) { return free.key == "tire.thermal.heat_capacity_J_per_K"; });
  REQUIRE(at != fitted.base.end());
  // One step from here: a heat capacity far below zero, which cannot be simulated.
  fitted.null.fit.residuals = 1e3 * fitted.null.fit.jacobian.col(at - fitted.base.begin());
  const Candidate cause = fitted.null;
  const Gap gap = find(fitted, &cause);
  CHECK(gap.held_out.empty());
  CHECK_FALSE(gap.shrink_percent.has_value());
  CHECK_FALSE(gap.recalibration_percent.has_value());
  CHECK_FALSE(gap.black_box_percent.has_value());
  CHECK(gap.recalibrated.before == gap.as_calibrated.before);
  CHECK(gap.recalibrated.after == gap.as_calibrated.before);
  CHECK(gap.channels.size() == 3);
}

TEST_CASE("a gap is the same to the bit from one thread or two", "[fast]") {
  FittedBaseline fitted(tests::add_noise(tests::make_gap_set(warming_bearings(), 3), 5));
  const Candidate cause = fit_effect(fitted, "bearing_warmup");
  fitted.settings.threads = 1;
  const Gap one = find(fitted, &cause);
  fitted.settings.threads = 2;
  const Gap two = find(fitted, &cause);
  CHECK(one.as_calibrated.before == two.as_calibrated.before);
  CHECK(one.recalibrated.before == two.recalibrated.before);
  CHECK(one.recalibrated.after == two.recalibrated.after);
  CHECK(one.shrink_percent == two.shrink_percent);
  CHECK(one.shrink_ci95_percent == two.shrink_ci95_percent);
  CHECK(one.black_box_percent == two.black_box_percent);
  REQUIRE((one.stretches.has_value() && two.stretches.has_value()));
  CHECK(one.stretches->gap.after == two.stretches->gap.after);
  CHECK(one.stretches->ci95_percent == two.stretches->ci95_percent);
}

TEST_CASE("no true effect of a campaign has a negative shrinkage", "[slow]") {
  for (const char* id : {"bearing_warmup", "slow_leak", "load_exponent", "torque_gain", "torque_zero_drift", "rim_heat",
                         "pressure_exponent", "surface_warming"}) {
    const models::Effect& effect = models::find_effect(id);
    std::vector<double> values;
    for (const models::EffectParameter& parameter : effect.info.parameters) values.push_back(parameter.prior.center());
    if (values.front() == 0.0) values.front() = effect.info.parameters.front().prior.high;
    const std::vector<models::ActiveEffect> acting{tests::make_active(effect, values)};
    for (const auto& clean : {tests::make_gap_set(acting, 3), make_set_with_lone_load(acting)}) {
      for (const std::uint64_t seed : {1UL, 2UL}) {
        const FittedBaseline fitted(tests::add_noise(clean, seed));
        const Candidate cause = fit_effect(fitted, id);
        const Gap gap = find(fitted, &cause);
        INFO(id << ", " << clean.runs.size() << " runs, seed " << seed << ": " << gap.shrink_percent.value_or(0.0)
                << " %, gap " << gap.recalibrated.before << " to " << gap.recalibrated.after);
        CHECK(gap.shrink_percent.value_or(0.0) >= 0.0);
        for (const auto& by : {gap.fitted, gap.stretches, gap.runs}) {
          CHECK((!by.has_value() || by->percent.value_or(0.0) >= 0.0));
        }
      }
    }
  }
}

TEST_CASE("the interval of a shrinkage holds what other measurements of the same give", "[slow]") {
  // 20 campaigns of the same truth: what a fit of the true effect shrinks on average lies within nearly all intervals.
  constexpr int kSets = 20;
  const auto clean = tests::make_gap_set(warming_bearings(), 4);
  std::vector<Gap> gaps;
  double mean = 0.0;
  for (int seed = 1; seed <= kSets; ++seed) {
    const FittedBaseline fitted(tests::add_noise(clean, static_cast<std::uint64_t>(100 + seed)));
    const Candidate cause = fit_effect(fitted, "bearing_warmup");
    gaps.push_back(find(fitted, &cause));
    REQUIRE(gaps.back().shrink_percent.has_value());
    mean += *gaps.back().shrink_percent / kSets;
  }
  int held = 0;
  for (const Gap& gap : gaps) {
    held += gap.shrink_ci95_percent[0] <= mean && mean <= gap.shrink_ci95_percent[1] ? 1 : 0;
  }
  INFO("mean shrinkage " << mean << " %, held by " << held << " of " << kSets);
  CHECK(mean > 90.0);
  CHECK_FALSE(tests::is_rejected(held, kSets, 0.95, 0.01));
}
