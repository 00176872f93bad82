// Whole diagnoses, of small sets by the simulator and by the independent generator.
#include "diagnosis/diagnosis.h"
#include "diagnosis/comparison/model_comparison.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "diagnosis/comparison/prepared_set.h"
#include "diagnosis/output/diagnosis_json.h"
#include "sim/core/error.h"
#include "tests/diagnosis/answers.h"
#include "tests/diagnosis/gap_sets.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/fit_study.h"
#include "tests/validation/generator/generated_set.h"

using namespace rollrig;
using diagnosis::Cause;
using diagnosis::diagnose;
using diagnosis::Diagnosis;
using diagnosis::DiagnosisOptions;
using diagnosis::Verdict;
using tests::contains;
using tests::Ids;
using tests::names;
using tests::only;

namespace {

/// Effects that the small diagnoses choose from.
const Ids kOfBearings{"bearing_warmup", "slow_leak", "load_exponent"};

/// Bearings that warm in two runs, and noise.
const measurements::MeasurementSet& warm_bearings() {
  static const auto set = tests::add_noise(
      tests::make_gap_set({tests::make_active(models::find_effect("bearing_warmup"), {0.02, 20.0, 15.0, 1.0})}, 2), 1);
  return set;
}

std::string text_of(const Diagnosis& diagnosis) { return diagnosis::make_diagnosis_json(diagnosis).dump(); }

/// Properties that a diagnosis has whatever the set.
void check_sound(const Diagnosis& diagnosis) {
  for (const auto& [name, probability] : diagnosis.probability) {
    INFO(name);
    CHECK(probability >= 0.0);
    CHECK(probability <= 1.0 + 1e-9);
  }
  CHECK(diagnosis.probability.count("none") == 1);
  CHECK(diagnosis.probability.count("unknown") == 1);
  for (const Cause& cause : diagnosis.causes) {
    CHECK(cause.adequate == cause.objections.empty());
    for (const auto& parameter : cause.parameters) {
      CHECK(parameter.low_95 <= parameter.value);
      CHECK(parameter.value <= parameter.high_95);
    }
  }
  for (const diagnosis::GapView& view : {diagnosis.gap.as_calibrated, diagnosis.gap.recalibrated}) {
    CHECK(view.before >= 0.0);
    CHECK(view.after >= 0.0);
  }
  if (diagnosis.verdict == Verdict::kNoGap) CHECK_FALSE(diagnosis.gap.shrink_percent.has_value());
}

}  // namespace

TEST_CASE("bearings that warm are named, with their size, and the gap shrinks", "[slow]") {
  const Diagnosis found = diagnose(warm_bearings(), only(kOfBearings));
  INFO(text_of(found));
  check_sound(found);
  CHECK(found.verdict == Verdict::kExplained);
  REQUIRE_FALSE(found.causes.empty());
  CHECK(found.causes.front().effects == Ids{"bearing_warmup"});
  CHECK(found.probability.at("bearing_warmup") > 0.9);
  const auto& size = found.causes.front().parameters.front();
  CHECK(size.name == "bearing_warmup.fall_per_K");
  CHECK(size.unit == "1/K");
  CHECK(std::abs(size.value - 0.02) < 4.0 * size.sd);
  REQUIRE(found.gap.shrink_percent.has_value());
  CHECK(*found.gap.shrink_percent > 80.0);
  REQUIRE_FALSE(found.where.empty());
  CHECK(found.where.front().channel == "drum_torque_Nm");
  CHECK(found.warnings.empty());
}

TEST_CASE("the curves of the fits lie nearer to the measurement, with the cause nearest", "[slow]") {
  const Diagnosis found = diagnose(warm_bearings(), only(kOfBearings));
  const diagnosis::PreparedSet set(warm_bearings());
  REQUIRE(found.fitted.recalibrated.size() == set.residual_count());
  REQUIRE(found.fitted.with_cause.size() == set.residual_count());
  const auto mean_square = [&set](const std::vector<double>& fitted) {
    double sum = 0.0;
    for (const diagnosis::Series& series : set.series()) {
      for (std::size_t k = 0; k < series.size(); ++k) {
        const double left = (series.measured[k] - fitted[series.first_residual + k]) / series.floor;
        sum += left * left;
      }
    }
    return sum / static_cast<double>(set.residual_count());
  };
  // In noise floors, so that noise alone leaves about 1; the drift of a sensor may double it.
  CHECK(mean_square(found.fitted.with_cause) < 2.0);
  CHECK(mean_square(found.fitted.recalibrated) > 1.5 * mean_square(found.fitted.with_cause));
  const Diagnosis without = diagnose(tests::add_noise(tests::make_gap_set({}, 2), 6), only(kOfBearings));
  CHECK(without.fitted.with_cause.empty());
}

