#include <catch2/catch.hpp>
#include <cmath>

#include "build_paths.h"
#include "estimation/road_load/road_load_procedure.h"
#include "sim/core/units.h"
#include "tests/support/procedure_study.h"

using namespace rollrig;
using namespace rollrig::estimation;
using Catch::Contains;
using tests::ProcedureStudy;
using tests::simulate_procedure;

namespace {

RoadLoadProcedureOptions make_wltp_options(double mass_kg) {
  RoadLoadProcedureOptions options;
  options.kind = RoadLoadProcedureKind::kWltp;
  options.mass_kg = mass_kg;
  return options;
}

RoadLoadProcedure evaluate_wltp(const ProcedureStudy& study, RoadLoadProcedureOptions options = {}) {
  const tests::SimulatedProcedure simulated = simulate_procedure(study, 1);
  options.mass_kg = options.mass_kg.value_or(simulated.mass_kg);
  options.rotating_mass_kg = study.rotating_mass_kg;
  return evaluate_wltp_coastdowns(simulated.file, options);
}

/// A study without noise.
ProcedureStudy make_quiet_study() {
  ProcedureStudy study;
  study.noise_sd_m_s = 0.0;
  study.pairs = 3;
  return study;
}

bool has_warning(const RoadLoadProcedure& procedure, const std::string& text) {
  for (const std::string& warning : procedure.warnings) {
    if (warning.find(text) != std::string::npos) return true;
  }
  return false;
}

const RoadLoadCheck& find_check(const RoadLoadProcedure& procedure, const std::string& name) {
  for (const RoadLoadCheck& check : procedure.checks) {
    if (check.name == name) return check;
  }
  throw std::runtime_error("no check " + name);
}

}  // namespace

TEST_CASE("WLTP coastdown: the example of times through bins, by an independent evaluation", "[fast]") {
  // The expected numbers are those of a Python script of the equations of 4.3.1.4, written apart from the program
  // (statistics.harmonic_mean, statistics.stdev, normal equations), with 2203 kg and 3 %.
  const CoastdownFile file = read_coastdowns(ROLLRIG_SOURCE_DIR "/assets/examples/coastdown_bins.csv");
  const RoadLoadProcedure procedure = evaluate_wltp_coastdowns(file, make_wltp_options(2203.0));
  REQUIRE(procedure.reference.speeds.size() == 11);
  CHECK(procedure.reference.speeds.front() == 120);
  CHECK(procedure.as_tested(0) == Approx(70.6657).epsilon(1e-5));
  CHECK(procedure.as_tested(1) / 3.6 == Approx(0.521325).epsilon(1e-5));
  CHECK(procedure.as_tested(2) / 12.96 == Approx(0.0317380).epsilon(1e-5));
  CHECK(procedure.reference.resistances.front() == Approx(590.541).epsilon(1e-5));
  CHECK(procedure.reference.resistances.back() == Approx(93.213).epsilon(1e-5));
  CHECK(100.0 * procedure.reference.precisions.front().precision == Approx(0.5352).epsilon(1e-3));
  CHECK(100.0 * procedure.reference.precisions.back().precision == Approx(2.8468).epsilon(1e-3));
  // 50, 70 and 90 km/h are above 3 %
  CHECK(find_check(procedure, "statistical precision").status == CheckStatus::kFail);
  CHECK_THAT(find_check(procedure, "statistical precision").found, Contains("3.57 % at 90 km/h"));
  CHECK(has_warning(procedure, "more pairs are needed"));
  CHECK(has_warning(procedure, "ambient_pressure_kPa"));
}

