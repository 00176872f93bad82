// Sets measured on a dynamometer, diagnosed.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "diagnosis/checks/set_checks.h"
#include "diagnosis/comparison/base_parameters.h"
#include "diagnosis/diagnosis.h"
#include "diagnosis/kinds/measurement_kind.h"
#include "diagnosis/output/diagnosis_json.h"
#include "diagnosis/output/summary.h"
#include "sim/core/error.h"
#include "tests/diagnosis/answers.h"
#include "tests/diagnosis/driving_sets.h"
#include "tests/diagnosis/gap_sets.h"
#include "tests/support/drum_sets.h"
#include "tests/support/fit_study.h"
#include "tests/support/machines.h"

using namespace rollrig;
using diagnosis::diagnose;
using diagnosis::Diagnosis;
using diagnosis::kind_of;
using diagnosis::Verdict;
using tests::contains;
using tests::Ids;
using tests::make_dyno_set;
using tests::names;
using tests::only;

namespace {

/// Of the difference between the loss forces of two sets with the same runs.
double calc_rms_of_loss(const measurements::MeasurementSet& a, const measurements::MeasurementSet& b) {
  double squares = 0.0;
  double samples = 0.0;
  for (std::size_t r = 0; r < a.runs.size(); ++r) {
    const auto& of_a = a.runs[r].columns.at("loss_force_N");
    const auto& of_b = b.runs[r].columns.at("loss_force_N");
    for (std::size_t row = 0; row < of_a.size(); ++row) {
      if (std::isnan(of_a[row]) || std::isnan(of_b[row])) continue;
      squares += (of_a[row] - of_b[row]) * (of_a[row] - of_b[row]);
      samples += 1.0;
    }
  }
  return std::sqrt(squares / samples);
}

const Ids kOfDriving{"driveline_warming", "slip_loss", "slow_leak", "rim_heat"};

}  // namespace

TEST_CASE("a loss force may be off by more where it is larger, whatever its sign", "[fast]") {
  const measurements::MeasurementSet set = make_dyno_set({}, 1);
  const auto find_tolerance_N = [&](double force_N) { return kind_of(set).calc_force_tolerance(set, force_N); };
  CHECK(find_tolerance_N(0.0) > 0.0);
  CHECK(find_tolerance_N(400.0) > find_tolerance_N(100.0) + 50.0);
  CHECK(find_tolerance_N(-400.0) == find_tolerance_N(400.0));
}

TEST_CASE("a loss force counts from 20 km/h, a temperature at every speed, both where there is a sample", "[fast]") {
  measurements::MeasurementSet set = make_dyno_set({}, 1);
  measurements::MeasuredRun& run = set.runs.front();
  const std::size_t lost = run.time_s.size() / 2;
  run.columns.at("liner_temperature_degC")[lost] = std::nan("");
  const auto find_rows = [&](const Quantity& channel) { return kind_of(set).find_compared_rows(run, channel); };
  const std::vector<double>& speed_m_s = run.columns.at("speed_km_h");
  const std::vector<double>& loss_N = run.columns.at("loss_force_N");
  for (double& loss : run.columns.at("loss_force_N")) loss = std::isnan(loss) ? 3.0 : loss;  // below 20 km/h as well
  std::size_t slow = 0;
  for (const std::size_t row : find_rows(models::quantities::kLossForce)) {
    CHECK(speed_m_s[row] >= 20.0 / 3.6);
    CHECK_FALSE(std::isnan(loss_N[row]));
  }
  for (const std::size_t row : find_rows(models::quantities::kLinerTemperature)) {
    CHECK(row != lost);
    slow += speed_m_s[row] < 20.0 / 3.6 ? 1 : 0;
  }
  CHECK(slow > 0);
}

TEST_CASE("on a dynamometer noise alone is no gap", "[slow]") {
  const Diagnosis found = diagnosis::diagnose(tests::add_noise(make_dyno_set({}, 2), 3), only(kOfDriving));
  INFO(diagnosis::format_summary(found));
  CHECK(found.verdict == Verdict::kNoGap);
  CHECK(found.warnings.empty());
  CHECK(found.balance.empty());
}

TEST_CASE("a driveline that warms is named on a dynamometer, with its place and its equation", "[slow]") {
  const auto set = tests::add_noise(make_dyno_set({tests::make_effect_at("driveline_warming", 0.8)}, 3), 4);
  const Diagnosis found = diagnose(set, only(kOfDriving));
  INFO(diagnosis::format_summary(found));
  CHECK(names(found, "driveline_warming"));
  REQUIRE_FALSE(found.where.empty());
  CHECK(found.where.front().channel == "loss_force_N");
  CHECK(found.where.front().unit == "N");
  REQUIRE_FALSE(found.balance.empty());
  CHECK(found.balance.front().name == "loss force");
  REQUIRE(found.gap.shrink_percent.has_value());
  CHECK(*found.gap.shrink_percent > 70.0);
  const auto json = diagnosis::make_diagnosis_json(found);
  CHECK(json["format"] == "rollrig-diagnosis/1");
}