TEST_CASE("the same answer from one thread or two, and from runs listed in another order", "[slow]") {
  const std::string one = text_of(diagnose(warm_bearings(), only({"bearing_warmup", "slow_leak"}, 1)));
  CHECK(one == text_of(diagnose(warm_bearings(), only({"bearing_warmup", "slow_leak"}, 2))));
  measurements::MeasurementSet other = warm_bearings();
  std::reverse(other.runs.begin(), other.runs.end());
  CHECK(one == text_of(diagnose(other, only({"bearing_warmup", "slow_leak"}, 1))));
}

TEST_CASE("noise alone has no gap and no cause", "[slow]") {
  const Diagnosis found = diagnose(tests::add_noise(tests::make_gap_set({}, 2), 6), only(kOfBearings));
  INFO(text_of(found));
  check_sound(found);
  CHECK(found.verdict == Verdict::kNoGap);
  // What is not there loses against what it had before the measurement, and none gains.
  const diagnosis::ComparisonPriors before;
  for (const auto& [hypothesis, probability] : found.probability) {
    INFO(hypothesis);
    if (hypothesis == "none") {
      CHECK(probability > before.none);
    } else if (hypothesis == "unknown") {
      CHECK(probability < before.unknown + before.look_alike);
    } else {
      CHECK(probability < (before.singles + before.pairs) / static_cast<double>(kOfBearings.size()));
    }
  }
}

TEST_CASE("three clear effects at once are named together", "[slow]") {
  const std::vector<models::ActiveEffect> three{
      tests::make_active(models::find_effect("bearing_warmup"), {0.03, 20.0, 15.0, 1.0}),
      tests::make_active(models::find_effect("load_exponent"), {1.1}),
      tests::make_active(models::find_effect("slow_leak"), {9.0 * 1e3 / 3600.0})};
  const Diagnosis found = diagnose(tests::add_noise(tests::make_gap_set(three, 2), 3),
                                   only({"bearing_warmup", "slow_leak", "load_exponent"}));
  INFO(text_of(found));
  check_sound(found);
  CHECK(found.verdict == Verdict::kExplained);
  REQUIRE_FALSE(found.causes.empty());
  CHECK(found.causes.front().effects.size() == 3);
}

TEST_CASE("effects that are left out have no probability", "[slow]") {
  DiagnosisOptions options = only(kOfBearings);
  options.without = {"bearing_warmup"};
  const Diagnosis found = diagnose(warm_bearings(), options);
  INFO(text_of(found));
  check_sound(found);
  CHECK(found.probability.size() == 4);  // two effects, none, unknown
  CHECK(found.probability.count("bearing_warmup") == 0);
  CHECK_FALSE(names(found, "bearing_warmup"));
  CHECK(found.verdict == Verdict::kUnexplained);  // of what is left, none fits
}

TEST_CASE("an effect that does not exist is refused, wherever it is named", "[fast]") {
  DiagnosisOptions options;
  options.only = {"bearing_warmpu"};
  CHECK_THROWS_AS(diagnose(warm_bearings(), options), InputError);
  CHECK_THROWS_WITH(diagnose(warm_bearings(), options), Catch::Contains("bearing_warmup"));
  options = {};
  options.without = {"nothing"};
  CHECK_THROWS_AS(diagnose(warm_bearings(), options), InputError);
  CHECK_THROWS_WITH(diagnose(warm_bearings(), only({"brake_heat"})), Catch::Contains("brake_heat"));  // not on a drum
}

TEST_CASE("a set that cannot be what it says has no cause", "[slow]") {
  measurements::MeasurementSet set = warm_bearings();
  for (measurements::MeasuredRun& run : set.runs) {
    for (double& torque : run.columns.at("drum_torque_Nm")) torque *= 3.6;
  }
  const Diagnosis found = diagnose(set, only({"bearing_warmup"}));
  INFO(text_of(found));
  CHECK(found.verdict == Verdict::kUnexplained);
  CHECK(found.causes.empty());
  CHECK(found.probability.at("unknown") == 1.0);
  CHECK_FALSE(found.warnings.empty());
}