TEST_CASE("WLTP coastdown: a known road load is found on a slope, in wind, in cold thin air", "[fast]") {
  ProcedureStudy study = make_quiet_study();
  study.wind_m_s = 2.5;
  study.slope = 0.003;
  study.ambient_K = 281.15;
  study.ambient_pressure_Pa = 94e3;
  const RoadLoadProcedure procedure = evaluate_wltp(study);
  // the force over 10 km/h is not quite that at the middle, which leaves some tenths of a newton
  CHECK(procedure.road_load(0) == Approx(130.0).margin(0.6));
  CHECK(procedure.road_load(1) == Approx(0.6 * 3.6).margin(0.05));
  CHECK(procedure.road_load(2) == Approx(0.031 * 12.96).epsilon(0.003));
  for (const double km_h : {20.0, 50.0, 80.0, 130.0}) {
    const double v = km_h / 3.6;
    CHECK(procedure.force_N(v) == Approx(130.0 + 2.16 * v + 0.40176 * v * v).epsilon(0.003));
  }
  CHECK(procedure.correction.wind_m_s == Approx(2.5));
  CHECK(find_check(procedure, "reference speeds").status == CheckStatus::kPass);
  CHECK(find_check(procedure, "wind, mean of a run").status == CheckStatus::kPass);
  // without the correction for the wind, f0 is higher by f2 w^2
  ProcedureStudy still = study;
  still.wind_m_s = 0.0;
  CHECK(procedure.as_tested(0) - evaluate_wltp(still).as_tested(0) ==
        Approx(procedure.as_tested(2) * 6.25).epsilon(0.05));
}

TEST_CASE("WLTP coastdown: f0 is corrected to the test mass", "[fast]") {
  RoadLoadProcedureOptions options;
  options.corrected_to_mass_kg = 1665.0;  // 10 % less
  const RoadLoadProcedure procedure = evaluate_wltp(make_quiet_study(), options);
  CHECK(procedure.road_load(0) == Approx(0.9 * procedure.as_tested(0)));
  CHECK(procedure.road_load(2) == Approx(procedure.as_tested(2)));
}

TEST_CASE("WLTP coastdown: split runs give the same road load as whole runs", "[fast]") {
  ProcedureStudy study = make_quiet_study();
  const RoadLoadProcedure whole = evaluate_wltp(study);
  study.split_km_h = 60.0;  // the first part has 70 km/h and more, the second 70 km/h and less
  const RoadLoadProcedure split = evaluate_wltp(study);
  REQUIRE(split.reference.pairs.size() == 6);
  CHECK(split.reference.pairs.front().part == 0);
  CHECK(split.reference.pairs.back().part == 1);
  CHECK(split.reference.overlaps == std::vector<int>{70});
  CHECK(find_check(split, "split runs, force in common").status == CheckStatus::kPass);
  for (const double km_h : {20.0, 80.0, 130.0}) {
    CHECK(split.force_N(km_h / 3.6) == Approx(whole.force_N(km_h / 3.6)).epsilon(0.002));
  }
  study.split_km_h = 70.0;
  study.split_overlap_km_h = 15.0;  // 80 km/h is of the first part alone, 70 of the second
  const RoadLoadProcedure apart = evaluate_wltp(study);
  CHECK(find_check(apart, "split runs").status == CheckStatus::kFail);
  CHECK(has_warning(apart, "no reference speed in common"));
}

TEST_CASE("WLTP coastdown: runs that begin near the end of a bin are all used", "[fast]") {
  ProcedureStudy study = make_quiet_study();
  study.pairs = 5;
  study.from_km_h = 135.0;  // the bin of 130 km/h begins there
  study.from_scatter_km_h = 1.0;
  for (const double split_km_h : {0.0, 60.0}) {
    study.split_km_h = split_km_h;  // the second part begins at 80 +- 1 km/h, amid the bin of 80 km/h
    int without_130 = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      INFO("split at " << split_km_h << ", seed " << seed);
      const tests::SimulatedProcedure simulated = simulate_procedure(study, seed);
      const RoadLoadProcedure procedure = evaluate_wltp_coastdowns(simulated.file, make_wltp_options(study.mass_kg));
      CHECK(procedure.reference.list_used_runs().size() == simulated.file.data.runs.size());
      CHECK(procedure.reference.pairs.back().part == (split_km_h > 0.0 ? 1 : 0));
      CHECK_FALSE(has_warning(procedure, "opposite heading"));
      const bool has_130 = procedure.reference.speeds.front() == 130;
      without_130 += has_130 ? 0 : 1;
      CHECK(has_warning(procedure, "--speed-to 125 leaves that out") == !has_130);
      for (const double km_h : {20.0, 80.0, 120.0}) {
        const double v = km_h / 3.6;
        CHECK(procedure.force_N(v) == Approx(130.0 + 2.16 * v + 0.40176 * v * v).epsilon(0.003));
      }
    }
    CHECK(without_130 > 0);
    CHECK(without_130 < 20);
  }
}

