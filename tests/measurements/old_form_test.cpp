// Sets of the first form of the file formats are read as they were: drum, dynamometer and road, with the tire's old
// keys.
#include <catch2/catch.hpp>
#include <cmath>

#include "build_paths.h"
#include "measurements/measurement_set.h"
#include "measurements/resimulation.h"
#include "tests/support/machines.h"

using namespace rollrig;
using measurements::MeasuredRun;
using measurements::MeasurementSet;

namespace {

MeasurementSet read_old(const std::string& kind) {
  return measurements::read_measurement_set(ROLLRIG_SOURCE_DIR "/tests/measurements/old_form/" + kind);
}

/// Equal up to the rounding of a change of units; an empty field is NaN.
void check_column(const MeasuredRun& run, const std::string& column, const std::vector<double>& expected) {
  INFO(run.id << " " << column);
  const std::vector<double>& values = run.columns.at(column);
  REQUIRE(values.size() == expected.size());
  for (std::size_t row = 0; row < expected.size(); ++row) {
    INFO("row " << row);
    if (std::isnan(expected[row])) {
      CHECK(std::isnan(values[row]));
    } else {
      CHECK(values[row] == Approx(expected[row]).epsilon(1e-12));
    }
  }
}

void check_sensor(const MeasurementSet& set, const std::string& channel, const models::SensorParameters& expected) {
  INFO(channel);
  const models::SensorParameters& sensor = set.sensors.at(channel);
  CHECK(sensor.offset_sd == Approx(expected.offset_sd));
  CHECK(sensor.drift_sd == Approx(expected.drift_sd));
  CHECK(sensor.drift_time_s == Approx(expected.drift_time_s));
  CHECK(sensor.noise_sd == Approx(expected.noise_sd));
  CHECK(sensor.resolution == Approx(expected.resolution));
}

const double kNone = std::nan("");

}  // namespace

TEST_CASE("a drum set of the old form is read", "[fast]") {
  const MeasurementSet set = read_old("drum");
  CHECK(set.kind == tests::kDrum);
  CHECK(set.name == "hatchback tire on a short drum");
  CHECK(set.baseline == models::Baseline::kCombined);
  CHECK(set.assumed_sensors.empty());
  check_sensor(set, "drum_torque_Nm", {0.5, 0.2, 90.0, 0.3, 0.01});
  check_sensor(set, "liner_temperature_degC", {0.4, 0.1, 45.0, 0.2, 0.1});
  check_sensor(set, "cavity_pressure_kPa", {600.0, 200.0, 150.0, 100.0, 500.0});

  REQUIRE(set.runs.size() == 2);
  const MeasuredRun& first = set.runs[0];
  CHECK(first.id == "first");
  CHECK(first.session == "morning");
  CHECK(first.initial_tire_temperature_K == Approx(295.15));
  CHECK(first.cold_pressure_Pa == Approx(248e3));
  CHECK_FALSE(first.rest_before_s.has_value());
  CHECK(first.time_s == std::vector<double>{0.0, 2.0, 4.0, 6.0});
  check_column(first, "speed_km_h", {10.0, 15.0, 20.0, 20.0});
  check_column(first, "load_N", {150.0, 150.0, 4000.0, 4000.0});
  check_column(first, "ambient_degC", {296.65, 296.65, 296.75, 296.75});
  check_column(first, "drum_torque_Nm", {kNone, 9.25, 41.5, 40.75});
  check_column(first, "liner_temperature_degC", {295.25, 295.35, 295.75, kNone});
  check_column(first, "cavity_pressure_kPa", {248e3, 248e3, 248.5e3, 249e3});
  const MeasuredRun& second = set.runs[1];
  REQUIRE(second.rest_before_s.has_value());
  CHECK(*second.rest_before_s == Approx(2700.0));
  check_column(second, "surface_temperature_degC", {300.65, 300.65, 300.75});
  CHECK_FALSE(second.has_samples(intern_quantity("liner_temperature_degC")));
  CHECK_FALSE(second.has_samples(intern_quantity("cavity_pressure_kPa")));
}

TEST_CASE("rig and tire of an old drum set are read, with the conductances under their old keys", "[fast]") {
  const MeasurementSet set = read_old("drum");
  REQUIRE(set.rig.has_value());
  CHECK(set.rig->name == "short_drum");
  CHECK(set.rig->parasitic.c0_N == 4.5);
  CHECK(set.rig->parasitic.c2_N_s2_per_m2 == 0.003);
  CHECK(set.rig->environment.ambient_K == Approx(296.15));
  CHECK(set.rig->environment.ambient_pressure_Pa == Approx(101325.0));
  CHECK(set.tire.values.rolling_resistance.A0_N == 31.5);
  CHECK(set.tire.standard_uncertainties.rolling_resistance.A0_N == 0.6);
  CHECK(set.tire.values.rolling_resistance.reference_pressure_Pa == Approx(250e3));
  CHECK(set.tire.values.thermal.rest_conductance_W_per_K == 10.5);
  CHECK(set.tire.values.thermal.road_share_of_rest_conductance == 0.35);
  CHECK(set.tire.values.thermal.speed_conductance_W_s_per_m_K == 1.15);
  CHECK(set.tire.standard_uncertainties.thermal.rest_conductance_W_per_K == 1.2);
  CHECK(set.tire.standard_uncertainties.thermal.speed_conductance_W_s_per_m_K == 0.1);
  const models::RigThermal& on_rig = set.tire.rig_thermal.at("short_drum");
  CHECK(on_rig.rest_conductance_W_per_K == 13.25);
  CHECK(on_rig.rest_conductance_sd_W_per_K == 0.9);
  CHECK_FALSE(on_rig.speed_conductance_W_s_per_m_K.has_value());
  const auto thermal = measurements::make_context(set).tire.thermal;
  CHECK(thermal.rest_conductance_W_per_K == 13.25);  // of the rig
  CHECK(thermal.speed_conductance_W_s_per_m_K == 1.15);
}

