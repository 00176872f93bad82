// Runs simulated again from recorded inputs: on a drum and on a dynamometer.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "measurements/resimulation.h"
#include "tests/diagnosis/driving_sets.h"
#include "tests/measurements/recorded_drive.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/drum_sets.h"
#include "tests/support/machines.h"

using namespace rollrig;
using measurements::MeasuredRun;
using measurements::MeasurementSet;
using models::ActiveEffect;
using tests::driving_program;
using tests::record;
using tests::thin_out;

namespace {

sim::Recording<double> resimulate(const MeasurementSet& set, const MeasuredRun& run,
                                  const std::vector<ActiveEffect>& effects) {
  models::Corner<double> corner(measurements::make_context(set), effects);
  return measurements::Resimulation(run, *set.kind).simulate(set, run, corner);
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b, std::size_t skip = 0) {
  REQUIRE(a.size() == b.size());
  double largest = 0.0;
  for (std::size_t i = skip; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

}  // namespace

TEST_CASE("a dynamometer run is what the simulator's vehicle shows on its rollers", "[fast]") {
  tests::VehicleFixture fixture("dyno_1m2");
  for (const char* id : {"", "driveline_warming", "rim_heat", "tie_down_load", "tread_liner_lag"}) {
    INFO(id);
    fixture.effects.clear();
    if (*id != '\0') fixture.effects = {tests::make_effect_at(id, 0.5)};
    const sim::Recording<double> simulated = fixture.run_quasi_static(driving_program());
    const MeasuredRun run = record(fixture, simulated);
    MeasurementSet set;
    set.kind = tests::kDyno;
    set.tire = fixture.tire;
    set.rig = fixture.rig;
    const sim::Recording<double> resimulated = resimulate(set, run, fixture.effects);
    // Next to standstill forces fade within less than a second.
    CHECK(largest_difference(resimulated.channel("loss_force_N"), simulated.channel("loss_force_N"), 3) < 0.3);
    CHECK(largest_difference(resimulated.channel("liner_temperature_degC"),
                             simulated.channel("liner_temperature_degC")) < 0.02);
    CHECK(largest_difference(resimulated.channel("cavity_pressure_kPa"), simulated.channel("cavity_pressure_kPa")) <
          15.0);
  }
}

TEST_CASE("drive and brake force cost slip, by their square, and no more", "[fast]") {
  MeasurementSet set = tests::make_dyno_set({}, 1);
  MeasuredRun run = set.runs.front();
  const std::vector<double>& speed_m_s = run.columns.at("speed_km_h");
  std::vector<double>& force_N = run.columns.at("longitudinal_force_N");
  const double compliance_per_N = 1.0 / 100e3;
  const ActiveEffect slip = tests::make_active(models::find_effect("slip_loss"), {0.01});
  const std::vector<double> baseline = resimulate(set, run, {}).channel("loss_force_N");
  for (const double held_N : {800.0, -800.0}) {
    std::fill(force_N.begin(), force_N.end(), held_N);
    const std::vector<double> loss_N = resimulate(set, run, {slip}).channel("loss_force_N");
    // At the start the tire is as cold with slip as without.
    std::size_t row = 0;
    while (speed_m_s[row] < 5.0) ++row;
    CHECK(loss_N[row] - baseline[row] == Approx(held_N * held_N * compliance_per_N).epsilon(0.02));
    CHECK(loss_N.back() < baseline.back() + held_N * held_N * compliance_per_N);  // its heat makes the tire roll easier
  }
}

TEST_CASE("no effect makes a resimulation unstable, wherever a fit usually looks", "[fast]") {
  MeasurementSet set = tests::make_dyno_set({}, 1);
  MeasuredRun run = thin_out(set.runs.front(), 2);
  const std::vector<double>& speed_m_s = run.columns.at("speed_km_h");
  std::vector<double>& force_N = run.columns.at("longitudinal_force_N");
  for (std::size_t row = 0; row + 1 < force_N.size(); ++row) {
    force_N[row] = 450.0 * (speed_m_s[row + 1] - speed_m_s[row]) / (run.time_s[row + 1] - run.time_s[row]);
    if (row % 50 < 4) force_N[row] = -3000.0;  // hard braking
  }
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> within(-2.0, 2.0);  // prior units
  for (const models::Effect* effect : models::all_effects()) {
    if (!models::acts_in(effect->info, tests::kDyno->traits, models::default_tire_model())) continue;
    for (int draw = 0; draw < 25; ++draw) {
      std::vector<double> values;
      for (const models::EffectParameter& parameter : effect->info.parameters) {
        const models::Prior& prior = parameter.prior;
        const bool is_log = prior.scale == models::Prior::Scale::kLog;
        const double low = is_log ? std::log(prior.low) : prior.low;
        const double high = is_log ? std::log(prior.high) : prior.high;
        const double drawn = 0.5 * (low + high) + 0.5 * (high - low) * within(generator);
        const double value = is_log ? std::exp(drawn) : drawn;
        values.push_back(std::clamp(value, parameter.range.lower, parameter.range.upper));
      }
      INFO(effect->info.id << " at " << fmt::format("{}", fmt::join(values, ", ")));
      const sim::Recording<double> resimulated = resimulate(set, run, {tests::make_active(*effect, values)});
      const auto largest = [&](const char* channel) {
        double most = 0.0;
        for (const double value : resimulated.channel(channel))
          most = std::isfinite(value) ? std::max(most, std::abs(value)) : 1e99;
        return most;
      };
      CHECK(largest("loss_force_N") < 5000.0);
      CHECK(largest("liner_temperature_degC") < 1000.0);
      CHECK(largest("cavity_pressure_kPa") < 3e6);
    }
  }
}

TEST_CASE("what is recorded every other second gives nearly the same", "[fast]") {
  const MeasurementSet set = tests::make_dyno_set({}, 1);
  const MeasuredRun thin = thin_out(set.runs.front(), 2);
  const std::vector<double> every = resimulate(set, set.runs.front(), {}).channel("liner_temperature_degC");
  const std::vector<double> other = resimulate(set, thin, {}).channel("liner_temperature_degC");
  double largest = 0.0;
  for (std::size_t i = 0; i < other.size(); ++i) largest = std::max(largest, std::abs(other[i] - every[2 * i]));
  CHECK(largest < 0.1);
}

TEST_CASE("rows far apart are simulated in parts, so that a steady run does not depend on them", "[fast]") {
  MeasurementSet set = tests::make_dyno_set({}, 1);
  MeasuredRun& run = set.runs.front();
  std::fill(run.columns.at("speed_km_h").begin(), run.columns.at("speed_km_h").end(), 25.0);
  const std::vector<double> fine = resimulate(set, run, {}).channel("liner_temperature_degC");
  const std::vector<double> coarse = resimulate(set, thin_out(run, 10), {}).channel("liner_temperature_degC");
  for (std::size_t i = 2; i < coarse.size(); ++i) CHECK(coarse[i] == Approx(fine[10 * i]).margin(0.01));
}

TEST_CASE("on a drum, steps are short enough for what sensors show, with each effect as well", "[fast]") {
  const MeasurementSet set =
      tests::simulate_campaign({tests::combined_tire_path(), {{"transient_skim", {"repeats=1"}}}, {}});
  const MeasuredRun& smooth = set.runs.front();
  MeasuredRun kinked = smooth;  // rows not in a straight line are segments of their own: no step is longer than a row
  std::vector<double>& ambient_degC = kinked.columns.at("ambient_degC");
  for (std::size_t row = 0; row < ambient_degC.size(); row += 2) ambient_degC[row] += 1e-4;
  std::vector<std::vector<ActiveEffect>> cases{{}};
  for (const models::Effect* effect : models::all_effects()) {
    for (const double between : {0.0, 1.0}) cases.push_back({tests::make_effect_at(effect->info.id, between)});
  }
  for (const std::vector<ActiveEffect>& effects : cases) {
    INFO((effects.empty() ? "no effect" : effects.front().effect->info.id));
    const sim::Recording<double> usual = resimulate(set, smooth, effects);
    const sim::Recording<double> fine = resimulate(set, kinked, effects);
    const auto differ_by = [&](const char* channel) {
      return largest_difference(usual.channel(channel), fine.channel(channel));
    };
    CHECK(differ_by("drum_torque_Nm") < 0.02);          // less than a tenth of the noise of a row, 0.25 N m
    CHECK(differ_by("liner_temperature_degC") < 0.01);  // a tenth of the resolution, 0.1 K
    CHECK(differ_by("cavity_pressure_kPa") < 10.0);     // in Pa: a tenth of the resolution, 0.1 kPa
  }
}

TEST_CASE("derivatives of a run agree with differences", "[fast]") {
  const MeasurementSet set = tests::make_dyno_set({}, 1);
  const MeasuredRun& run = set.runs.front();
  const models::Context<double> context = rigs::make_context(set.tire, *set.rig, set.baseline);
  models::Context<Jet> moved = models::convert_context<Jet>(context);
  moved.tire.thermal.rest_conductance_W_per_K = Jet(context.tire.thermal.rest_conductance_W_per_K, 0);
  models::Corner<Jet> corner(moved, {});
  const measurements::Resimulation resimulation(run, *set.kind);
  const auto derived = resimulation.simulate(set, run, corner);
  const auto at = [&](double z_W_per_K) {
    models::Context<double> other = context;
    other.tire.thermal.rest_conductance_W_per_K = z_W_per_K;
    models::Corner<double> at_other(other, {});
    return resimulation.simulate(set, run, at_other).channel("loss_force_N");
  };
  const double step = 0.01;
  const std::size_t row = run.time_s.size() - 10;
  const double z = context.tire.thermal.rest_conductance_W_per_K;
  const double difference = (at(z + step)[row] - at(z - step)[row]) / (2.0 * step);
  CHECK(derived.channel("loss_force_N")[row].v[0] == Approx(difference).epsilon(1e-5));
}

TEST_CASE("a resimulated run shows trace effects the recorded load and ambient", "[fast]") {
  tests::Campaign campaign = tests::make_short_campaign();
  measurements::MeasurementSet set = tests::simulate_campaign(campaign);
  measurements::MeasuredRun run = set.runs.front();
  std::vector<double>& ambient_K = run.columns.at("ambient_degC");
  for (std::size_t row = 0; row < ambient_K.size(); ++row) ambient_K[row] += 0.002 * run.time_s[row];
  const models::Effect& effect = models::find_effect("torque_zero_drift");
  const auto torque_with = [&](double ambient_min_per_K) {
    models::ActiveEffect drift = tests::make_effect_at("torque_zero_drift", 0.5);
    drift.parameters[2] = ambient_min_per_K * 60.0;
    models::Corner<double> corner(rigs::make_context(set.tire, *set.rig, set.baseline), {drift});
    return measurements::Resimulation(run, *set.kind).simulate(set, run, corner).channel("drum_torque_Nm");
  };
  REQUIRE(std::string(effect.info.parameters[2].key) == "ambient_min_per_K");
  const std::vector<double> without = torque_with(0.0);
  const std::vector<double> with = torque_with(5.0);
  CHECK(with.front() == Approx(without.front()).margin(1e-3));
  CHECK(with.back() - without.back() > 0.01);  // the air is warmer than at the start, and the drift positive
}
