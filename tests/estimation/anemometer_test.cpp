#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "estimation/road_load/road_load_procedure.h"
#include "sim/core/units.h"
#include "tests/support/procedure_study.h"

using namespace rollrig;
using namespace rollrig::estimation;
using Catch::Contains;
using tests::ProcedureStudy;
using tests::simulate_procedure;

namespace {

constexpr double kDeg = 0.017453292519943295;

ProcedureStudy make_calm_study() {
  ProcedureStudy study;
  study.reference_pressure_Pa = 98.21e3;
  study.ambient_pressure_Pa = 98.21e3;
  study.noise_sd_m_s = 0.0;
  study.air_noise_m_s = 0.0;
  study.pairs = 5;
  return study;
}

RoadLoadProcedure evaluate_study(const ProcedureStudy& study, RoadLoadProcedureKind kind, int yaw_degree = 2) {
  const tests::SimulatedProcedure simulated = simulate_procedure(study, 1);
  RoadLoadProcedureOptions options;
  options.kind = kind;
  options.mass_kg = simulated.mass_kg;
  options.rotating_mass_kg = study.rotating_mass_kg;
  options.yaw_degree = yaw_degree;
  return evaluate_traces(simulated.file, options);
}

double find_further(const RoadLoadProcedure& procedure, const std::string& key) {
  for (const FurtherCoefficient& at : procedure.further) {
    if (at.key == key) return at.value;
  }
  return std::nan("");
}

bool has_warning_of(const RoadLoadProcedure& procedure, const std::string& text) {
  for (const std::string& warning : procedure.warnings) {
    if (warning.find(text) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("air flow at the vehicle: the worked example of 40 CFR 1037.528", "[fast]") {
  // (g)(2)(i) and (3)(i): wind of 7.1 mph at 47 deg, vehicle at 64.9 mph: 69.93 mph and 4.26 deg
  const double against = 7.1 * std::cos(47.0 * kDeg);
  const double across = 7.1 * std::sin(47.0 * kDeg);
  const AirFlow air = calc_air_flow(64.9 * kMph_m_s, against * kMph_m_s, across * kMph_m_s);
  // 0.05 mph of each rounded speed, 0.005 mph of the result
  CHECK(air.speed_m_s / kMph_m_s == Approx(69.93).margin(0.05 + 0.05 * std::cos(47.0 * kDeg) + 0.005));
  CHECK(air.yaw_rad / kDeg == Approx(4.26).margin(0.005));
  // a tail wind of the same size on the way back
  CHECK(calc_air_flow(30.0, -5.0, 0.0).speed_m_s == Approx(25.0));
}

TEST_CASE("force of a coastdown on a slope: the worked example of 40 CFR 1037.528", "[fast]") {
  // (h)(4): 17129 kg effective, 31.28 to 26.77 m/s from 3.05 to 19.11 s, 16108 kg, up 0.503 m over 482.4 m: 4645.5 N
  const double force_N =
      calc_coastdown_force_N(17129.0, 31.28 - 26.77, 19.11 - 3.05, 16108.0, (0.547 - 0.044) / (697.8 - 215.4));
  CHECK(force_N == Approx(4645.5).margin(0.05));
}

TEST_CASE("SAE J2263: a known road load is found in wind that changes, with drag that depends on yaw", "[fast]") {
  ProcedureStudy study = make_calm_study();
  study.on_board = true;
  study.wind_m_s = 3.0;
  study.crosswind_m_s = 2.5;
  study.gust_sd_m_s = 1.0;
  study.yaw_drag_per_rad2 = 4.0;
  study.slope = 0.002;
  study.ambient_K = 283.15;
  study.ambient_pressure_Pa = 95e3;
  const RoadLoadProcedure procedure = evaluate_study(study, RoadLoadProcedureKind::kJ2263);
  CHECK(procedure.road_load(0) == Approx(130.0).epsilon(0.01));
  CHECK(procedure.road_load(1) / 3.6 == Approx(0.6).epsilon(0.03));
  CHECK(procedure.road_load(2) / 12.96 == Approx(0.031).epsilon(0.005));
  // drag area at no yaw: 2 C/rho at 20 degC and 98.21 kPa; of the square of yaw four times that
  const double area_m2 = 2.0 * 0.031 * 12.96 / (98210.0 / (287.058 * 293.15));
  CHECK(find_further(procedure, "drag_area_m2") == Approx(area_m2).epsilon(0.005));
  CHECK(find_further(procedure, "drag_area_m2_per_rad2") == Approx(4.0 * area_m2).epsilon(0.1));
  CHECK(std::isnan(find_further(procedure, "slope")));
  // a drag that does not depend on yaw takes what the crosswind adds for drag
  CHECK(evaluate_study(study, RoadLoadProcedureKind::kJ2263, 0).road_load(2) / 12.96 > 0.0311);
}

TEST_CASE("SAE J2263: a slope that was not measured is found from the headings", "[fast]") {
  ProcedureStudy study = make_calm_study();
  study.on_board = true;
  study.slope = 0.003;
  study.slope_known = false;
  const RoadLoadProcedure procedure = evaluate_study(study, RoadLoadProcedureKind::kJ2263, 0);
  CHECK(find_further(procedure, "slope") == Approx(0.003).epsilon(0.01));
  CHECK(procedure.road_load(0) == Approx(130.0).epsilon(0.01));
}

TEST_CASE("SAE J2263: an anemometer that reads wrongly is corrected by the wind beside the road, or doubted",
          "[fast]") {
  ProcedureStudy study = make_calm_study();
  study.on_board = true;
  study.wind_m_s = 1.0;
  tests::SimulatedProcedure simulated = simulate_procedure(study, 1);
  for (CoastdownRun& run : simulated.file.data.runs) {
    for (double& speed : run.conditions.air_speed_m_s) speed = 0.2 + 0.95 * speed;
  }
  RoadLoadProcedureOptions options;
  options.kind = RoadLoadProcedureKind::kJ2263;
  options.mass_kg = study.mass_kg;
  options.rotating_mass_kg = study.rotating_mass_kg;
  const RoadLoadProcedure doubted = evaluate_traces(simulated.file, options);
  CHECK(has_warning_of(doubted, "off the speed on average of both headings"));
  CHECK(doubted.road_load(2) / 12.96 > 0.033);
  for (CoastdownRun& run : simulated.file.data.runs) {
    run.conditions.wind_m_s.assign(run.time_s.size(), 1.0);
    run.conditions.crosswind_m_s.assign(run.time_s.size(), 0.0);
  }
  const RoadLoadProcedure corrected = evaluate_traces(simulated.file, options);
  CHECK(corrected.road_load(2) / 12.96 == Approx(0.031).epsilon(0.005));
  CHECK(corrected.road_load(0) == Approx(130.0).epsilon(0.01));
}

TEST_CASE("SAE J1263: two coefficients, with the mean wind", "[fast]") {
  ProcedureStudy study = make_calm_study();
  study.load.B_N_s_per_m = 0.0;
  study.wind_m_s = 3.0;
  study.ambient_K = 298.15;
  const RoadLoadProcedure procedure = evaluate_study(study, RoadLoadProcedureKind::kJ1263);
  CHECK(procedure.road_load(0) == Approx(130.0).epsilon(0.01));
  CHECK(procedure.road_load(1) == 0.0);
  CHECK(procedure.road_load(2) / 12.96 == Approx(0.031).epsilon(0.005));
}

TEST_CASE("SAE J1263: where the loss has a part in proportion to speed, two coefficients stand for it", "[fast]") {
  // A + B v + C v^2 over even speeds from 10 to 140 km/h, by the line a + c v^2 nearest to it
  ProcedureStudy study = make_calm_study();
  study.noise_sd_m_s = 0.02;
  study.run_force_sd_N = 2.0;
  REQUIRE(study.load.B_N_s_per_m > 2.0);
  const RoadLoadProcedure procedure = evaluate_study(study, RoadLoadProcedureKind::kJ1263);
  double worst = 0.0;
  double sum_N = 0.0;
  int count = 0;
  for (double km_h = 20.0; km_h <= 130.0; km_h += 10.0, ++count) {
    const double v = km_h / 3.6;
    const double truth_N = study.load.A_N + v * (study.load.B_N_s_per_m + v * study.load.C_N_s2_per_m2);
    worst = std::max(worst, std::abs(procedure.force_N(v) / truth_N - 1.0));
    sum_N += procedure.force_N(v) - truth_N;
  }
  CHECK(worst < 0.06);                   // two coefficients do not follow three everywhere
  CHECK(std::abs(sum_N / count) < 5.0);  // but lie amid them
}

TEST_CASE("SAE J2263: what is wrong with a test is said", "[fast]") {
  ProcedureStudy study = make_calm_study();
  study.pairs = 3;
  study.on_board = true;
  tests::SimulatedProcedure simulated = simulate_procedure(study, 1);
  RoadLoadProcedureOptions options;
  options.kind = RoadLoadProcedureKind::kJ2263;
  options.mass_kg = study.mass_kg;
  auto& runs = simulated.file.data.runs;
  SECTION("two pairs") {
    runs.resize(4);
    CHECK_THROWS_WITH(evaluate_traces(simulated.file, options), Contains("fewer than 3 pairs"));
  }
  SECTION("one heading") {
    for (CoastdownRun& run : runs) run.heading = 1;
    CHECK_THROWS_WITH(evaluate_traces(simulated.file, options), Contains("same heading"));
  }
  SECTION("no air speed and no wind") {
    for (CoastdownRun& run : runs) run.conditions.air_speed_m_s.clear();
    CHECK_THROWS_WITH(evaluate_traces(simulated.file, options), Contains("no air speed"));
  }
  SECTION("bins") {
    for (CoastdownRun& run : runs) run.bins.push_back({20.0, 18.0, 5.0});
    CHECK_THROWS_WITH(evaluate_traces(simulated.file, options), Contains("needs speed traces"));
  }
  SECTION("air speeds in mph, and in m/s") {
    for (const double factor : {1.0 / 1.609344, 1.609344 / 3.6}) {  // the second one after the first
      for (CoastdownRun& run : runs) {
        for (double& speed : run.conditions.air_speed_m_s) speed *= factor;
      }
      CHECK_THROWS_WITH(evaluate_traces(simulated.file, options),
                        Contains(factor > 0.5 ? "air_speed_km_h looks as if it were in mph"
                                              : "air_speed_km_h looks as if it were in m/s") &&
                            Contains("speed_km_h is"));
    }
  }
  SECTION("vehicle speeds in mph") {
    for (CoastdownRun& run : runs) {
      for (double& speed : run.speed_m_s) speed /= 1.609344;
    }
    CHECK_THROWS_WITH(evaluate_traces(simulated.file, options), Contains("; speed_km_h looks as if it were in mph"));
  }
  SECTION("runs of one heading too short") {
    for (CoastdownRun& run : runs) {
      if (run.heading > 0) continue;
      for (double& time : run.time_s) time *= 0.05;
    }
    CHECK_THROWS_WITH(evaluate_traces(simulated.file, options), Contains("no run of the heading - is long enough"));
  }
  SECTION("a gale") {
    study.wind_m_s = 9.0;
    simulated = simulate_procedure(study, 1);
    CHECK_THROWS_WITH(evaluate_traces(simulated.file, options), Contains("within the limits of the wind: 0"));
  }
}

TEST_CASE("SAE J2263: a yaw that was not measured is said, and no crosswind passes", "[fast]") {
  ProcedureStudy study = make_calm_study();
  study.on_board = true;
  study.crosswind_m_s = 2.0;
  tests::SimulatedProcedure simulated = simulate_procedure(study, 1);
  for (CoastdownRun& run : simulated.file.data.runs) run.conditions.yaw_rad.clear();
  RoadLoadProcedureOptions options;
  options.kind = RoadLoadProcedureKind::kJ2263;
  options.mass_kg = study.mass_kg;
  const RoadLoadProcedure procedure = evaluate_traces(simulated.file, options);
  CHECK(has_warning_of(procedure, "no column yaw_deg: the yaw angle was not measured"));
  CHECK_FALSE(has_warning_of(procedure, "stays below 1 deg"));
  for (const RoadLoadCheck& check : procedure.checks) {
    if (check.name != "crosswind, mean of a run") continue;
    CHECK(check.status == CheckStatus::kNotChecked);
    CHECK(check.found == "no column yaw_deg");
  }
}

TEST_CASE("SAE J2263: a vane that is off, or in rad, is doubted", "[fast]") {
  ProcedureStudy study = make_calm_study();
  study.on_board = true;
  study.wind_m_s = 1.0;
  study.crosswind_m_s = 2.0;
  study.air_noise_m_s = 0.1;
  RoadLoadProcedureOptions options;
  options.kind = RoadLoadProcedureKind::kJ2263;
  options.mass_kg = study.mass_kg;
  const auto evaluate_yaw = [&](double factor, double offset_rad) {
    tests::SimulatedProcedure simulated = simulate_procedure(study, 1);
    for (CoastdownRun& run : simulated.file.data.runs) {
      for (double& yaw_rad : run.conditions.yaw_rad) yaw_rad = factor * yaw_rad + offset_rad;
    }
    return evaluate_traces(simulated.file, options);
  };
  const RoadLoadProcedure right = evaluate_yaw(1.0, 0.0);
  CHECK_FALSE(has_warning_of(right, "yaw_deg"));
  CHECK(has_warning_of(evaluate_yaw(1.0, 5.0 * kDeg), "deg on average of both headings"));
  CHECK(has_warning_of(evaluate_yaw(kDeg, 0.0), "Are the angles in rad?"));
}