TEST_CASE("a dynamometer set of the old form is read, its rig of kind dyno", "[fast]") {
  const MeasurementSet set = read_old("dyno");
  CHECK(set.kind == tests::kDyno);
  CHECK(set.assumed_sensors.empty());
  check_sensor(set, "loss_force_N", {1.5, 0.8, 40.0, 2.5, 0.1});
  REQUIRE(set.runs.size() == 1);
  const MeasuredRun& run = set.runs[0];
  CHECK(run.initial_tire_temperature_K == Approx(293.65));
  CHECK(run.cold_pressure_Pa == Approx(252e3));
  check_column(run, "speed_km_h", {0.0, 5.0, 12.5, 7.5});
  check_column(run, "load_N", {4100.0, 4100.0, 4100.0, 4100.0});
  check_column(run, "longitudinal_force_N", {0.0, 450.0, 310.0, -820.0});
  check_column(run, "ambient_degC", {294.15, 294.15, 294.25, 294.25});
  check_column(run, "surface_temperature_degC", {294.65, 294.65, 294.65, 294.75});
  check_column(run, "loss_force_N", {kNone, kNone, 52.5, 51.0});
  check_column(run, "liner_temperature_degC", {293.65, 293.65, 293.95, 294.15});
  check_column(run, "cavity_pressure_kPa", {252e3, 252e3, 252.5e3, 252.5e3});

  const auto thermal = measurements::make_context(set).tire.thermal;
  CHECK(thermal.rest_conductance_W_per_K == 11.0);  // both of the rig
  CHECK(thermal.speed_conductance_W_s_per_m_K == 1.6);
  CHECK(thermal.road_share_of_rest_conductance == 0.4);
  CHECK(set.tire.values.thermal.rest_conductance_W_per_K == 9.75);
  CHECK(set.tire.values.thermal.speed_conductance_W_s_per_m_K == 1.3);
  CHECK(set.tire.rig_thermal.at("pair_of_rollers").speed_conductance_sd_W_s_per_m_K == 0.2);
}

TEST_CASE("a road set of the old form is read, against a constant coefficient", "[fast]") {
  const MeasurementSet set = read_old("road");
  CHECK(set.kind == tests::kRoad);
  CHECK(set.baseline == models::Baseline::kConstantRrc);
  CHECK_FALSE(set.rig.has_value());
  REQUIRE(set.vehicle.has_value());
  CHECK(set.vehicle->body.mass_kg == 1480.0);
  CHECK(set.vehicle->body.rotating_mass_kg == 46.0);
  CHECK(set.vehicle->body.drag_area_m2 == 0.66);
  CHECK(set.vehicle->uncertainties.mass_kg == 25.0);
  CHECK(set.vehicle->uncertainties.rotating_mass_kg == 0.0);
  CHECK(set.vehicle->uncertainties.drag_area_m2 == 0.02);
  CHECK(set.vehicle->count_wheels() == 4);
  check_sensor(set, "traction_force_N", {12.0, 80.0, 15.0, 60.0, 1.0});
  REQUIRE(set.runs.size() == 2);
  CHECK_FALSE(set.runs[0].started_warm);
  CHECK(set.runs[1].started_warm);
  CHECK(set.runs[0].initial_tire_temperature_K == Approx(287.15));
  CHECK(set.runs[1].cold_pressure_Pa == Approx(258e3));
  check_column(set.runs[0], "speed_km_h", {0.0, 2.5, 5.0, 7.5});
  check_column(set.runs[0], "elevation_m", {112.0, 112.0, 112.2, 112.5});
  check_column(set.runs[0], "ambient_degC", {286.65, 286.65, 286.65, 286.65});
  check_column(set.runs[0], "traction_force_N", {kNone, 2150.0, 2080.0, 1990.0});
  check_column(set.runs[1], "traction_force_N", {372.0, 365.0, kNone});

  CHECK(set.tire.values.constant.rrc == Approx(0.00825));
  CHECK(set.tire.standard_uncertainties.constant.rrc == Approx(0.00035));
  const auto thermal = measurements::make_context(set).tire.thermal;
  CHECK(thermal.rest_conductance_W_per_K == 8.5);
  CHECK(thermal.road_share_of_rest_conductance == 0.3);
  CHECK(thermal.speed_conductance_W_s_per_m_K == 1.05);
}
