#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "estimation/road_load/procedure_uncertainty.h"
#include "estimation/road_load/road_load_procedure.h"
#include "estimation/uncertainty/budget.h"
#include "sim/core/csv.h"
#include "sim/core/random.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

using namespace rollrig;
using namespace rollrig::estimation;
using Catch::Contains;

namespace {

struct TorqueStudy {
  int pairs = 3;
  double drift_m_s2 = 0.0;
  double wind_m_s = 0.0;
  double pair_sd = 0.0;      // relative, from run to run
  double speed_scale = 1.0;  // 1/1.609344: speeds in mph
  bool second_vehicle = false;
  double torque_error_Nm = 0.0;
  double wheel_speed_error_Hz = 0.0;
  double speed_error_km_h = 0.0;
  double slope = 0.0;            // uphill in the + heading
  bool is_pm_exchanged = false;  // two sessions; the headings of the second are written the wrong way round
  double pm_unit = 1.0;          // two sessions; the speeds of the second are divided by it
  int without_top = 0;           // so many runs, from the first on, do not have the highest reference speed
};

constexpr double kRadius_m = 0.32;
constexpr double kMass_kg = 1600.0;
constexpr double kTorque[] = {40.0, 0.6, 0.13};  // Nm and m/s

std::string write_torques(const TorqueStudy& study, bool with_times = true) {
  RandomStream random(5, "torque");
  std::vector<std::string> columns{
      "reference_km_h", "speed_km_h",   "wheel_torque_Nm",      "wheel_speed_Hz", "run",    "session",
      "heading",        "ambient_degC", "ambient_pressure_kPa", "wind_m_s",       "vehicle"};
  if (with_times) columns.push_back("time_s");
  CsvWriter csv(columns);
  for (int run = 0; run < 2 * study.pairs; ++run) {
    const int heading = run % 2 == 0 ? 1 : -1;
    const double scale = 1.0 + study.pair_sd * random.normal();
    double time_s = 0.0;
    for (int reference = run < study.without_top ? 100 : 120; reference >= 20; reference -= 20) {
      for (int i = 0; i < (with_times ? 60 : 1); ++i, time_s += 0.1) {
        const double t = with_times ? 0.1 * (i - 29.5) : 0.0;
        const double v = reference / 3.6 + study.drift_m_s2 * t;
        const double air = v + heading * study.wind_m_s;
        const double torque = scale * (kTorque[0] + kTorque[1] * v + kTorque[2] * air * air) +
                              (kMass_kg + 48.0) * study.drift_m_s2 * kRadius_m;
        const bool is_pm = run >= study.pairs && (study.is_pm_exchanged || study.pm_unit != 1.0);
        const double unit = is_pm ? study.pm_unit : 1.0;
        csv.add(static_cast<double>(reference) / unit);
        csv.add(3.6 * v / unit * study.speed_scale + study.speed_error_km_h);
        csv.add(torque + study.torque_error_Nm +
                heading * kMass_kg * 9.80665 * study.slope * kRadius_m / 1.02);  // 2 % are lost before the torque meter
        csv.add(v / (2.0 * 3.14159265358979 * kRadius_m) + study.wheel_speed_error_Hz);
        csv.add(std::to_string(run + 1));
        const bool is_exchanged = study.is_pm_exchanged && run >= study.pairs;
        csv.add(std::string(is_pm ? "pm" : "am"));
        csv.add(std::string((heading > 0) != is_exchanged ? "+" : "-"));
        csv.add(20.0);
        csv.add(100.0);
        csv.add(study.wind_m_s);
        csv.add(std::string(study.second_vehicle && run > 2 ? "other" : "car"));
        if (with_times) csv.add(time_s);
        csv.end_row();
      }
    }
  }
  return csv.take();
}

RoadLoadProcedure evaluate_torques(const std::string& csv, RoadLoadProcedureOptions options = {}) {
  const tests::TemporaryFolder folder;
  tests::write_file(folder.file("torque.csv"), csv);
  options.kind = RoadLoadProcedureKind::kTorqueMeter;
  options.mass_kg = kMass_kg;
  return evaluate_torque_meter(folder.file("torque.csv"), options, {}, BadRows::kRefuse);
}

}  // namespace