TEST_CASE("progress rises from nothing to all of it", "[fast]") {
  std::vector<double> done;
  DiagnosisOptions options = only({"bearing_warmup"});
  options.progress = [&done](double share, const std::string& stage) {
    CHECK_FALSE(stage.empty());
    done.push_back(share);
  };
  diagnose(warm_bearings(), options);
  REQUIRE(done.size() > 3);
  CHECK(std::is_sorted(done.begin(), done.end()));
  CHECK(done.front() == 0.0);
  CHECK(done.back() == 1.0);
}

TEST_CASE("causes of the independent generator are named, out of the whole catalog", "[slow]") {
  struct Hidden {
    const char* effect;
    const char* size;
  };
  // Large sizes of priors, so that the sets show them beyond doubt.
  for (const Hidden& hidden : {Hidden{"bearing_warmup", "0.02"}, Hidden{"slow_leak", "3"},
                               Hidden{"load_exponent", "1.12"}, Hidden{"clock_shift", "6"}}) {
    const tests::GeneratedSet made =
        tests::make_generated_set(std::string("--effect ") + hidden.effect + " --size " + hidden.size + " --seed 31");
    const Diagnosis found = diagnose(made.set, {});
    INFO(hidden.effect << "\n" << text_of(found));
    check_sound(found);
    CHECK(found.verdict != Verdict::kNoGap);
    CHECK(names(found, hidden.effect));
    REQUIRE_FALSE(found.causes.empty());
    CHECK(found.causes.front().effects.size() + found.causes.front().indistinguishable_from.size() <= 3);
  }
}

TEST_CASE("a strong effect is fitted where the baseline's fit has gone too far to start from", "[slow]") {
  // The baseline makes up for this rim with gas that no rim can be added to.
  const tests::GeneratedSet made = tests::make_generated_set("--effect rim_heat --seed 1683349374382471792");
  const Diagnosis found = diagnose(made.set, only({"rim_heat"}));
  INFO(text_of(found));
  CHECK(found.verdict == Verdict::kExplained);
  CHECK(names(found, "rim_heat"));
  CHECK(found.gap.recalibrated.after < 0.1 * found.gap.recalibrated.before);
}

TEST_CASE("sets of the independent generator without effect have no gap", "[slow]") {
  for (const char* seed : {"41", "42", "43"}) {
    const tests::GeneratedSet made = tests::make_generated_set(std::string("--effect none --seed ") + seed);
    const Diagnosis found = diagnose(made.set, {});
    INFO("seed " << seed << "\n" << text_of(found));
    check_sound(found);
    CHECK(found.verdict == Verdict::kNoGap);
  }
}

TEST_CASE("of a set by the independent generator the same answer from one thread or two, and in another order",
          "[weekly]") {
  const measurements::MeasurementSet set =
      tests::make_generated_set("--effect rim_heat,slow_leak --seed 33 --runs 4").set;
  DiagnosisOptions options;
  options.threads = 1;
  const std::string one = text_of(diagnose(set, options));
  options.threads = 2;
  CHECK(one == text_of(diagnose(set, options)));
  measurements::MeasurementSet other = set;
  std::reverse(other.runs.begin(), other.runs.end());
  CHECK(one == text_of(diagnose(other, options)));
}

TEST_CASE("one run that stands apart does not hide what the others show", "[slow]") {
  auto set = tests::add_noise(
      tests::make_gap_set({tests::make_active(models::find_effect("bearing_warmup"), {0.02, 20.0, 15.0, 1.0})}, 4), 1);
  CHECK_FALSE(diagnose(set, only(kOfBearings)).without_run.has_value());
  std::vector<double>& torque_Nm = set.runs[2].columns.at("drum_torque_Nm");
  for (std::size_t row = torque_Nm.size() / 3; row < torque_Nm.size() / 2; ++row) torque_Nm[row] += 12.0;
  const Diagnosis found = diagnose(set, only(kOfBearings));
  CHECK(found.verdict == Verdict::kUnexplained);
  REQUIRE(found.without_run.has_value());
  CHECK(found.without_run->run == set.runs[2].id);
  CHECK(found.without_run->share_percent > 50.0);
  CHECK(found.without_run->verdict == Verdict::kExplained);
  CHECK(found.without_run->effects == Ids{"bearing_warmup"});
  CHECK(found.without_run->probability > 0.5);
}
