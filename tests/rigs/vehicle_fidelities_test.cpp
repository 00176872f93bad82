// Multibody and quasi-static vehicles, held together on every vehicle scenario.
//
// What is compared, and where: the liner's temperature always, to 0.02 K; loss force to 1e-4 at held speeds above
// 20 km/h, from 10 s after a knot, and while coasting; on a cycle, where the speed has a knot every second, to
// which a vehicle on springs takes a moment to answer, the energies of each section to 1e-4 (battery
// and recuperation: of the energy at the wheels); times of coastdowns to 0.05 s, and the road load
// from them to 1e-4. On the road the load moves between the axles with drag and acceleration, by the height of the
// center of gravity, which the quasi-static vehicle leaves out: a whole vehicle there is compared by the mean of
// its wheels.
#include <catch2/catch.hpp>
#include <cmath>

#include <fmt/format.h>

#include "scenarios/common/vehicle_bench.h"
#include "scenarios/run/scenario.h"
#include "tests/support/machines.h"
#include "tests/support/vehicle_fixture.h"

using namespace rollrig;

namespace {

struct Pair {
  scenarios::Outcome multibody;
  scenarios::Outcome quasi_static;
};

Pair run_both(const std::string& scenario, const std::vector<std::string>& settings) {
  Pair pair;
  for (const bool multibody : {true, false}) {
    const auto spec = tests::make_spec(scenario, "a50", settings, multibody ? "multibody" : "quasi_static");
    (multibody ? pair.multibody : pair.quasi_static) = scenarios::run_scenario(spec, {});
  }
  return pair;
}

std::vector<std::string> channels_of(const sim::Recording<double>& recording, const std::string& quantity) {
  std::vector<std::string> headers;
  for (const sim::Channel& channel : recording.channels) {
    if (channel.quantity.header().rfind(quantity, 0) == 0) headers.push_back(channel.quantity.header());
  }
  return headers;
}

/// Of all wheels.
double mean_of(const sim::Recording<double>& recording, const std::string& quantity, std::size_t row) {
  const std::vector<std::string> names = channels_of(recording, quantity);
  double sum = 0.0;
  for (const std::string& name : names) sum += recording.channel(name)[row];
  return sum / static_cast<double>(names.size());
}

/// Rows of held speed above 20 km/h: the same for 10 s before and for 1 s after.
bool is_held(const sim::Recording<double>& recording, std::size_t row) {
  const auto& speed_m_s = recording.channel("speed_km_h");
  if (row < 10 || row + 1 >= speed_m_s.size() || speed_m_s[row] < 20.0 / 3.6) return false;
  for (std::size_t i = row - 10; i <= row + 1; ++i) {
    if (speed_m_s[i] != speed_m_s[row] || recording.phase[i] != recording.phase[row]) return false;
  }
  return true;
}

/// Coasting above 20 km/h, from 10 s after the driver let go.
bool is_coasting(const sim::Recording<double>& recording, std::size_t row) {
  const sim::PhaseSpan& phase = recording.phases[recording.phase[row]];
  return phase.name.rfind("coastdown", 0) == 0 && recording.time_s[row] > phase.start_s + 10.0 &&
         recording.time_s[row] < phase.end_s - 1.0 && recording.channel("speed_km_h")[row] > 20.0 / 3.6;
}

void compare_liners(const Pair& pair, bool each_wheel = true) {
  const auto& m = pair.multibody.recording;
  const auto& q = pair.quasi_static.recording;
  double worst_K = 0.0;
  const auto names = each_wheel ? channels_of(m, "liner_temperature") : std::vector<std::string>{"liner_temperature"};
  for (const std::string& name : names) {
    for (std::size_t i = 0; i < std::min(m.row_count(), q.row_count()); ++i) {
      worst_K = std::max(worst_K, std::abs(mean_of(m, name, i) - mean_of(q, name, i)));
    }
  }
  CHECK(worst_K < 0.02);
}

void compare_loss_forces(const Pair& pair, bool each_wheel = true) {
  const auto& m = pair.multibody.recording;
  const auto& q = pair.quasi_static.recording;
  double worst = 0.0;
  int compared = 0;
  const auto names = each_wheel ? channels_of(m, "loss_force") : std::vector<std::string>{"loss_force"};
  for (const std::string& name : names) {
    for (std::size_t i = 0; i < std::min(m.row_count(), q.row_count()); ++i) {
      if (m.phase[i] != q.phase[i] || !(is_held(q, i) || is_coasting(q, i))) continue;
      worst = std::max(worst, std::abs(mean_of(m, name, i) / mean_of(q, name, i) - 1.0));
      ++compared;
    }
  }
  INFO("loss force " << worst << " over " << compared << " rows");
  CHECK(compared > 100);
  CHECK(worst < 1e-4);
}

void compare_sections(const Pair& pair, double hub_limit = 1e-4, double rrc_limit = 1e-4) {
  const auto& m = pair.multibody.result["sections"];
  const auto& q = pair.quasi_static.result["sections"];
  REQUIRE(m.size() == q.size());
  for (std::size_t i = 0; i < m.size(); ++i) {
    INFO(m[i]["name"].get<std::string>());
    for (const char* key : {"distance_km", "rr_energy_Wh", "rr_energy_iso_Wh"}) {
      INFO(key);
      CHECK(m[i][key].get<double>() == Approx(q[i][key].get<double>()).epsilon(1e-4));
    }
    CHECK(m[i]["mean_rrc_N_per_kN"].get<double>() ==
          Approx(q[i]["mean_rrc_N_per_kN"].get<double>()).epsilon(rrc_limit));
    for (const char* key : {"wheel_energy_Wh", "recuperated_Wh", "battery_energy_Wh"}) {
      INFO(key);
      const double margin_Wh = hub_limit * q[i]["wheel_energy_Wh"].get<double>();
      CHECK(m[i][key].get<double>() == Approx(q[i][key].get<double>()).margin(margin_Wh));
    }
    CHECK(m[i]["temperature_end_degC"].get<double>() ==
          Approx(q[i]["temperature_end_degC"].get<double>()).margin(0.02));
  }
}

void compare_road_loads(const Pair& pair) {
  const auto& m = pair.multibody.result["force_N"];
  const auto& q = pair.quasi_static.result["force_N"];
  for (std::size_t i = 0; i < m.size(); ++i) {
    CHECK(m[i]["force_N"].get<double>() == Approx(q[i]["force_N"].get<double>()).epsilon(1e-4));
  }
  const auto& times_m = pair.multibody.result["coastdowns"];
  const auto& times_q = pair.quasi_static.result["coastdowns"];
  for (std::size_t i = 0; i < times_m.size(); ++i) {
    CHECK(times_m[i]["duration_s"].get<double>() == Approx(times_q[i]["duration_s"].get<double>()).margin(0.05));
  }
}

void compare_j1634(const std::vector<std::string>& settings, double rrc_limit = 1e-4) {
  const Pair pair = run_both("sae_j1634", settings);
  compare_liners(pair);
  compare_loss_forces(pair);
  compare_sections(pair, 1e-4, rrc_limit);
}

void compare_coastdown(const std::vector<std::string>& settings, const std::string& rig) {
  Pair pair;
  for (const bool multibody : {true, false}) {
    ConfigTable document = scenarios::make_run_document("coastdown");
    set_config_value(document, "tire", "a50", "test");
    set_config_value(document, "rig", rig, "test");
    set_config_value(document, "fidelity", multibody ? "multibody" : "quasi_static", "test");
    for (const std::string& setting : settings) scenarios::set_run_value(document, setting);
    const auto spec = scenarios::read_run_spec(document, "");
    (multibody ? pair.multibody : pair.quasi_static) = scenarios::run_scenario(spec, {});
  }
  const bool pitches = rig == "road" && channels_of(pair.multibody.recording, "loss_force").size() > 1;
  compare_liners(pair, !pitches);
  compare_loss_forces(pair, !pitches);
  compare_road_loads(pair);
}

}  // namespace

