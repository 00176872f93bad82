// The shipped drive cycles, by what is published of each; and the scenario that drives one of them.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "scenarios/common/speed_trace.h"
#include "scenarios/common/vehicle_bench.h"
#include "sim/core/assets.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/temporary_folder.h"

using namespace rollrig;
using scenarios::read_speed_trace;
using scenarios::SpeedTrace;

namespace {

constexpr double kMile = 1609.344;

double fastest_m_s(const SpeedTrace& trace) {
  return *std::max_element(trace.speed_m_s.begin(), trace.speed_m_s.end());
}

double distance_m(const SpeedTrace& trace) { return scenarios::calc_distance_m(trace.time_s, trace.speed_m_s); }

/// Rows a second apart, from standstill to standstill.
void require_second_by_second(const SpeedTrace& trace) {
  for (std::size_t i = 0; i < trace.time_s.size(); ++i) REQUIRE(trace.time_s[i] == static_cast<double>(i));
  REQUIRE(trace.speed_m_s.front() == 0.0);
  REQUIRE(trace.speed_m_s.back() == 0.0);
}

/// Energy against A + B v + C v^2 over a trace of straight lines, by Simpson's rule, which is exact for the cubic.
double calc_road_load_J(const SpeedTrace& trace, const models::RoadLoad<double>& load) {
  const auto power_W = [&load](double v) { return models::calc_road_load_N(load, v) * v; };
  double energy_J = 0.0;
  for (std::size_t i = 1; i < trace.time_s.size(); ++i) {
    const double a = trace.speed_m_s[i - 1];
    const double b = trace.speed_m_s[i];
    energy_J +=
        (trace.time_s[i] - trace.time_s[i - 1]) / 6.0 * (power_W(a) + 4.0 * power_W(0.5 * (a + b)) + power_W(b));
  }
  return energy_J;
}

scenarios::RunSpec make_road_spec(const std::vector<std::string>& settings) {
  scenarios::RunSpec spec = tests::make_spec("drive_cycle", "a50", settings, "quasi_static");
  spec.rig = rigs::read_rig(read_config(find_asset("rigs", "road")));
  spec.vehicle = rigs::read_vehicle(read_config(find_asset("vehicles", "volvo_ex30")));
  return spec;
}

}  // namespace

TEST_CASE("US cycles have the duration, distance and top speed that EPA publishes", "[fast]") {
  struct Published {
    const char* name;
    double duration_s;
    double miles;
    double top_mph;
  };
  // EPA, dynamometer drive schedules: UDDS 1369 s, 7.45 mi; HWFET 765 s, 10.26 mi; US06 596 s, 8.01 mi, 80.3 mph.
  for (const Published& published : {Published{"udds", 1369.0, 7.45, 56.7}, Published{"hwfet", 765.0, 10.26, 59.9},
                                     Published{"us06", 596.0, 8.01, 80.3}}) {
    INFO(published.name);
    const SpeedTrace trace = read_speed_trace(published.name);
    require_second_by_second(trace);
    CHECK(trace.duration_s() >= published.duration_s);
    for (std::size_t i = 0; i < trace.time_s.size(); ++i) {  // the table of US06 ends with seconds of standstill
      if (trace.time_s[i] > published.duration_s) CHECK(trace.speed_m_s[i] == 0.0);
    }
    CHECK(distance_m(trace) / kMile == Approx(published.miles).margin(0.005));
    CHECK(fastest_m_s(trace) * 3600.0 / kMile == Approx(published.top_mph).margin(0.05));
  }
  CHECK(read_speed_trace("udds").duration_s() == 1369.0);
  CHECK(read_speed_trace("hwfet").duration_s() == 765.0);
  CHECK(read_speed_trace("us06").duration_s() == 600.0);
}