TEST_CASE("WLTP coastdown: a pair that begins at 100 km/h counts below it", "[fast]") {
  ProcedureStudy study = make_quiet_study();
  tests::SimulatedProcedure simulated = simulate_procedure(study, 1);
  study.from_km_h = 100.0;
  study.pairs = 1;
  for (CoastdownRun run : simulate_procedure(study, 2).file.data.runs) {
    run.id = "late " + run.id;
    simulated.file.data.runs.push_back(run);
  }
  const RoadLoadProcedure procedure = evaluate_wltp_coastdowns(simulated.file, make_wltp_options(study.mass_kg));
  CHECK(procedure.warnings.empty());
  for (std::size_t i = 0; i < procedure.reference.speeds.size(); ++i) {
    CHECK(procedure.reference.precisions[i].pairs == (procedure.reference.speeds[i] > 90 ? 3 : 4));
  }
}

TEST_CASE("WLTP coastdown: times through bins and traces agree", "[fast]") {
  ProcedureStudy study = make_quiet_study();
  study.to_km_h = 14.0;
  const tests::SimulatedProcedure simulated = simulate_procedure(study, 1);
  CoastdownFile bins = simulated.file;
  for (CoastdownRun& run : bins.data.runs) {
    for (int edge = 135; edge > 15; edge -= 5) {
      const auto time_at = [&run](double km_h) {
        std::size_t i = 0;
        while (3.6 * run.speed_m_s[i] > km_h) ++i;
        const double share = (run.speed_m_s[i - 1] - km_h / 3.6) / (run.speed_m_s[i - 1] - run.speed_m_s[i]);
        return run.time_s[i - 1] + share * (run.time_s[i] - run.time_s[i - 1]);
      };
      run.bins.push_back({edge / 3.6, (edge - 5) / 3.6, time_at(edge - 5) - time_at(edge)});
    }
  }
  const RoadLoadProcedure of_traces = evaluate_wltp_coastdowns(simulated.file, make_wltp_options(study.mass_kg));
  const RoadLoadProcedure of_bins = evaluate_wltp_coastdowns(bins, make_wltp_options(study.mass_kg));
  REQUIRE(of_bins.reference.speeds == of_traces.reference.speeds);
  for (std::size_t i = 0; i < of_bins.reference.speeds.size(); ++i) {
    CHECK(of_bins.reference.resistances[i] == Approx(of_traces.reference.resistances[i]).epsilon(5e-4));
  }
}

TEST_CASE("WLTP coastdown: what is wrong with a test is said", "[fast]") {
  const ProcedureStudy quiet = make_quiet_study();
  tests::SimulatedProcedure simulated = simulate_procedure(quiet, 1);
  RoadLoadProcedureOptions options = make_wltp_options(quiet.mass_kg);
  SECTION("no mass") {
    options.mass_kg.reset();
    CHECK_THROWS_WITH(evaluate_wltp_coastdowns(simulated.file, options), Contains("mass is missing"));
  }
  SECTION("two pairs") {
    simulated.file.data.runs.resize(4);
    CHECK_THROWS_WITH(evaluate_wltp_coastdowns(simulated.file, options), Contains("fewer than 3 pairs"));
  }
  SECTION("one heading") {
    for (CoastdownRun& run : simulated.file.data.runs) run.heading = -1;
    CHECK_THROWS_WITH(evaluate_wltp_coastdowns(simulated.file, options), Contains("same heading"));
  }
  SECTION("wind above the limit in one run") {
    for (double& wind : simulated.file.data.runs[2].conditions.wind_m_s) wind = 6.0;
    CHECK_THROWS_WITH(evaluate_wltp_coastdowns(simulated.file, options), Contains("rejected for their wind: 3"));
    ProcedureStudy study = quiet;
    study.pairs = 4;
    simulated = simulate_procedure(study, 1);
    for (double& wind : simulated.file.data.runs[2].conditions.crosswind_m_s) wind = 2.5;
    const RoadLoadProcedure procedure = evaluate_wltp_coastdowns(simulated.file, options);
    CHECK(has_warning(procedure, "runs 3 and 4 is rejected: wind of run 3"));
    CHECK(find_check(procedure, "crosswind, mean of a run").status == CheckStatus::kFail);
  }
  SECTION("speeds in mph") {
    for (CoastdownRun& run : simulated.file.data.runs) {
      for (double& speed : run.speed_m_s) speed /= 1.609344;
    }
    CHECK(has_warning(evaluate_wltp_coastdowns(simulated.file, options), "in mph and not in km/h"));
  }
  SECTION("bins between the reference speeds") {
    for (CoastdownRun& run : simulated.file.data.runs) {
      for (int edge = 130; edge > 20; edge -= 10) run.bins.push_back({edge / 3.6, (edge - 10) / 3.6, 5.0});
    }
    CHECK_THROWS_WITH(evaluate_wltp_coastdowns(simulated.file, options), Contains("no bins end at"));
  }
}

