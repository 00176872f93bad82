// One wheel on its roller and a vehicle on the road, driven as recorded: what mechanics and energy must obey.
#include <catch2/catch.hpp>
#include <cmath>

#include "rigs/recorded_road.h"
#include "rigs/recorded_roller.h"
#include "sim/lagged_midpoint_integrator.h"
#include "tests/support/drum_sets.h"
#include "tests/support/vehicle_fixture.h"

using namespace rollrig;
using Ledger = sim::EnergyTerm::Ledger;

namespace {

constexpr double kRadius_m = 0.61;
constexpr double kSegment_s = 2.0;

/// A roller of 1.22 m under a tire, off every symmetric point.
struct RollerFixture : tests::VehicleFixture {
  RollerFixture() : VehicleFixture("dyno_1m2") { rig.drum.diameter_m = 2.0 * kRadius_m; }

  sim::Recording<double> run(const sim::Program& program) const {
    models::Corner<double> corner(context(), effects);
    rigs::RecordedRoller<double> roller(corner, start(), false, rigs::Detail::kFull);
    sim::LaggedMidpointIntegrator<double> integrator(roller);
    return sim::simulate<double>(roller, integrator, program);
  }
};

struct Stretch {
  double duration_s;
  double start_m_s;
  double end_m_s;
  double load_N;
  double force_N;
};

/// Stretches in segments of two seconds.
sim::Program make_roller_program(const std::vector<Stretch>& stretches) {
  sim::Phase phase;
  phase.name = "recorded";
  for (const Stretch& stretch : stretches) {
    const double slope = (stretch.end_m_s - stretch.start_m_s) / stretch.duration_s;
    for (double t = 0.0; t < stretch.duration_s; t += kSegment_s) {
      sim::Segment segment{kSegment_s, sim::Ramps(rigs::kRollerInputCount)};
      segment.inputs[rigs::index_of(rigs::DrumInput::kSpeed)] = {stretch.start_m_s + slope * t, slope};
      segment.inputs[rigs::index_of(rigs::DrumInput::kLoad)] = {stretch.load_N, 0.0};
      segment.inputs[rigs::index_of(rigs::DrumInput::kAmbient)] = {293.15, 0.0};
      segment.inputs[rigs::kLongitudinalForceInput] = {stretch.force_N, 0.0};
      phase.segments.push_back(segment);
    }
  }
  return tests::make_program({phase});
}

const std::vector<Stretch> kDrive{{40.0, 0.0, 30.0, 5400.0, 900.0}, {300.0, 30.0, 30.0, 5400.0, 160.0},
                                  {200.0, 30.0, 30.0, 4100.0, 0.0}, {30.0, 30.0, 12.0, 4100.0, -1200.0},
                                  {60.0, 12.0, 12.0, 0.0, 0.0},     {100.0, 12.0, 25.0, 5000.0, 300.0}};

}  // namespace

TEST_CASE("energy closes on a roller of any size, with slip, wrong inertia, and straps that creep", "[fast]") {
  RollerFixture fixture;
  for (const bool with_effects : {false, true}) {
    if (with_effects) {
      fixture.effects = {tests::make_effect_at("slip_loss", 1.0), tests::make_effect_at("inertia_error", 1.0),
                         tests::make_active(models::find_effect("tie_down_load"), {300.0, 0.2})};
    }
    const sim::EnergyAudit audit = fixture.run(make_roller_program(kDrive)).audit;
    CHECK(audit.throughput_J > 1e6);
    CHECK(audit.calc_closure(Ledger::kMechanical) < 1e-7);
    CHECK(audit.calc_closure(Ledger::kThermal) < 1e-9);
    CHECK((audit.find_term_J("slip_loss") != 0.0) == with_effects);
  }
}

TEST_CASE("hub and roller share the loss by the couple, and trade the longitudinal force", "[fast]") {
  const RollerFixture fixture;
  const auto at_end = [&](double force_N) {
    return fixture.run(make_roller_program({{60.0, 20.0, 20.0, 5400.0, force_N}}));
  };
  const auto free = at_end(0.0);
  const double tire_J = -free.audit.find_term_J("tire_loss");
  const double bearing_J = -free.audit.find_term_J("bearing_loss");
  const double loaded_radius_m = 0.7176 / 2.0 - 5400.0 / 220000.0;
  const double at_hub = 1.0 / (1.0 + loaded_radius_m / kRadius_m);
  CHECK(free.audit.find_term_J(sim::kMotorWork) == Approx(at_hub * tire_J).epsilon(1e-12));
  CHECK(free.audit.find_term_J("rollers") == Approx((1.0 - at_hub) * tire_J + bearing_J).epsilon(1e-12));
  const auto pulled = at_end(700.0);
  const double traded_J = 700.0 * 20.0 * 60.0;
  CHECK(pulled.audit.find_term_J(sim::kMotorWork) - free.audit.find_term_J(sim::kMotorWork) ==
        Approx(traded_J).epsilon(1e-12));
  CHECK(pulled.audit.find_term_J("rollers") - free.audit.find_term_J("rollers") == Approx(-traded_J).epsilon(1e-12));
}