TEST_CASE("WLTC class 3b: its phases have the check sums, lengths and top speeds of the regulation", "[fast]") {
  const SpeedTrace trace = read_speed_trace("wltc_class3b");
  require_second_by_second(trace);
  CHECK(trace.duration_s() == 1800.0);
  CHECK(distance_m(trace) == Approx(23266.0).margin(0.5));
  struct Phase {
    std::size_t first_s;
    std::size_t end_s;
    double sum_km_h;
    double top_km_h;
    double length_m;
  };
  // UN GTR 15, Annex 1: sums of the speeds of low, medium 3-2, high 3-2 and extra high.
  for (const Phase& phase : {Phase{0, 590, 11140.3, 56.5, 3095.0}, Phase{590, 1023, 17121.2, 76.6, 4756.0},
                             Phase{1023, 1478, 25782.2, 97.4, 7162.0}, Phase{1478, 1801, 29714.9, 131.3, 8254.0}}) {
    INFO(phase.first_s);
    const auto begin = trace.speed_m_s.begin() + static_cast<std::ptrdiff_t>(phase.first_s);
    const auto end = trace.speed_m_s.begin() + static_cast<std::ptrdiff_t>(phase.end_s);
    const double sum_m = std::accumulate(begin, end, 0.0);  // a second each
    CHECK(3.6 * sum_m == Approx(phase.sum_km_h).margin(0.01));
    CHECK(sum_m == Approx(phase.length_m).margin(0.6));
    CHECK(3.6 * *std::max_element(begin, end) == Approx(phase.top_km_h).margin(0.01));
    CHECK(*begin == 0.0);
  }
}

TEST_CASE("a cycle whose times are in minutes or milliseconds is doubted, the shipped ones are not", "[fast]") {
  for (const char* name : {"udds", "hwfet", "us06", "wltc_class3b"}) {
    INFO(name);
    SpeedTrace trace = read_speed_trace(name);
    CHECK_FALSE(scenarios::doubt_acceleration(trace).has_value());
    CHECK_FALSE(scenarios::doubt_slowness(trace).has_value());
    SpeedTrace in_ms = trace;
    for (double& time_s : in_ms.time_s) time_s *= 1000.0;
    CHECK_THAT(scenarios::doubt_slowness(in_ms).value_or(""), Catch::Contains("not in ms?"));
    for (double& time_s : trace.time_s) time_s /= 60.0;
    CHECK(scenarios::doubt_acceleration(trace).has_value());
  }
}

TEST_CASE("a charge that equals the usable energy is doubted after a drive cycle, too", "[fast]") {
  scenarios::RunSpec spec = make_road_spec({"cycle=us06"});
  const auto is_doubted = [&spec] {
    const scenarios::Outcome outcome = scenarios::run_scenario(spec, {});
    return std::any_of(outcome.warnings.begin(), outcome.warnings.end(), [](const std::string& warning) {
      return warning.find("of its recharge energy") != std::string::npos;
    });
  };
  CHECK_FALSE(is_doubted());
  spec.vehicle->battery->recharge_J = spec.vehicle->battery->usable_J;
  CHECK(is_doubted());
}

TEST_CASE("where little moves and much starts and stops, energies close by tighter tolerances", "[slow]") {
  const tests::TemporaryFolder folder;
  std::string jam = "time_s,speed_km_h\n0,0\n";
  for (int i = 0; i < 10; ++i) {  // from 0 to 5 km/h and back
    for (const auto& [after_s, speed_km_h] : {std::pair(1, 0), {3, 5}, {4, 5}, {6, 0}}) {
      jam += fmt::format("{},{}\n", 10 * i + after_s, speed_km_h);
    }
  }
  tests::write_file(folder.file("jam.csv"), jam);
  for (const char* rig : {"dyno_1m2", "road"}) {
    scenarios::RunSpec spec = tests::make_spec("drive_cycle", "a50", {"cycle=" + folder.file("jam.csv")}, "multibody");
    spec.rig = rigs::read_rig(read_config(find_asset("rigs", rig)));
    INFO(rig);
    const scenarios::Outcome outcome = scenarios::run_scenario(spec, {});
    CHECK(outcome.recording.audit.is_closed(scenarios::kDriveAuditLimit));
  }
}

TEST_CASE("a cycle that never moves is refused", "[fast]") {
  const tests::TemporaryFolder folder;
  tests::write_file(folder.file("still.csv"), "time_s,speed_km_h\n0,0\n60,0\n");
  CHECK_THROWS_WITH(read_speed_trace(folder.file("still.csv")), Catch::Contains("a cycle that never moves"));
}