TEST_CASE("slip is named where a wheel drives and brakes", "[slow]") {
  const auto set = tests::add_noise(make_dyno_set({tests::make_effect_at("slip_loss", 0.5)}, 2), 5);
  const Diagnosis found = diagnose(set, only(kOfDriving));
  INFO(diagnosis::format_summary(found));
  CHECK(names(found, "slip_loss"));
  REQUIRE_FALSE(found.balance.empty());
  CHECK(found.balance.front().name == "slip");
}

TEST_CASE("on a dynamometer a base parameter off by twice its uncertainty is made up for by what the fit moves",
          "[fast]") {
  const measurements::MeasurementSet nominal = make_dyno_set({}, 3);
  const models::Context<double> context = measurements::make_context(nominal);
  const auto base = diagnosis::find_base_parameters(nominal, context);
  const auto a0 =
      std::find_if(base.begin(), base.end(), [](const auto& one) { return one.key == "tire.rolling_resistance.A0_N"; });
  REQUIRE(a0 != base.end());
  measurements::MeasurementSet off = nominal;
  off.sensors.at("loss_force_N").offset_sd = 0.1;  // else it makes up for the most of it
  tests::measure_again(off, {}, [&](models::Context<double>& moved) {
    estimation::find_parameter(moved, a0->key) += 2.0 * a0->prior_sd_SI;
  });
  const tests::FittedBaseline recalibrated(tests::add_noise(off, 6));
  measurements::MeasurementSet fitted = nominal;
  tests::measure_again(fitted, {}, [&](models::Context<double>& moved) {
    for (std::size_t i = 0; i < base.size(); ++i) {
      const double unknown = recalibrated.null.fit.unknowns[static_cast<Eigen::Index>(i)];
      estimation::find_parameter(moved, base[i].key) += base[i].prior_sd_SI * unknown;
    }
  });
  CHECK(calc_rms_of_loss(fitted, off) < 0.15 * calc_rms_of_loss(nominal, off));
}

TEST_CASE("against a constant coefficient the tire's temperature is named on a dynamometer", "[slow]") {
  const auto baseline = models::Baseline::kConstantRrc;
  const auto set = tests::add_noise(make_dyno_set({tests::make_effect_at("tire_temperature", 0.5)}, 2, baseline), 8);
  const Diagnosis found = diagnose(set, only({"tire_temperature", "driveline_warming", "slip_loss"}));
  INFO(diagnosis::format_summary(found));
  CHECK(names(found, "tire_temperature"));
}

TEST_CASE("against the combined model the tire's temperature is not in the comparison", "[fast]") {
  const auto set = tests::add_noise(make_dyno_set({}, 1), 8);
  CHECK(diagnose(set, only({"tire_temperature", "slow_leak"})).probability.count("tire_temperature") == 0);
}

TEST_CASE("columns and units of a dynamometer's set that cannot be are named", "[fast]") {
  measurements::MeasurementSet set = tests::add_noise(make_dyno_set({}, 1), 9);
  SECTION("speed in m/s") {
    for (double& speed : set.runs[0].columns.at("speed_km_h")) speed /= 3.6;
    const auto checks = diagnosis::check_set(set);
    CHECK(checks.is_implausible());
    CHECK_THAT(checks.warnings.back(), Catch::Contains("speed_km_h holds m/s"));
  }
  SECTION("loss of the other sign") {
    for (double& loss : set.runs[0].columns.at("loss_force_N")) loss = -loss;
    const auto checks = diagnosis::check_set(set);
    CHECK(checks.is_implausible());
    CHECK_THAT(checks.warnings.back(), Catch::Contains("loss_force_N has the other sign"));
  }
}

TEST_CASE("each effect that a dynamometer shows is named at a middling size", "[weekly]") {
  measurements::MeasurementSet campaign = make_dyno_set({}, 3);
  for (measurements::MeasuredRun& run : campaign.runs) run = tests::thin_out(run, 4);
  int named = 0;
  int shown = 0;
  for (const models::Effect* effect : models::all_effects()) {
    const models::EffectInfo& info = effect->info;
    const auto dyno = tests::kDyno;
    const bool faint = info.faint_on(dyno->traits);
    if (!models::acts_in(info, dyno->traits, models::default_tire_model()) || faint) continue;
    measurements::MeasurementSet set = campaign;
    tests::measure_again(set, {tests::make_effect_at(info.id, 0.7)});
    const Diagnosis found = diagnosis::diagnose(tests::add_noise(set, 7), {});
    UNSCOPED_INFO(info.id << "\n" << diagnosis::format_summary(found));
    const bool hidden = found.verdict == Verdict::kNoGap && contains(found.not_excluded, info.id);
    shown += hidden ? 0 : 1;
    const bool is_trace = found.trace.has_value() && contains(found.trace->effects, info.id);  // too small to matter
    named += names(found, info.id) || is_trace ? 1 : 0;
  }
  CHECK(named == shown);
  CHECK(shown >= 12);
}

TEST_CASE("in four dynamometer runs of one to two hours the cause is named among all effects", "[slow]") {
  const auto set = tests::add_noise(
      make_dyno_set({tests::make_effect_at("driveline_warming", 0.7)}, 4, models::Baseline::kCombined, 90.0), 4);
  double hours = 0.0;
  for (const auto& run : set.runs) hours += run.time_s.back() / 3600.0;
  CHECK(hours > 5.0);
  CHECK(names(diagnosis::diagnose(set, {}), "driveline_warming"));
}