TEST_CASE("WLTP coastdown: sessions that differ are said to, those that do not are not", "[fast]") {
  ProcedureStudy study;
  study.pairs = 3;
  study.run_force_sd_N = 2.0;
  tests::SimulatedProcedure low = simulate_procedure(study, 1);
  const auto join = [&low, &study](double factor, double colder_K = 0.0) {
    ProcedureStudy other = study;
    other.ambient_K -= colder_K;
    other.load = {factor * study.load.A_N, factor * study.load.B_N_s_per_m, factor * study.load.C_N_s2_per_m2};
    CoastdownFile file = low.file;
    for (CoastdownRun run : simulate_procedure(other, 2).file.data.runs) {
      run.session = "pm";
      file.data.runs.push_back(run);
    }
    return evaluate_wltp_coastdowns(file, make_wltp_options(low.mass_kg));
  };
  CHECK(has_warning(join(1.2), "the sessions differ by a standard deviation of 1"));
  CHECK_FALSE(has_warning(join(1.2), "The air in session"));
  CHECK(has_warning(join(1.0, 15.0), "The air in session 'pm' was 15.0 K colder"));
  CHECK_FALSE(has_warning(join(1.0), "the sessions differ"));
}

TEST_CASE("WLTP coastdown: on a slope, a run that is missing is no difference of sessions", "[fast]") {
  ProcedureStudy study;
  study.pairs = 3;
  study.run_force_sd_N = 2.0;
  study.slope = 0.002;  // 36 N up and down, beside some 400 N
  study.slope_known = false;
  const tests::SimulatedProcedure first = simulate_procedure(study, 1);
  CoastdownFile file = first.file;
  bool is_missing = false;
  for (CoastdownRun run : simulate_procedure(study, 2).file.data.runs) {
    if (run.heading > 0 && !is_missing) {
      is_missing = true;
      continue;
    }
    run.session = "pm";
    file.data.runs.push_back(run);
  }
  REQUIRE(is_missing);
  CHECK_FALSE(has_warning(evaluate_wltp_coastdowns(file, make_wltp_options(first.mass_kg)), "the sessions differ"));
}

TEST_CASE("WLTP coastdown: a wind that was not measured is no wind of 0", "[fast]") {
  tests::SimulatedProcedure simulated = simulate_procedure(make_quiet_study(), 1);
  const RoadLoadProcedure measured = evaluate_wltp_coastdowns(simulated.file, make_wltp_options(1850.0));
  CHECK(measured.wind_m_s == 0.0);
  CHECK_THAT(find_check(measured, "ambient temperature").clause, Contains("UN GTR 15"));
  for (CoastdownRun& run : simulated.file.data.runs) run.conditions.wind_m_s.clear();
  CHECK_FALSE(evaluate_wltp_coastdowns(simulated.file, make_wltp_options(1850.0)).wind_m_s.has_value());
}

