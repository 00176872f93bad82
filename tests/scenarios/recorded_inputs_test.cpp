// Runs that a file gives row by row: one wheel on its roller, a vehicle on the road.
#include "scenarios/common/recorded_inputs.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "measurements/resimulation.h"
#include "scenarios/run/run_spec.h"
#include "sim/core/assets.h"
#include "sim/energy_audit.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/machines.h"
#include "tests/support/temporary_folder.h"

using namespace rollrig;
using tests::TemporaryFolder;
using Ledger = sim::EnergyTerm::Ledger;

namespace {

/// Ramps, load steps, drive and brake force, a lifted wheel, standstill, air that warms.
const std::string kOnRoller =
    "time_s,speed_km_h,load_N,longitudinal_force_N,ambient_degC\n0,80,5400,150,25\n300,80,4000,900,25.5\n"
    "400,120,4000,-900,26\n700,120,0,0,26\n800,0,5400,-400,27\n1100,0,5400,0,27\n1140,60,5400,500,27\n"
    "1500,60,5400,100,27\n";
/// Uphill, downhill, hard braking, a stop.
const std::string kOnRoad =
    "time_s,speed_km_h,elevation_m,ambient_degC\n0,50,300,10\n200,90,340,11\n600,90,280,11\n615,0,280,11\n"
    "700,0,280,12\n760,70,285,12\n1200,70,285,12\n";

/// A spec of one of the scenarios on rows given as text; the folder holds them as long as it lives.
struct Follow {
  TemporaryFolder folder;
  scenarios::RunSpec spec;

  Follow(const std::string& scenario, const std::string& csv, std::vector<std::string> settings = {}) {
    tests::write_file(folder.file("rows.csv"), csv);
    settings.push_back("program=" + folder.file("rows.csv"));
    spec = tests::make_spec(scenario, "a50", settings, "quasi_static");
  }
  scenarios::Outcome run() const { return scenarios::run_scenario(spec, {}); }
};

Follow on_roller(const std::vector<std::string>& settings = {}) { return {"follow_roller", kOnRoller, settings}; }
Follow on_road(const std::vector<std::string>& settings = {}) { return {"follow_road", kOnRoad, settings}; }

void check_closed(const scenarios::Outcome& outcome) {
  const sim::EnergyAudit& audit = outcome.recording.audit;
  CHECK(audit.find_largest_J() > 1e5);  // something moved
  CHECK(std::abs(audit.calc_closure(Ledger::kMechanical)) < sim::kAuditLimit);
  CHECK(std::abs(audit.calc_closure(Ledger::kThermal)) < sim::kAuditLimit);
}

double value_at(const scenarios::Outcome& outcome, const char* channel, double time_s) {
  return outcome.recording.channel(channel)[outcome.recording.row_at(time_s)];
}

measurements::MeasurementSet write_and_read(const scenarios::RunSpec& spec, const scenarios::Outcome& outcome) {
  const TemporaryFolder folder;
  for (const auto& [name, content] : scenarios::write_measurement_set(spec, outcome, "test")) {
    tests::write_file(folder.file(name), content);
  }
  return measurements::read_measurement_set(folder.path());
}

}  // namespace

TEST_CASE("energy closes on the roller and on the road, with any effect on", "[fast]") {
  check_closed(on_roller().run());
  check_closed(on_road().run());
  for (const models::Effect* effect : models::all_effects()) {
    const std::string& id = effect->info.id;
    const models::EffectParameter& size = effect->info.parameters.front();
    INFO(id);
    const std::string on = "effects." + id + "." + size.key + "=" + std::to_string(size.prior.center());
    if (models::acts_in(effect->info, tests::kDyno->traits, models::default_tire_model())) {
      check_closed(on_roller({on}).run());
    }
    if (models::acts_in(effect->info, tests::kRoad->traits, models::default_tire_model())) {
      check_closed(on_road({on}).run());
    }
  }
}

TEST_CASE("the rows of a wheel are followed from a run-up on", "[fast]") {
  const auto outcome = on_roller().run();
  CHECK(outcome.recording.time_s.front() == -60.0);
  CHECK(value_at(outcome, "speed_km_h", -60.0) == 0.0);
  CHECK(3.6 * value_at(outcome, "speed_km_h", -30.0) == Approx(40.0));
  CHECK(value_at(outcome, "load_N", -30.0) == Approx(5400.0));
  CHECK(value_at(outcome, "load_N", 299.0) == Approx(5400.0));
  CHECK(value_at(outcome, "load_N", 300.0) == Approx(4000.0));
  CHECK(value_at(outcome, "longitudinal_force_N", 150.0) == Approx(525.0));
  CHECK(value_at(outcome, "ambient_degC", 150.0) == Approx(298.4));
  CHECK(tests::number(outcome, "duration_s") == Approx(1500.0));
  const double expected_km = 80.0 * 300.0 + 100.0 * 100.0 + 120.0 * 300.0 + 60.0 * 100.0 + 30.0 * 40.0 + 60.0 * 360.0;
  CHECK(tests::number(outcome, "distance_km") == Approx(expected_km / 3600.0));
  CHECK(Follow("follow_road", "time_s,speed_km_h,elevation_m,ambient_degC\n5,0,0,20\n65,50,0,20\n")
            .run()
            .recording.time_s.front() == 0.0);  // no run-up to standstill
}

