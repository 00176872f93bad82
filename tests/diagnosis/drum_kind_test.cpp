// What the diagnosis takes of a drum whose radius is not 1 m: forces at the surface, and what sensors on it read.
#include <algorithm>
#include <catch2/catch.hpp>

#include "diagnosis/checks/rig_sensors.h"
#include "diagnosis/kinds/kinds.h"
#include "measurements/resimulation.h"
#include "measurements/sensor_file.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/uneven_machines.h"

using namespace rollrig;
using namespace rollrig::diagnosis;

namespace {

constexpr double kRrc = 0.0083;
constexpr double kLoad_N = 4700.0;
constexpr double kSpeed_m_s = 80.0 / 3.6;

/// A minute of a tire of constant coefficient on a drum, without noise; its torque as simulated.
measurements::MeasurementSet measure_constant(const rigs::RigFile& rig) {
  measurements::MeasurementSet set;
  set.path = "simulated";
  set.name = "simulated";
  set.baseline = models::Baseline::kConstantRrc;
  set.tire = tests::read_combined_tire();
  set.tire.has_constant = true;
  set.tire.values.constant.rrc = kRrc;
  set.rig = rig;
  set.kind = set.rig->kind;
  set.sensors = measurements::read_sensor_asset("source");
  measurements::MeasuredRun run;
  run.id = "steady";
  run.session = "day";
  run.initial_tire_temperature_K = 298.15;
  run.cold_pressure_Pa = 280e3;
  for (int second = 0; second < 60; ++second) {
    run.time_s.push_back(second);
    run.columns["speed_km_h"].push_back(kSpeed_m_s);
    run.columns["load_N"].push_back(kLoad_N);
    run.columns["ambient_degC"].push_back(298.15);
  }
  models::Corner<double> corner(measurements::make_context(set), {});
  const auto recording = measurements::Resimulation(run, *set.kind).simulate(set, run, corner);
  for (const auto& [channel, sensor] : set.sensors) run.columns[channel] = recording.channel(channel);
  set.runs.push_back(std::move(run));
  return set;
}

}  // namespace

TEST_CASE("of a drum's torque the tire has what its coefficient says, on a drum of any size", "[fast]") {
  for (const double diameter_m : {1.707, 2.5}) {
    rigs::RigFile rig = tests::make_uneven_drum();
    rig.drum.diameter_m = diameter_m;
    const auto set = measure_constant(rig);
    const double torque_Nm = set.runs[0].columns.at("drum_torque_Nm")[40];
    const auto force_N = drum_kind().find_tire_force_N(set, set.runs[0], 40, torque_Nm);
    INFO(diameter_m << " m");
    REQUIRE(force_N.has_value());
    CHECK(*force_N == Approx(kRrc * kLoad_N).epsilon(1e-6));
  }
}

TEST_CASE("a weight hung on the drum's circumference is the force that it is, on a drum of any size", "[fast]") {
  constexpr double kWeight_N = 60.0;
  std::vector<double> tolerance_N;
  for (const double diameter_m : {1.707, 2.5}) {
    measurements::MeasurementSet set;
    set.rig = tests::make_uneven_drum();
    set.kind = set.rig->kind;
    set.rig->drum.diameter_m = diameter_m;
    const double arm_m = diameter_m / 2.0;
    INFO(diameter_m << " m");
    CHECK(kWeight_N * arm_m * drum_kind().force_channel(set).newtons_per_SI == Approx(kWeight_N));
    tolerance_N.push_back(drum_kind().calc_force_tolerance(set, kWeight_N * arm_m) / arm_m);
  }
  CHECK(tolerance_N[0] == Approx(tolerance_N[1]));
}

TEST_CASE("a light barrier counts the turns of the drum, not what the record says of them", "[fast]") {
  const PreparedSet set(measure_constant(tests::make_uneven_drum()));
  constexpr double kErrorPercent = 4.0;  // true over recorded, at 80 km/h
  models::Corner<double> corner(set.context(),
                                {tests::make_active(models::find_effect("speed_record"), {kErrorPercent})});
  const measurements::MeasuredRun& run = set.runs().front().simulated.run;
  const auto recording = set.runs().front().resimulation.simulate(set.source(), run, corner, rigs::Detail::kFull);
  const auto read_m_s = read_channel(set.source(), run, corner, recording, {"speed_reading", "km_h"});
  REQUIRE(read_m_s.size() == run.time_s.size());
  const auto [slowest, fastest] = std::minmax_element(read_m_s.begin(), read_m_s.end());
  CHECK(*slowest == Approx(1.04 * kSpeed_m_s));
  CHECK(*fastest == Approx(1.04 * kSpeed_m_s));
}
