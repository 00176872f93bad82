// Runs on the road simulated again from recorded inputs.
#include <catch2/catch.hpp>
#include <cmath>

#include "measurements/resimulation.h"
#include "models/vehicle/vehicle.h"
#include "tests/diagnosis/driving_sets.h"
#include "tests/measurements/recorded_drive.h"
#include "tests/support/hand_fed_corner.h"
#include "tests/support/machines.h"

using namespace rollrig;
using measurements::MeasuredRun;
using measurements::MeasurementSet;
using models::ActiveEffect;
using tests::driving_program;
using tests::record;

namespace {

/// A run on the road at one speed and slope.
MeasuredRun steady_run(double km_h, double slope, double acceleration_m_s2 = 0.0, int seconds = 60) {
  MeasuredRun run;
  run.id = "steady";
  run.initial_tire_temperature_K = 293.15;
  run.cold_pressure_Pa = 250e3;
  double way_m = 0.0;
  for (int i = 0; i < seconds; ++i) {
    const double speed_m_s = km_h / 3.6 + acceleration_m_s2 * i;
    run.time_s.push_back(i);
    run.columns["speed_km_h"].push_back(speed_m_s);
    run.columns["elevation_m"].push_back(slope * way_m);
    run.columns["ambient_degC"].push_back(293.15);
    way_m += speed_m_s + 0.5 * acceleration_m_s2;
  }
  return run;
}

double traction_N(const MeasurementSet& set, const MeasuredRun& run, const std::vector<ActiveEffect>& effects = {},
                  std::size_t row = 30) {
  models::Context<double> context;
  context.machine = tests::kRoad->traits;
  context.vehicle = set.vehicle->body;
  context.tire = set.tire.parameters_with_class_values(5000.0, 250e3);
  if (set.baseline == models::Baseline::kCombined) context.tire.own = set.tire.values.own;
  models::Corner<double> corner(context, effects);
  return measurements::Resimulation(run, *set.kind).simulate(set, run, corner).channel("traction_force_N")[row];
}

}  // namespace

TEST_CASE("on the road the traction force is the sum of its four parts", "[fast]") {
  const MeasurementSet set = tests::make_road_set({}, 1);
  const rigs::VehicleBody& body = set.vehicle->body;
  const double weight_N = body.mass_kg * kStandardGravity_m_s2;
  const double rolling_N = set.tire.values.constant.rrc * weight_N;
  const double drag_N = 0.5 * kStandardAtmosphere_Pa / (287.05 * 293.15) * body.drag_area_m2 * std::pow(90.0 / 3.6, 2);
  const double level_N = traction_N(set, steady_run(90.0, 0.0));
  CHECK(level_N == Approx(rolling_N + drag_N));
  CHECK(traction_N(set, steady_run(90.0, 0.02)) - level_N == Approx(0.02 * weight_N).epsilon(1e-3));
  const double faster_N = traction_N(set, steady_run(90.0 - 3.6 * 15.0, 0.0, 0.5));
  CHECK(faster_N - level_N == Approx(0.5 * (body.mass_kg + body.rotating_mass_kg)).epsilon(1e-3));
}

TEST_CASE("a drive right after another starts as warm as steady driving makes the tire", "[fast]") {
  const MeasurementSet set = tests::make_road_set({}, 1, models::Baseline::kCombined);
  MeasuredRun run = steady_run(80.0, 0.0, 0.0, 7200);
  const double cold_N = traction_N(set, run);
  const double steady_N = traction_N(set, run, {}, 7190);
  run.started_warm = true;
  const double warm_N = traction_N(set, run);
  CHECK(cold_N > 1.05 * steady_N);
  CHECK(std::abs(warm_N - steady_N) < 0.1 * (cold_N - steady_N));
}

TEST_CASE("where pressure does not matter, a drive right after another starts in the steady state itself", "[fast]") {
  MeasurementSet set = tests::make_road_set({}, 1, models::Baseline::kCombined);
  set.tire.values.rolling_resistance.pressure_exponent = 0.0;
  MeasuredRun run = steady_run(80.0, 0.0, 0.0, 7200);
  const double cold_N = traction_N(set, run);
  const double steady_N = traction_N(set, run, {}, 7190);
  run.started_warm = true;
  CHECK(cold_N > 1.05 * steady_N);
  CHECK(std::abs(traction_N(set, run) - steady_N) < 0.01 * (cold_N - steady_N));
}

TEST_CASE("wind, slope and density act as what they are", "[fast]") {
  const MeasurementSet set = tests::make_road_set({}, 1);
  const auto with = [](double wind_m_s, double slope_percent, double density_ratio) {
    return std::vector<ActiveEffect>{
        tests::make_active(models::find_effect("wind_and_grade"), {wind_m_s, slope_percent, density_ratio})};
  };
  const MeasuredRun run = steady_run(72.0, 0.0);
  CHECK(traction_N(set, run, with(0.0, 0.0, 1.0)) == traction_N(set, run));
  // Against 5 m/s of wind the air is as at 25 m/s, the road as at 20 m/s.
  const double drag_at_25_N = traction_N(set, steady_run(90.0, 0.0)) - traction_N(set, steady_run(5.0, 0.0));
  const double drag_at_20_N = traction_N(set, run) - traction_N(set, steady_run(5.0, 0.0));
  CHECK(traction_N(set, run, with(5.0, 0.0, 1.0)) - traction_N(set, run) ==
        Approx(drag_at_25_N - drag_at_20_N).epsilon(0.02));
  CHECK(traction_N(set, run, with(0.0, 0.5, 1.0)) == Approx(traction_N(set, steady_run(72.0, 0.005))).epsilon(1e-3));
  const double thin_N = traction_N(set, run) - traction_N(set, run, with(0.0, 0.0, 0.9));
  CHECK(thin_N == Approx(0.1 * drag_at_20_N).epsilon(0.05));
}

TEST_CASE("on the road the simulator's vehicle pulls as much", "[fast]") {
  tests::VehicleFixture fixture("road", true);
  const sim::Recording<double> simulated = fixture.run_quasi_static(driving_program());
  MeasuredRun run = record(fixture, simulated);
  run.columns["elevation_m"].assign(run.time_s.size(), 0.0);
  MeasurementSet set;
  set.kind = tests::kRoad;
  set.vehicle = fixture.vehicle;
  models::Context<double> context = fixture.context();
  context.vehicle = fixture.vehicle.body;
  models::Corner<double> corner(context, {});
  const auto resimulated =
      measurements::Resimulation(run, *set.kind).simulate(set, run, corner).channel("traction_force_N");
  const std::vector<double>& whole = simulated.channel("traction_force_N");
  const double density_ratio = 98.21e3 / kStandardAtmosphere_Pa;  // of the rig's air, at the same temperature
  for (const std::size_t row : {300U, 600U, 900U}) {
    const double v = run.columns.at("speed_km_h")[row];
    const double drag_N = 0.5 * kStandardAtmosphere_Pa / (287.05 * 293.15) * fixture.vehicle.body.drag_area_m2 * v * v;
    CHECK(resimulated[row] - (1.0 - density_ratio) * drag_N == Approx(whole[row]).epsilon(2e-3));
  }
}
