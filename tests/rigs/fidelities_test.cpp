// Multibody and quasi-static, held together on every drum scenario: torque to 1e-4 relative (1 s means, from
// 10 s after a load or speed knot), temperature to 0.02 K.
#include <catch2/catch.hpp>
#include <cmath>

#include "build_paths.h"
#include "scenarios/run/scenario.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/temporary_folder.h"

using namespace rollrig;

namespace {

/// Times at which the load jumps or the acceleration does.
std::vector<double> find_knots_s(const sim::Recording<double>& recording) {
  std::vector<double> knots_s;
  for (const sim::PhaseSpan& phase : recording.phases) knots_s.push_back(phase.start_s);
  const std::vector<double>& load_N = recording.channel("load_N");
  const std::vector<double>& speed_m_s = recording.channel("speed_km_h");
  for (std::size_t i = 1; i + 1 < recording.row_count(); ++i) {
    const double kink_m_s = speed_m_s[i + 1] - 2.0 * speed_m_s[i] + speed_m_s[i - 1];
    if (std::abs(load_N[i] - load_N[i - 1]) > 1.0 || std::abs(kink_m_s) > 1e-3) knots_s.push_back(recording.time_s[i]);
  }
  return knots_s;
}

/// Rows 10 s and more after the last knot of load or speed, and half a second before the next.
std::vector<bool> find_comparable(const sim::Recording<double>& recording) {
  std::vector<bool> comparable(recording.row_count(), true);
  for (const double knot_s : find_knots_s(recording)) {
    for (std::size_t i = 0; i < recording.row_count(); ++i) {
      const double since_s = recording.time_s[i] - knot_s;
      if (since_s > -0.75 && since_s < 10.0) comparable[i] = false;
    }
  }
  return comparable;
}

void compare(const std::string& scenario, const std::string& tire, const std::vector<std::string>& settings = {}) {
  const scenarios::RunSpec multibody_spec = tests::make_spec(scenario, tire, settings, "multibody");
  const scenarios::RunSpec quasi_static_spec = tests::make_spec(scenario, tire, settings, "quasi_static");
  const auto multibody = scenarios::run_scenario(multibody_spec, {}).recording;
  const auto quasi_static = scenarios::run_scenario(quasi_static_spec, {}).recording;
  REQUIRE(multibody.time_s == quasi_static.time_s);
  const std::vector<bool> comparable = find_comparable(multibody);
  const auto& torque_m = multibody.channel("drum_torque_Nm");
  const auto& torque_q = quasi_static.channel("drum_torque_Nm");
  const auto& liner_m = multibody.channel("liner_temperature_degC");
  const auto& liner_q = quasi_static.channel("liner_temperature_degC");
  double worst_torque = 0.0, worst_K = 0.0;
  std::size_t compared = 0;
  for (std::size_t i = 0; i < comparable.size(); ++i) {
    worst_K = std::max(worst_K, std::abs(liner_m[i] - liner_q[i]));
    if (!comparable[i] || multibody.channel("speed_km_h")[i] == 0.0) continue;
    REQUIRE(torque_q[i] != 0.0);  // a motor that is off would be compared with nothing
    worst_torque = std::max(worst_torque, std::abs(torque_m[i] / torque_q[i] - 1.0));
    ++compared;
  }
  INFO(scenario << " " << tire << ": torque " << worst_torque << ", temperature " << worst_K << " K, " << compared
                << " rows");
  CHECK(compared > 100);
  CHECK(worst_torque < 1e-4);
  CHECK(worst_K < 0.02);
}

}  // namespace

TEST_CASE("the two fidelities agree on every drum scenario", "[slow]") {
  for (const scenarios::Scenario* scenario : scenarios::all_scenarios()) {
    if (scenario->has_vehicle) continue;  // those: vehicle_fidelities_test.cpp
    if (scenario->fidelities.size() < 2) continue;
    const std::string file = std::string(ROLLRIG_SOURCE_DIR) + "/assets/regression/follow_drum_a50.csv";
    std::vector<std::string> settings;
    if (scenario->text.name == "follow_drum") settings = {"program=" + file};
    // A run-down of a minute from 15 km/h ends with so small a torque that 0.01 N m of it is more than the tolerance.
    if (scenario->text.name == "sae_j2452") settings = {"run_up_s=10"};
    compare(scenario->text.name, "a50", settings);
  }
}

TEST_CASE("they agree for the other tires and with all effects on", "[fast]") {
  compare("iso_28580", "a40");
  compare("iso_28580", "a60", {"measurement_cycles=2"});
  compare("transient_skim", "a50",
          {"effects.bearing_warmup.fall_per_K=0.02", "effects.load_exponent.exponent=1.1",
           "effects.tire_loss_in_skim.force_N=2"});
}

TEST_CASE("they agree where the drum changes its speed below a lifted tire, whose wheel it does not turn", "[fast]") {
  const tests::TemporaryFolder folder;
  tests::write_file(folder.file("lifted.csv"),
                    "time_s,speed_km_h,load_N,ambient_degC\n0,80,5400,25\n120,80,0,25\n180,80,0,25\n300,30,0,25\n"
                    "360,30,0,25\n480,100,0,25\n600,100,0,25\n");
  compare("follow_drum", "a50", {"program=" + folder.file("lifted.csv")});
}
