// Wind and slope as recorded, held against what the runs of both headings show.
#include "estimation/road_load/recorded_wind.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <memory>

#include "estimation/road_load/checked_road_load.h"
#include "estimation/road_load/road_load_procedure.h"
#include "tests/support/procedure_study.h"

using namespace rollrig;
using namespace rollrig::estimation;
using Catch::Contains;

namespace {

using Warnings = std::vector<std::string>;
using Change = std::function<double(double, int)>;  // of a recorded wind, with the heading

tests::ProcedureStudy make_study_with_wind(double wind_m_s) {
  tests::ProcedureStudy study;
  study.wind_m_s = wind_m_s;
  study.gust_sd_m_s = 0.4;
  study.run_force_sd_N = 3.0;
  study.pairs = 5;
  return study;
}

CoastdownFile make_recorded_file(const tests::ProcedureStudy& study, const Change& change, std::uint64_t seed = 1) {
  CoastdownFile file = tests::simulate_procedure(study, seed).file;
  for (CoastdownRun& run : file.data.runs) {
    for (double& wind_m_s : run.conditions.wind_m_s) wind_m_s = change(wind_m_s, run.heading);
    run.conditions.crosswind_m_s.clear();
  }
  return file;
}

/// What each method that takes a speed trace says.
std::vector<Warnings> list_warnings(CoastdownFile file, double mass_kg) {
  RoadLoadProcedureOptions options;
  options.mass_kg = mass_kg;
  std::vector<Warnings> all;
  all.push_back(evaluate_wltp_coastdowns(file, options).warnings);
  for (const auto kind : {RoadLoadProcedureKind::kJ1263, RoadLoadProcedureKind::kJ2263}) {
    options.kind = kind;
    all.push_back(evaluate_traces(file, options).warnings);
  }
  RoadLoadFitOptions own;
  own.mass_kg = mass_kg;
  all.push_back(fit_checked_road_load(file, own).warnings);
  return all;
}

int count_of(const Warnings& warnings, const std::string& text) {
  return static_cast<int>(std::count_if(warnings.begin(), warnings.end(), [&text](const std::string& warning) {
    return warning.find(text) != std::string::npos;
  }));
}

constexpr const char* kShown = "the headings show a wind of";

}  // namespace

TEST_CASE("a wind recorded with the wrong sign, frame or unit is doubted by every method", "[fast]") {
  struct Mistake {
    double wind_m_s;
    Change change;
    const char* says;
  };
  const Mistake mistakes[] = {{2.0, [](double w, int) { return -w; }, "sign looks reversed"},
                              {2.0, [](double w, int h) { return h * w; }, "the headwind of the vehicle"},
                              {1.0, [](double w, int) { return 3.6 * w; }, "in km/h"},
                              {1.3, [](double w, int) { return w / 0.44704; }, "in mph"}};
  for (const Mistake& mistake : mistakes) {
    const auto study = make_study_with_wind(mistake.wind_m_s);
    for (const Warnings& warnings : list_warnings(make_recorded_file(study, mistake.change), study.mass_kg)) {
      INFO(mistake.says);
      CHECK(count_of(warnings, kShown) == 1);
      CHECK(count_of(warnings, mistake.says) == 1);
    }
  }
}

TEST_CASE("a wind that is recorded as it blows is not doubted", "[slow]") {
  const auto as_it_is = [](double w, int) { return w; };
  for (const double wind_m_s : {0.0, 1.0, 2.5}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const auto study = make_study_with_wind(wind_m_s);
      for (const Warnings& warnings : list_warnings(make_recorded_file(study, as_it_is, seed), study.mass_kg)) {
        CHECK(count_of(warnings, kShown) == 0);
      }
    }
  }
}