TEST_CASE("torque meter: running resistance and road load are found", "[fast]") {
  TorqueStudy study;
  study.wind_m_s = 2.0;
  const RoadLoadProcedure procedure = evaluate_torques(write_torques(study));
  CHECK(procedure.wheel_radius_m == Approx(kRadius_m).epsilon(1e-4));
  // the mean of both headings has c2 w^2 in c0, which the correction takes out
  CHECK(procedure.as_tested(0) == Approx(40.0 + 0.13 * 4.0).epsilon(1e-4));
  for (int i = 0; i < 3; ++i) {
    CHECK(procedure.corrected(i) == Approx(kTorque[i]).epsilon(1e-3));
    CHECK(procedure.road_load(i) == Approx(1.02 * kTorque[i] / kRadius_m).epsilon(2e-3));
  }
}

TEST_CASE("torque meter: a drift of the speed is taken out of the torque", "[fast]") {
  TorqueStudy study;
  study.drift_m_s2 = -0.02;
  const RoadLoadProcedure procedure = evaluate_torques(write_torques(study));
  for (int i = 0; i < 3; ++i) CHECK(procedure.corrected(i) == Approx(kTorque[i]).epsilon(0.01));
  // 1648 kg * 0.02 m/s2 * 0.32 m = 10.5 Nm would be missing
  const RoadLoadProcedure means = evaluate_torques(write_torques(study, false));
  CHECK(means.corrected(0) == Approx(kTorque[0] - 10.55).margin(0.2));
  CHECK_THAT(means.warnings.front() + means.warnings.back(), Contains("not corrected for a drift"));
}

TEST_CASE("torque meter: sensors that are off move the road load as the budget says", "[fast]") {
  TorqueStudy study;
  study.pairs = 4;
  study.pair_sd = 0.005;
  const RoadLoadProcedure before = evaluate_torques(write_torques(study));
  const auto budgets = calc_budgets(make_procedure_model(before));
  const auto check = [&](const std::string& name, const TorqueStudy& moved, double sds) {
    const RoadLoadProcedure after = evaluate_torques(write_torques(moved));
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& lines = budgets[i].contributions;
      const auto line =
          std::find_if(lines.begin(), lines.end(), [&](const auto& one) { return one.input.name == name; });
      REQUIRE(line != lines.end());
      INFO(name << ", f" << i);
      const double change = after.road_load(static_cast<int>(i)) - before.road_load(static_cast<int>(i));
      CHECK(std::abs(change) ==
            Approx(sds * line->contribution).epsilon(0.05).margin(2e-4 * std::abs(budgets[i].value)));
    }
  };
  const double root3 = std::sqrt(3.0);
  TorqueStudy moved = study;
  moved.torque_error_Nm = 3.0;
  check("wheel torque", moved, 3.0 / 6.0 * root3);
  moved = study;
  moved.wheel_speed_error_Hz = 0.1;
  check("wheel speed", moved, 0.1 / 0.05 * root3);
  moved = study;
  moved.speed_error_km_h = 0.4;
  check("vehicle speed", moved, 0.4 / 0.2 * root3);
}

TEST_CASE("torque meter: precision, and what is wrong with a test", "[fast]") {
  TorqueStudy study;
  study.pairs = 6;
  study.pair_sd = 0.01;
  const RoadLoadProcedure procedure = evaluate_torques(write_torques(study));
  CHECK(procedure.reference.precisions.front().precision < 0.03);
  CHECK(procedure.sd(0) > 0.0);
  study.second_vehicle = true;
  CHECK_THROWS_WITH(evaluate_torques(write_torques(study)), Contains("another vehicle than 'car'"));
  study = {};
  study.pairs = 2;
  CHECK_THROWS_WITH(evaluate_torques(write_torques(study)), Contains("fewer than 3 pairs"));
  study = {};
  study.speed_scale = 1.0 / 1.609344;
  CHECK_THROWS_WITH(evaluate_torques(write_torques(study)), Contains("speed_km_h looks as if it were in mph"));
}