TEST_CASE("the two fidelities agree on the source's multi-cycle test, on quarters front and rear", "[slow]") {
  for (const char* quarter : {"front", "rear"}) {
    INFO(quarter);
    compare_j1634({"wheels=1", std::string("quarter=") + quarter, "variant=source"});
  }
}

TEST_CASE("they agree on the standard's multi-cycle test", "[slow]") {
  // It counts from standstill, where the mean over time feels that a vehicle on springs starts a moment late.
  compare_j1634({"wheels=1"}, 3e-4);
}

TEST_CASE("they agree on a single cycle, with a map of the powertrain", "[slow]") {
  Pair pair;
  for (const bool multibody : {true, false}) {
    auto spec =
        tests::make_spec("drive_cycle", "a50", {"wheels=1", "wheel_of=rear"}, multibody ? "multibody" : "quasi_static");
    spec.vehicle->powertrain.map = models::PowertrainMap{
        {0.0, 12.0, 40.0}, {-60e3, 0.0, 90e3}, {{0.5, 0.6, 0.7}, {0.8, 0.7, 0.9}, {0.85, 0.8, 0.9}}};
    (multibody ? pair.multibody : pair.quasi_static) = scenarios::run_scenario(spec, {});
  }
  compare_liners(pair);
  compare_sections(pair, 3e-4, 3e-4);  // the speed is never held, so that there are no forces to compare
}