TEST_CASE("of 60 tests with gusts and slopes of all winds none is doubted", "[slow]") {
  int doubted = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    auto study = make_study_with_wind(0.05 * static_cast<double>(seed));
    study.interval_s = 0.5;
    study.gust_sd_m_s = 1.0;
    study.run_force_sd_N = 6.0;
    study.slope = 0.0005 * static_cast<double>(seed % 5);
    study.pairs = 3 + static_cast<int>(seed % 4);
    for (const Warnings& warnings : list_warnings(make_recorded_file(
                                                      study, [](double w, int) { return w; }, 100 + seed),
                                                  study.mass_kg)) {
      doubted += count_of(warnings, "the headings show");
    }
  }
  CHECK(doubted == 0);
}

TEST_CASE("a slope in percent or with the wrong sign is doubted", "[fast]") {
  auto study = make_study_with_wind(1.0);
  study.slope = 0.002;
  study.run_force_sd_N = 1.0;
  for (const auto& [factor, says] : {std::pair(100.0, "in percent"), std::pair(-1.0, "sign looks reversed")}) {
    CoastdownFile file = make_recorded_file(study, [](double w, int) { return w; });
    for (CoastdownRun& run : file.data.runs) {
      for (double& slope : run.conditions.slope) slope *= factor;
    }
    RoadLoadProcedureOptions options;
    options.kind = RoadLoadProcedureKind::kJ2263;
    options.mass_kg = study.mass_kg;
    const RoadLoadProcedure procedure = evaluate_traces(file, options);
    CHECK(count_of(procedure.warnings, says) == 1);
    if (factor > 1.0) {
      CHECK(std::any_of(procedure.checks.begin(), procedure.checks.end(), [](const RoadLoadCheck& check) {
        return check.name == "slope" && check.status == CheckStatus::kFail;
      }));
    }
  }
}

TEST_CASE("anemometers at the vehicle and beside the road that contradict each other are doubted", "[fast]") {
  auto study = make_study_with_wind(1.5);
  study.crosswind_m_s = 2.0;
  study.on_board = true;
  for (const auto& [factor, says] :
       {std::pair(1.0, ""), std::pair(-1.0, "sign looks reversed"), std::pair(3.6, "in km/h")}) {
    CoastdownFile file = make_recorded_file(study, [](double w, int) { return w; });
    for (CoastdownRun& run : file.data.runs) {
      run.conditions.wind_m_s.assign(run.time_s.size(), factor * 1.5);
      run.conditions.crosswind_m_s.assign(run.time_s.size(), 2.0);
    }
    RoadLoadProcedureOptions options;
    options.kind = RoadLoadProcedureKind::kJ2263;
    options.mass_kg = study.mass_kg;
    const Warnings warnings = evaluate_traces(file, options).warnings;
    CHECK(count_of(warnings, "the anemometer at the vehicle shows") == (factor == 1.0 ? 0 : 1));
    CHECK(count_of(warnings, says) >= (factor == 1.0 ? 0 : 1));
  }
}

TEST_CASE("a small slope or wind in the direction of travel is doubted, others of that size are not", "[fast]") {
  auto study = make_study_with_wind(0.4);
  study.slope = 0.0007;
  study.run_force_sd_N = 1.0;
  study.gust_sd_m_s = 0.1;
  const auto as_it_is = [](double w, int) { return w; };
  CoastdownFile sloped = make_recorded_file(study, as_it_is);
  for (CoastdownRun& run : sloped.data.runs) {
    for (double& slope : run.conditions.slope) slope *= run.heading;
  }
  CoastdownFile surveyed = make_recorded_file(study, as_it_is);  // by another survey
  for (CoastdownRun& run : surveyed.data.runs) {
    for (double& slope : run.conditions.slope) slope = 0.0;
  }
  const CoastdownFile headwind = make_recorded_file(study, [](double w, int h) { return h * w; });
  const auto count = [&study](const CoastdownFile& file, const char* text) {
    int found = 0;
    for (const Warnings& warnings : list_warnings(file, study.mass_kg)) found += count_of(warnings, text);
    return found;
  };
  CHECK(count(sloped, "the slope in the direction of travel") == 4);
  CHECK(count(surveyed, "the headings show a slope") == 0);
  CHECK(count(headwind, "the headwind of the vehicle") == 4);
  CHECK(count(make_recorded_file(study, as_it_is), "the headings show") == 0);
}