TEST_CASE("without friction brakes the hubs give what the road load takes over the cycle", "[fast]") {
  for (const char* cycle : {"wltc_class3b", "us06"}) {
    INFO(cycle);
    scenarios::RunSpec spec = make_road_spec({std::string("cycle=") + cycle});
    spec.vehicle->powertrain.regeneration_limit_m_s2 = 10.0;
    spec.vehicle->powertrain.regeneration_fade_m_s = 0.001;
    const scenarios::Outcome outcome = scenarios::run_scenario(spec, {});
    const SpeedTrace trace = read_speed_trace(cycle);
    const Json& section = outcome.result["sections"][0];
    const double net_J = 3600.0 * (section["wheel_energy_Wh"].get<double>() - section["recuperated_Wh"].get<double>());
    CHECK(net_J == Approx(calc_road_load_J(trace, *spec.vehicle->road_load)).epsilon(1e-3));
    CHECK(1e3 * section["distance_km"].get<double>() == Approx(distance_m(trace)).epsilon(1e-6));
    CHECK(outcome.result["cycle"] == cycle);
    const double consumption_Wh_per_km = tests::number(outcome, "consumption_Wh_per_km");
    CHECK(tests::number(outcome, "range_km") == Approx(67198.7 / consumption_Wh_per_km));
    CHECK(tests::number(outcome, "ac_consumption_Wh_per_km") == Approx(consumption_Wh_per_km * 75.559 / 67.1987));
  }
}

TEST_CASE("a cycle that is driven again takes less while the tires warm up", "[fast]") {
  const scenarios::Outcome outcome = tests::run("drive_cycle", "a50", {"cycle=wltc_class3b", "repetitions=3"});
  const Json& sections = outcome.result["sections"];
  REQUIRE(sections.size() == 3);
  const auto consumption = [&sections](std::size_t i) { return sections[i]["consumption_Wh_per_km"].get<double>(); };
  CHECK(consumption(0) > 1.01 * consumption(1));
  CHECK(consumption(1) > consumption(2));
  CHECK(sections[0]["vehicle_rr_energy_Wh"].get<double>() > sections[1]["vehicle_rr_energy_Wh"].get<double>());
  // source_car has no [battery]: the mean of the cycles, and no range.
  CHECK(tests::number(outcome, "consumption_Wh_per_km") ==
        Approx((consumption(0) + consumption(1) + consumption(2)) / 3.0));
  CHECK_FALSE(outcome.result.contains("range_km"));
}

TEST_CASE("an unknown cycle is refused with the nearest name, and a battery that cycles empty with its need",
          "[fast]") {
  CHECK_THROWS_WITH(tests::run("drive_cycle", "a50", {"cycle=wltc_class3"}), Catch::Contains("wltc_class3b"));
  scenarios::RunSpec spec = make_road_spec({"repetitions=2"});
  spec.vehicle->battery->usable_J = 3.6e6;
  CHECK_THROWS_WITH(scenarios::run_scenario(spec, {}),
                    Catch::Contains("usable_energy_kWh") && Catch::Contains("fewer repetitions"));
}

TEST_CASE("a hole in a cycle of equal intervals is doubted, a cycle of vertices is not", "[fast]") {
  for (const char* name : {"udds", "hwfet", "us06", "wltc_class3b"}) {
    INFO(name);
    SpeedTrace trace = read_speed_trace(name);
    CHECK(scenarios::doubt_trace(trace).empty());
    for (auto* values : {&trace.time_s, &trace.speed_m_s}) values->erase(values->begin() + 200, values->begin() + 400);
    REQUIRE(scenarios::doubt_hole(trace).has_value());
    CHECK_THAT(*scenarios::doubt_hole(trace), Catch::Contains("none for 201 s after time_s = 199"));
  }
  const SpeedTrace vertices{"vertices", {0.0, 11.0, 15.0, 23.0, 25.0, 28.0, 49.0, 300.0}, std::vector<double>(8, 10.0)};
  CHECK(scenarios::doubt_trace(vertices).empty());
}