TEST_CASE("torque meter: runs that lack a reference speed are used at the others", "[fast]") {
  TorqueStudy study;
  study.pairs = 4;
  study.without_top = 1;
  const RoadLoadProcedure one = evaluate_torques(write_torques(study));
  CHECK(one.reference.list_used_runs().size() == 8);
  CHECK(one.reference.precisions.front().pairs == 3);
  CHECK(one.reference.precisions.back().pairs == 4);
  study.without_top = 4;
  const RoadLoadProcedure four = evaluate_torques(write_torques(study));
  CHECK(four.reference.list_used_runs().size() == 8);
  CHECK(four.reference.speeds.front() == 100);
  CHECK(std::count_if(four.warnings.begin(), four.warnings.end(), [](const std::string& warning) {
          return warning.find("120 km/h (2 pairs, of 2 runs with + and 2 with -)") != std::string::npos &&
                 warning.find("--speed-to 110 leaves that out") != std::string::npos;
        }) == 1);
}

TEST_CASE("torque meter: turns of the wheels in another unit are refused by the radius that they give", "[fast]") {
  const auto write = [](double speed_factor, double turns_factor) {
    CsvWriter csv({"reference_km_h", "speed_km_h", "wheel_torque_Nm", "wheel_speed_Hz", "run", "heading"});
    for (int run = 0; run < 6; ++run) {
      for (const int km_h : {20, 50, 80, 110}) {
        csv.add(speed_factor * km_h);
        csv.add(speed_factor * km_h);
        csv.add(40.0 + 0.01 * km_h * km_h + 0.01 * run);
        csv.add(turns_factor * km_h / 3.6 / (2.0 * 3.14159265358979 * 0.32));
        csv.add(std::to_string(run + 1));
        csv.add(std::string(run % 2 == 0 ? "+" : "-"));
        csv.end_row();
      }
    }
    return csv.take();
  };
  CHECK(evaluate_torques(write(1.0, 1.0)).wheel_radius_m == Approx(0.32));
  CHECK_THROWS_WITH(evaluate_torques(write(1.0, 60.0)), Contains("wheel_speed_Hz looks as if it were in 1/min"));
  CHECK_THROWS_WITH(evaluate_torques(write(1.0, 6.2831853)), Contains("wheel_speed_Hz looks as if it were in rad/s"));
  CHECK_THROWS_WITH(evaluate_torques(write(0.62137, 1.0)), Contains("a radius that no tire has"));  // both in mph
}

TEST_CASE("torque meter: a given radius that is not that of the wheels is doubted, with both", "[fast]") {
  const std::string csv = write_torques({});
  const auto find_doubt = [&csv](double given_m) {
    RoadLoadProcedureOptions options;
    options.wheel_radius_m = given_m;
    for (const std::string& warning : evaluate_torques(csv, options).warnings) {
      if (warning.find("--wheel-radius") != std::string::npos) return warning;
    }
    return std::string();
  };
  CHECK_THAT(find_doubt(0.6), Contains("0.600 m") && Contains("0.320 m at 80 km/h"));
  CHECK_THAT(find_doubt(0.3), Contains("0.300 m"));
  CHECK(find_doubt(0.31).empty());  // 3 %
  CHECK(find_doubt(0.32).empty());
}

TEST_CASE("torque meter: torques of the wrong sign are refused, those of one run downhill are not", "[fast]") {
  const auto write = [](const std::vector<double>& torques_Nm) {
    CsvWriter csv({"reference_km_h", "speed_km_h", "wheel_torque_Nm", "run", "heading"});
    for (int run = 0; run < 6; ++run) {
      for (const int km_h : {20, 50, 80, 110}) {
        csv.add(static_cast<double>(km_h));
        csv.add(static_cast<double>(km_h));
        csv.add(torques_Nm[static_cast<std::size_t>(run)] + 0.01 * km_h * km_h);
        csv.add(std::to_string(run + 1));
        csv.add(std::string(run % 2 == 0 ? "+" : "-"));
        csv.end_row();
      }
    }
    return csv.take();
  };
  RoadLoadProcedureOptions options;
  options.wheel_radius_m = 0.3;
  CHECK_THROWS_WITH(evaluate_torques(write({-40.0, -41.0, -40.0, -41.0, -40.0, -41.0}), options),
                    Contains("is its sign reversed?"));
  const RoadLoadProcedure sloped = evaluate_torques(write({90.0, -10.0, 91.0, -11.0, 90.5, -10.5}), options);
  CHECK(sloped.as_tested(0) == Approx(40.0).margin(0.5));
  const auto reached = std::find_if(sloped.checks.begin(), sloped.checks.end(),
                                    [](const RoadLoadCheck& check) { return check.name == "reference speeds"; });
  REQUIRE(reached != sloped.checks.end());
  CHECK(reached->status == CheckStatus::kFail);  // 110 km/h is not the highest of class 3
}