TEST_CASE("a lifted wheel leaves the roller's own loss, and force adds what slip costs", "[fast]") {
  const std::string header = "time_s,speed_km_h,load_N,longitudinal_force_N,ambient_degC\n";
  const Follow lifted("follow_roller", header + "0,80,0,0,25\n200,80,0,0,25\n");
  const double roller_N = models::calc_parasitic_N(lifted.spec.rig.parasitic, 80.0 / 3.6);
  CHECK(tests::number(lifted.run(), "loss_force_end_N") == Approx(roller_N).epsilon(1e-9));
  const std::string pulled = header + "0,80,5400,800,25\n10,80,5400,800,25\n";
  const auto without = Follow("follow_roller", pulled).run();
  const auto slipping = Follow("follow_roller", pulled, {"effects.slip_loss.compliance_per_kN=0.01"}).run();
  CHECK(value_at(slipping, "loss_force_N", 0.0) - value_at(without, "loss_force_N", 0.0) ==
        Approx(800.0 * 800.0 * 0.01e-3).epsilon(0.02));
}

TEST_CASE("a set holds no loss force below 20 km/h and no traction where friction brakes act", "[fast]") {
  for (const char* kind : {"dyno", "road"}) {
    const bool is_road = std::string(kind) == "road";
    Follow follow = is_road ? on_road() : on_roller();
    const Quantity channel = is_road ? models::quantities::kTractionForce : models::quantities::kLossForce;
    follow.spec.sensors = models::SensorSet{{channel, {}}};
    const auto outcome = follow.run();
    const measurements::MeasurementSet set = write_and_read(follow.spec, outcome);
    REQUIRE(set.runs.size() == 1);
    CHECK(set.kind == (is_road ? tests::kRoad : tests::kDyno));
    const measurements::MeasuredRun& run = set.runs.front();
    CHECK(run.columns.size() == (is_road ? 4 : 5));
    int empty = 0;
    for (std::size_t row = 0; row < run.time_s.size(); ++row) {
      const bool expected = is_road ? outcome.recording.channel(models::quantities::kFrictionBrake)[row] > 0.0
                                    : outcome.recording.channel("speed_km_h")[row] < 20.0 / 3.6;
      CHECK(std::isnan(run.columns.at(channel)[row]) == expected);
      empty += expected ? 1 : 0;
    }
    CHECK(empty > 10);
    CHECK(empty < 500);
  }
}

TEST_CASE("what a set says of its run's beginning is what the settings said", "[fast]") {
  Follow rested = on_roller({"rest_before_min=30", "pressure_kPa=260", "initial_tire_temperature_degC=31"});
  const measurements::MeasuredRun run = write_and_read(rested.spec, rested.run()).runs.front();
  CHECK(run.id == "rows");
  CHECK(*run.rest_before_s == Approx(1800.0));
  CHECK(run.cold_pressure_Pa == Approx(260e3));
  CHECK(run.initial_tire_temperature_K == Approx(304.15));
  CHECK_FALSE(run.started_warm);
  const Follow warm = on_road({"tire_state=warm"});
  CHECK(write_and_read(warm.spec, warm.run()).runs.front().started_warm);
}

TEST_CASE("the vehicle that a set of the road names is that of the run", "[fast]") {
  const Follow heavy = on_road({"vehicle.mass_kg=2500", "vehicle.drag_area_m2_sd=0.02"});
  const rigs::VehicleFile vehicle = *write_and_read(heavy.spec, heavy.run()).vehicle;
  CHECK(vehicle.body.mass_kg == 2500.0);
  CHECK(vehicle.uncertainties.drag_area_m2 == Approx(0.02));
  CHECK(vehicle.count_wheels() == heavy.spec.vehicle->count_wheels());
  CHECK(vehicle.powertrain.regeneration_fade_m_s == Approx(heavy.spec.vehicle->powertrain.regeneration_fade_m_s));
  CHECK(rigs::list_driven_axles(vehicle) == "rear");
}

TEST_CASE("a set of a vehicle whose axles differ holds their tires, and is simulated again to the same force",
          "[fast]") {
  Follow follow = on_road();
  std::vector<rigs::VehicleAxle>& axles = follow.spec.vehicle->axles;
  axles[0].load_share = 0.6;
  axles[0].tire = models::read_tire(read_config(find_asset("tires", "a40")));
  axles[1].load_share = 0.4;
  axles[1].tire = follow.spec.tire;
  axles[1].pressure_Pa = 310e3;
  follow.spec.sensors = models::SensorSet{{models::quantities::kTractionForce, {}}};
  const auto outcome = follow.run();
  const measurements::MeasurementSet set = write_and_read(follow.spec, outcome);
  CHECK(set.vehicle->axles[0].tire->name == "a40");
  CHECK_FALSE(set.vehicle->axles[1].tire.has_value());  // that of the set
  models::Corner<double> corner(measurements::make_context(set), {});
  const measurements::MeasuredRun& run = set.runs.front();
  const auto again = measurements::Resimulation(run, *set.kind).simulate(set, run, corner);
  const std::vector<double>& before_N = outcome.recording.channel("traction_force_N");
  const std::vector<double>& again_N = again.channel("traction_force_N");
  REQUIRE(again_N.size() == before_N.size());
  for (std::size_t i = 0; i < before_N.size(); ++i) CHECK(again_N[i] == Approx(before_N[i]).margin(0.5));  // CSV digits
}

TEST_CASE("sensors of a wheel err by the seed", "[fast]") {
  Follow follow = on_roller();
  const std::vector<double> truth = follow.run().recording.channel("loss_force_N");
  follow.spec.sensors = tests::kDyno->default_sensors;
  const std::vector<double> one = follow.run().recording.channel("loss_force_N");
  CHECK(follow.run().recording.channel("loss_force_N") == one);
  follow.spec.seed = 2;
  CHECK(follow.run().recording.channel("loss_force_N") != one);
  double square_N2 = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) square_N2 += std::pow(one[i] - truth[i], 2);
  const double rms_N = std::sqrt(square_N2 / static_cast<double>(truth.size()));
  CHECK(rms_N > 1.0);
  CHECK(rms_N < 10.0);
}