TEST_CASE("they agree on the whole vehicle", "[slow]") { compare_j1634({"wheels=4", "variant=source"}); }

TEST_CASE("they agree on coastdowns, on the road and on rollers", "[fast]") {
  for (const char* wheels : {"wheels=1", "wheels=4"}) {
    INFO(wheels);
    compare_coastdown({wheels, "warm_up_min=10"}, "dyno_1m2");
    compare_coastdown({wheels, "warm_up_min=10"}, "road");
  }
  compare_coastdown({"warm_up_min=10", "slope_percent=0.2", "wind_m_s=3"}, "road");
}

TEST_CASE("with every effect on at once the multi-cycle test runs, its audits close, and the fidelities agree",
          "[slow]") {
  for (const char* quarter : {"front", "rear"}) {
    std::vector<std::string> settings{"wheels=1", "variant=source", std::string("quarter=") + quarter};
    for (const models::Effect* effect : models::all_effects()) {
      if (!effect->info.acts_on(tests::kDyno->traits)) continue;
      const auto& size = effect->info.parameters[0];
      settings.push_back(fmt::format("effects.{}.{}={}", effect->info.id, size.key, size.prior.center()));
    }
    INFO(quarter);
    Pair pair;
    REQUIRE_NOTHROW(pair = run_both("sae_j1634", settings));
    compare_liners(pair);
    // A tire that slips lets its wheel spin up and down at every knot, which the quasi-static vehicle leaves out.
    compare_sections(pair, 5e-4);
  }
}

TEST_CASE("they agree on the dynamometer's setting", "[slow]") {
  const Pair pair = run_both("dyno_setting", {"wheels=1"});
  compare_liners(pair);
  // B may be near zero: what a coefficient may differ by is a force at 100 km/h.
  constexpr double kForce_N = 0.05;
  for (const auto& [key, at_100_km_h] :
       {std::pair("set_A_N", 1.0), {"set_B_N_per_km_h", 100.0}, {"set_C_N_per_km_h2", 10000.0}}) {
    INFO(key);
    CHECK(pair.multibody.result[key].get<double>() ==
          Approx(pair.quasi_static.result[key].get<double>()).epsilon(2e-3).margin(kForce_N / at_100_km_h));
  }
  CHECK(tests::number(pair.multibody, "highway_rr_energy_Wh") ==
        Approx(tests::number(pair.quasi_static, "highway_rr_energy_Wh")).epsilon(1e-4));
}