TEST_CASE("WLTP coastdown: speeds in m/s, which leave few reference speeds, are asked for their unit", "[fast]") {
  tests::SimulatedProcedure simulated = simulate_procedure(make_quiet_study(), 1);
  for (CoastdownRun& run : simulated.file.data.runs) {
    for (double& speed_m_s : run.speed_m_s) speed_m_s /= 3.6;
  }
  CHECK_THROWS_WITH(evaluate_wltp_coastdowns(simulated.file, make_wltp_options(1850.0)),
                    Contains("Are the speeds in m/s?"));
}

TEST_CASE("procedures: rejected runs and runs without a partner have no part in the correction", "[fast]") {
  ProcedureStudy study = make_quiet_study();
  study.pairs = 5;
  tests::SimulatedProcedure simulated = simulate_procedure(study, 1);
  const auto evaluate = [&study](const CoastdownFile& file, RoadLoadProcedureKind kind) {
    RoadLoadProcedureOptions options = make_wltp_options(study.mass_kg);
    options.kind = kind;
    return kind == RoadLoadProcedureKind::kWltp ? evaluate_wltp_coastdowns(file, options)
                                                : evaluate_traces(file, options);
  };
  CoastdownFile few = simulated.file;
  few.data.runs.resize(8);
  CoastdownFile windy = simulated.file;  // the last pair in a wind above the limits, and in hot thin air
  for (const std::size_t i : {8U, 9U}) {
    CoastdownConditions& at = windy.data.runs[i].conditions;
    for (double& wind_m_s : at.wind_m_s) wind_m_s = 9.0;
    for (double& ambient_K : at.ambient_K) ambient_K += 12.0;
    for (double& pressure_Pa : at.ambient_pressure_Pa) pressure_Pa -= 4e3;
  }
  CoastdownFile unpaired = windy;
  unpaired.data.runs.pop_back();
  for (double& wind_m_s : unpaired.data.runs[8].conditions.wind_m_s) wind_m_s = 0.0;
  for (const auto kind : {RoadLoadProcedureKind::kWltp, RoadLoadProcedureKind::kJ1263, RoadLoadProcedureKind::kJ2263}) {
    const RoadLoadProcedure wanted = evaluate(few, kind);
    for (const CoastdownFile& file : {windy, unpaired}) {
      const RoadLoadProcedure found = evaluate(file, kind);
      CHECK(*found.correction.ambient_K == Approx(*wanted.correction.ambient_K));
      CHECK(*found.correction.ambient_pressure_Pa == Approx(*wanted.correction.ambient_pressure_Pa));
      CHECK(*found.wind_m_s == Approx(*wanted.wind_m_s).margin(1e-12));
      CHECK(found.road_load(0) == Approx(wanted.road_load(0)).epsilon(1e-6));
      CHECK_FALSE(has_warning(found, "the air was at"));
    }
  }
}

TEST_CASE("WLTP coastdown: traces at 1 Hz keep the highest reference speeds", "[fast]") {
  ProcedureStudy study = make_quiet_study();
  study.interval_s = 1.0;
  study.mass_kg = 1000.0;  // slows down by 2.6 km/h a second at 130 km/h
  study.rotating_mass_kg = 30.0;
  const RoadLoadProcedure procedure = evaluate_wltp(study);
  CHECK(procedure.reference.speeds.front() == 130);
  CHECK(procedure.reference.pairs.size() == 3);
  CHECK(procedure.warnings.empty());
  for (const double km_h : {20.0, 80.0, 130.0}) {
    const double v = km_h / 3.6;
    CHECK(procedure.force_N(v) == Approx(130.0 + 2.16 * v + 0.40176 * v * v).epsilon(0.003));
  }
}

TEST_CASE("WLTP coastdown: a trace that is sampled too rarely is named for that", "[fast]") {
  ProcedureStudy study = make_quiet_study();
  study.interval_s = 8.0;
  CHECK(has_warning(evaluate_wltp(study), "has too few samples near"));
  study.interval_s = 3.0;
  const RoadLoadProcedure coarse = evaluate_wltp(study);
  CHECK_FALSE(has_warning(coarse, "no run of the opposite heading"));
}