TEST_CASE("torque meter: without wheel speeds a radius is asked for", "[fast]") {
  const std::string csv =
      "reference_km_h,speed_km_h,wheel_torque_Nm,run,heading\n20,20,45,1,+\n50,50,75,1,+\n80,80,130,1,+\n110,110,200,1,"
      "+\n";
  CHECK_THROWS_WITH(evaluate_torques(csv), Contains("dynamic radius"));
  RoadLoadProcedureOptions options;
  options.wheel_radius_m = 0.3;
  CHECK_THROWS_WITH(evaluate_torques(csv, options), Contains("same heading"));
}

TEST_CASE("torque meter: a recording that is there twice counts once", "[fast]") {
  TorqueStudy study;
  study.pairs = 4;
  study.pair_sd = 0.01;
  const std::string once = write_torques(study);
  std::string twice = once;
  std::size_t line = once.find('\n') + 1;
  while (line < once.size()) {
    const std::size_t end = once.find('\n', line) + 1;
    std::string row = once.substr(line, end - line);
    line = end;
    std::size_t field = 0;
    for (int comma = 0; comma < 4; ++comma) field = row.find(',', field) + 1;
    const int run = std::stoi(row.substr(field));
    if (run > 2) continue;
    row.replace(field, row.find(',', field) - field, std::to_string(run + 20));
    twice += row;
  }
  const RoadLoadProcedure first = evaluate_torques(once), second = evaluate_torques(twice);
  CHECK(second.run_names.size() == 8);
  for (int i = 0; i < 3; ++i) CHECK(second.sd(i) == Approx(first.sd(i)));
  CHECK_THAT(second.warnings.front(), Contains("run '1' and run '21' are the same recording"));
}

TEST_CASE("torque meter: the sign of the wind is held against the headings", "[fast]") {
  TorqueStudy study;
  study.wind_m_s = 2.0;
  study.pair_sd = 0.002;
  const auto says = [](const RoadLoadProcedure& procedure) {
    std::string all;
    for (const std::string& warning : procedure.warnings) all += warning;
    return all;
  };
  CHECK_THAT(says(evaluate_torques(write_torques(study))), !Contains("the headings show"));
  std::string csv = write_torques(study);
  for (std::size_t at = csv.find(",2,car"); at != std::string::npos; at = csv.find(",2,car", at + 3)) {
    csv.replace(at, 6, ",-2,car");
  }
  CHECK_THAT(says(evaluate_torques(csv)), Contains("its sign looks reversed"));
}

TEST_CASE("torque meter: exchanged headings of a session are asked for by the slope of the road", "[fast]") {
  TorqueStudy study;
  study.pairs = 8;
  study.pair_sd = 0.002;
  study.slope = 0.004;
  const auto find_question = [](const RoadLoadProcedure& procedure) {
    for (const std::string& warning : procedure.warnings) {
      if (warning.find("exchanged?") != std::string::npos) return warning;
    }
    return std::string();
  };
  CHECK(find_question(evaluate_torques(write_torques(study))).empty());
  study.is_pm_exchanged = true;
  CHECK_THAT(find_question(evaluate_torques(write_torques(study))),
             Contains("+0.0040 in session 'am'") && Contains("-0.0040 in session 'pm'"));
}

TEST_CASE("torque meter: a session in mph is asked for its unit", "[fast]") {
  TorqueStudy study;
  study.pairs = 8;
  study.pair_sd = 0.002;
  study.pm_unit = 1.609344;
  RoadLoadProcedureOptions options;
  options.wheel_radius_m = kRadius_m;
  const RoadLoadProcedure procedure = evaluate_torques(write_torques(study), options);
  std::string all;
  for (const std::string& warning : procedure.warnings) all += warning + "\n";
  CHECK_THAT(all, Contains("session 'pm'") && Contains("if its values of reference_km_h and speed_km_h are in mph"));
}