TEST_CASE("a load step on a turning roller is an energy of its own: the wheel spins faster", "[fast]") {
  const RollerFixture fixture;
  const auto recording =
      fixture.run(make_roller_program({{30.0, 25.0, 25.0, 3000.0, 0.0}, {30.0, 25.0, 25.0, 6000.0, 0.0}}));
  const auto spin_J = [](double load_N) {
    const double radius_m = 0.7176 / 2.0 - load_N / 220000.0;
    return 0.5 * 1.5 * std::pow(25.0 / radius_m, 2);
  };
  CHECK(recording.audit.find_term_J("load_changes") == Approx(spin_J(6000.0) - spin_J(3000.0)).epsilon(1e-9));
}

TEST_CASE("the roller shows what the vehicle on it shows at the same force, in both fidelities", "[fast]") {
  RollerFixture fixture;
  fixture.effects = {tests::make_effect_at("slip_loss", 1.0)};
  fixture.set_load = {300.0, 0.0, 0.4};
  const double v = 25.0;
  const sim::Program held = tests::make_program({tests::driving("hold", 300.0, v, v)});
  for (const bool multibody : {false, true}) {
    const auto vehicle = static_cast<const tests::VehicleFixture&>(fixture).run(multibody, held);
    const std::size_t row = vehicle.row_count() - 2;  // the mean of the last is not about its row
    const double load_N = vehicle.channel("load_N")[row];
    const double loaded_radius_m = 0.7176 / 2.0 - load_N / 220000.0;
    const double contact_N = vehicle.channel("longitudinal_force_N")[row] -
                             vehicle.channel("rolling_resistance_N")[row] / (1.0 + loaded_radius_m / kRadius_m);
    REQUIRE(contact_N > 100.0);
    const auto wheel = fixture.run(make_roller_program({{300.0, v, v, load_N, contact_N}}));
    INFO((multibody ? "multibody" : "quasi-static"));
    CHECK(wheel.channel("loss_force_N")[row] == Approx(vehicle.channel("loss_force_N")[row]).epsilon(1e-4));
    CHECK(wheel.channel("liner_temperature_degC")[row] ==
          Approx(vehicle.channel("liner_temperature_degC")[row]).margin(0.02));
  }
}

TEST_CASE("what only sensors show is the same when nothing else is integrated, on roller and road", "[fast]") {
  const auto compare = [](const sim::Recording<double>& measured, const sim::Recording<double>& full) {
    REQUIRE(!measured.channels.empty());
    for (const sim::Channel& channel : measured.channels) {
      CHECK(measured.channel(channel.quantity) == full.channel(channel.quantity));
    }
    CHECK(measured.audit.terms.empty());
    CHECK(measured.channels.size() < full.channels.size());
  };
  const auto run = [](auto& machine, const sim::Program& program) {
    sim::LaggedMidpointIntegrator<double> integrator(machine);
    return sim::simulate<double>(machine, integrator, program);
  };
  RollerFixture fixture;
  fixture.effects = {tests::make_effect_at("rim_heat", 0.5)};
  models::Corner<double> on_roller(fixture.context(), fixture.effects);
  rigs::RecordedRoller<double> measured(on_roller, fixture.start(), false, rigs::Detail::kMeasured);
  CHECK(measured.integrals().size() == 7);  // with the rim, the scale and the counter of turns
  compare(run(measured, make_roller_program(kDrive)), fixture.run(make_roller_program(kDrive)));
  models::Context<double> context = tests::VehicleFixture("road").context();
  context.vehicle = fixture.vehicle.body;
  models::Corner<double> on_road(context, {});
  const double start_K = fixture.start().tire_temperature_K;
  const sim::Program drive = tests::make_program({tests::driving("up", 60.0, 5.0, 25.0, 0.02)});
  const std::vector<rigs::RoadTireGroup<double>> tires{{&on_road, 4.0, 5000.0, fixture.cold_pressure_Pa, start_K}};
  const rigs::VehiclePowertrain& powertrain = fixture.vehicle.powertrain;
  rigs::RecordedRoad<double> road(tires, powertrain, fixture.start(), rigs::Detail::kMeasured);
  rigs::RecordedRoad<double> road_in_full(tires, powertrain, fixture.start(), rigs::Detail::kFull);
  CHECK(road.integrals().size() == 1);
  compare(run(road, drive), run(road_in_full, drive));
}
