#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

#include "estimation/road_load/road_load_procedure.h"
#include "tests/support/fit_study.h"
#include "tests/support/procedure_study.h"

using namespace rollrig;
using namespace rollrig::estimation;
using tests::ProcedureStudy;

namespace {

struct ProcedureCoverage {
  std::array<int, 3> within{};
  std::array<double, 3> width{};
  int runs = 0;
};

/// How many intervals of 95 % contain the truth.
ProcedureCoverage count_procedure_coverage(const ProcedureStudy& study, RoadLoadProcedureOptions options, int seeds) {
  ProcedureCoverage coverage;
  const std::array<double, 3> truth{study.load.A_N, study.load.B_N_s_per_m, study.load.C_N_s2_per_m2};
  for (int seed = 1; seed <= seeds; ++seed) {
    const tests::SimulatedProcedure simulated = tests::simulate_procedure(study, static_cast<std::uint64_t>(seed));
    options.mass_kg = simulated.mass_kg;
    options.rotating_mass_kg = study.rotating_mass_kg;
    const RoadLoadProcedure procedure = options.kind == RoadLoadProcedureKind::kWltp
                                            ? evaluate_wltp_coastdowns(simulated.file, options)
                                            : evaluate_traces(simulated.file, options);
    ++coverage.runs;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::array<double, 2> interval = procedure.interval_95(static_cast<int>(i));
      coverage.within[i] += truth[i] >= interval[0] && truth[i] <= interval[1] ? 1 : 0;
      coverage.width[i] += (interval[1] - interval[0]) / seeds;
    }
  }
  std::printf("  f0, f1, f2 within: %d, %d, %d of %d; widths %.3g N, %.3g N/(km/h), %.3g N/(km/h)2\n",
              coverage.within[0], coverage.within[1], coverage.within[2], coverage.runs, coverage.width[0],
              coverage.width[1] / 3.6, coverage.width[2] / 12.96);
  return coverage;
}

/// Wind, gusts, a slope, and forces that change from run to run.
ProcedureStudy make_windy_study() {
  ProcedureStudy study;
  study.wind_m_s = 1.5;
  study.crosswind_m_s = 0.8;
  study.gust_sd_m_s = 0.4;
  study.slope = 0.001;
  study.run_force_sd_N = 3.0;
  study.ambient_K = 288.15;
  study.ambient_pressure_Pa = 98e3;
  study.interval_s = 0.2;
  return study;
}

constexpr int kProcedureSeeds = 300;

/// 95 % of the simulated procedures, within three standard deviations of a binomial.
void require_procedure_coverage(const ProcedureCoverage& coverage) {
  for (const int within : coverage.within) {
    CHECK(within >= 0.95 * coverage.runs - 3.0 * 0.218 * std::sqrt(coverage.runs));
    CHECK(within <= 0.95 * coverage.runs + 3.0 * 0.218 * std::sqrt(coverage.runs));
  }
}

}  // namespace

TEST_CASE("procedures: 95 % intervals of the WLTP coastdown contain the road load, whole runs", "[slow]") {
  RoadLoadProcedureOptions options;
  options.sensor_accuracy = false;
  ProcedureStudy study = make_windy_study();
  study.crosswind_m_s = 0.0;  // the procedure does not correct for it
  std::printf("WLTP, six pairs:\n");
  require_procedure_coverage(count_procedure_coverage(study, options, kProcedureSeeds));
}

TEST_CASE("procedures: 95 % intervals of the WLTP coastdown contain the road load, split runs", "[slow]") {
  RoadLoadProcedureOptions options;
  options.sensor_accuracy = false;
  ProcedureStudy study = make_windy_study();
  study.crosswind_m_s = 0.0;
  study.split_km_h = 60.0;
  std::printf("WLTP, six pairs, split runs:\n");
  require_procedure_coverage(count_procedure_coverage(study, options, kProcedureSeeds));
}

TEST_CASE("procedures: 95 % intervals of the WLTP coastdown contain the road load, runs that begin at 135 +- 1 km/h",
          "[slow]") {
  RoadLoadProcedureOptions options;
  options.sensor_accuracy = false;
  ProcedureStudy study = make_windy_study();
  study.crosswind_m_s = 0.0;
  study.from_km_h = 135.0;
  study.from_scatter_km_h = 1.0;
  for (const double split_km_h : {0.0, 60.0}) {
    study.split_km_h = split_km_h;
    std::printf("WLTP, six pairs from 135 +- 1 km/h%s:\n", split_km_h > 0.0 ? ", split runs" : "");
    require_procedure_coverage(count_procedure_coverage(study, options, kProcedureSeeds));
  }
}

TEST_CASE("procedures: 95 % intervals of the WLTP coastdown with sensors that are off", "[slow]") {
  ProcedureStudy study = make_windy_study();
  study.crosswind_m_s = 0.0;
  study.sensors_off = true;
  std::printf("WLTP, six pairs, sensors within their accuracy:\n");
  const ProcedureCoverage coverage = count_procedure_coverage(study, {}, kProcedureSeeds);
  for (const int within : coverage.within) CHECK(within >= 0.92 * coverage.runs);
}

TEST_CASE("procedures: 95 % intervals of SAE J2263 contain the road load", "[slow]") {
  RoadLoadProcedureOptions options;
  options.kind = RoadLoadProcedureKind::kJ2263;
  options.sensor_accuracy = false;
  ProcedureStudy study = make_windy_study();
  study.reference_pressure_Pa = 98.21e3;
  study.on_board = true;
  study.gust_sd_m_s = 0.8;
  study.crosswind_m_s = 2.0;
  study.yaw_drag_per_rad2 = 3.0;
  std::printf("SAE J2263, six pairs, gusts of 0.8 m/s:\n");
  require_procedure_coverage(count_procedure_coverage(study, options, tests::count_seeds(kProcedureSeeds)));
}
