#include "estimation/road_load/road_load_procedure.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <boost/math/distributions/students_t.hpp>

#include "estimation/road_load/recorded_wind.h"
#include "estimation/road_load/road_load_doubts.h"
#include "estimation/road_load/session_differences.h"
#include "estimation/road_load/session_headings.h"
#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

double calc_peak_total(const std::vector<double>& values, const std::vector<double>& others) {
  double most = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    most = std::max(most, std::hypot(values[i], others.size() == values.size() ? others[i] : 0.0));
  }
  return most;
}

double calc_mean_total(const std::vector<double>& along, const std::vector<double>& across) {
  double sum = 0.0;
  for (std::size_t i = 0; i < along.size(); ++i) {
    sum += std::hypot(along[i], across.size() == along.size() ? across[i] : 0.0);
  }
  return along.empty() ? 0.0 : sum / static_cast<double>(along.size());
}

/// Mean of (measured - fitted force)/road load of a run by its name: over the road load of both headings, so that a
/// slope or a wind that the headings have with opposite signs cancels. Nothing if that is nowhere positive.
std::optional<double> find_mean_deviation(const std::string& run, const RoadLoadProcedure& procedure) {
  std::vector<double> deviations;
  for (const ProcedurePoint& point : procedure.points) {
    const double load =
        procedure.as_tested.dot(Eigen::Vector3d(1.0, point.speed_m_s, point.speed_m_s * point.speed_m_s));
    if (point.run == run && load > 0.0) deviations.push_back((point.measured - point.fitted) / load);
  }
  if (deviations.empty()) return std::nullopt;
  return calc_mean(deviations);
}

}  // namespace

double RoadLoadProcedure::sd(int i) const {
  double variance = repeatability(i, i);
  for (const SensorContribution& sensor : sensors) variance += sensor.change(i) * sensor.change(i);
  return std::sqrt(variance);
}

std::array<double, 2> RoadLoadProcedure::interval_95(int i) const {
  constexpr double kMostFreedom = 1e6;
  const double total = sd(i) * sd(i);
  const double own = repeatability(i, i);
  const double effective =
      own > 0.0 ? std::clamp(freedom(i) * (total / own) * (total / own), 1.0, kMostFreedom) : kMostFreedom;
  const double reach = boost::math::quantile(boost::math::students_t(effective), 0.975) * sd(i);
  return {road_load(i) - reach, road_load(i) + reach};
}

double RoadLoadProcedure::force_N(double speed_m_s) const {
  return road_load(0) + speed_m_s * (road_load(1) + speed_m_s * road_load(2));
}

double RoadLoadProcedure::force_sd_N(double speed_m_s) const {
  const Eigen::Vector3d powers(1.0, speed_m_s, speed_m_s * speed_m_s);
  double variance = powers.dot(repeatability * powers);
  for (const SensorContribution& sensor : sensors) variance += std::pow(powers.dot(sensor.change), 2);
  return std::sqrt(variance);
}

void put_masses(const RoadLoadProcedureOptions& options, RoadLoadProcedure& procedure) {
  if (!options.mass_kg.has_value()) {
    throw InputError({"the mass is missing: the procedure gives forces", "command line", 0, "--mass", "",
                      "--mass <kg>, the mass of the vehicle as tested, the mean of before and after", ""});
  }
  procedure.correction.mass_kg = *options.mass_kg;
  procedure.correction.corrected_to_mass_kg = options.corrected_to_mass_kg.value_or(*options.mass_kg);
  procedure.rotating_mass_assumed = !options.rotating_mass_kg.has_value();
  procedure.rotating_mass_kg = options.rotating_mass_kg.value_or((kDefaultEffectiveRatio - 1.0) * *options.mass_kg);
  procedure.warnings = doubt_masses(*options.mass_kg, options.rotating_mass_kg, options.corrected_to_mass_kg);
  procedure.correction.rolling_fall_per_K = options.rolling_fall_per_K;
  procedure.correction.reference_temperature_K = options.reference_temperature_K;
}

std::optional<double> mean_of_condition(const CoastdownData& data, std::vector<double> CoastdownConditions::*member) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const CoastdownRun& run : data.runs) {
    const std::vector<double>& values = run.conditions.*member;
    if (values.empty()) return std::nullopt;
    for (const double value : values) sum += value;
    count += values.size();
  }
  if (count == 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

std::vector<double> find_positions(const CoastdownData& data) {
  std::vector<double> starts_s, numbers, places;
  for (const CoastdownRun& run : data.runs) {
    double number = 0.0;
    const char* end = run.id.data() + run.id.size();
    const auto read = std::from_chars(run.id.data(), end, number);
    if (read.ec == std::errc() && read.ptr == end) numbers.push_back(number);
    if (run.start_s.has_value()) starts_s.push_back(*run.start_s);
    places.push_back(static_cast<double>(places.size()));
  }
  if (starts_s.size() == data.runs.size()) return starts_s;
  return numbers.size() == data.runs.size() ? numbers : places;
}

std::string name_of_run(const CoastdownRun& run, const CoastdownData& data) {
  const auto same = std::count_if(data.runs.begin(), data.runs.end(),
                                  [&run](const CoastdownRun& other) { return other.id == run.id; });
  return same > 1 ? run.session + "/" + run.id : run.id;
}

std::vector<std::string> check_winds(const CoastdownData& data, const WindLimits& limits,
                                     std::vector<RoadLoadCheck>& checks) {
  std::vector<std::string> above;
  double mean_m_s = 0.0, peak_m_s = 0.0, across_m_s = 0.0;
  bool any = false, any_across = false;
  for (const CoastdownRun& run : data.runs) {
    const CoastdownConditions& at = run.conditions;
    if (at.wind_m_s.empty()) continue;
    any = true;
    any_across = any_across || !at.crosswind_m_s.empty();
    const double mean = calc_mean_total(at.wind_m_s, at.crosswind_m_s);
    const double peak = calc_peak_total(at.wind_m_s, at.crosswind_m_s);
    const double across = at.crosswind_m_s.empty() ? 0.0 : std::abs(calc_mean(at.crosswind_m_s));
    if (mean > limits.mean_m_s || peak > limits.peak_m_s || across > limits.across_m_s) {
      above.push_back(name_of_run(run, data));
    }
    mean_m_s = std::max(mean_m_s, mean);
    peak_m_s = std::max(peak_m_s, peak);
    across_m_s = std::max(across_m_s, across);
  }
  const auto add = [&](const char* name, bool known, double found_m_s, double limit_m_s, const char* missing) {
    const CheckStatus status = !known                   ? CheckStatus::kNotChecked
                               : found_m_s <= limit_m_s ? CheckStatus::kPass
                                                        : CheckStatus::kFail;
    checks.push_back({name, status, known ? fmt::format("{:.2f} m/s", found_m_s) : missing,
                      fmt::format("<= {:.1f} m/s", limit_m_s), limits.clause});
  };
  add("wind, mean of a run", any, mean_m_s, limits.mean_m_s, "no column wind_m_s");
  add("wind, peak", any, peak_m_s, limits.peak_m_s, "no column wind_m_s");
  add("crosswind, mean of a run", any_across, across_m_s, limits.across_m_s,
      (std::string("no column ") + limits.across_column).c_str());
  return above;
}

std::optional<double> find_common_wind(const CoastdownData& data) {
  double sums[2] = {0.0, 0.0};
  double counts[2] = {0.0, 0.0};
  for (const CoastdownRun& run : data.runs) {
    if (run.conditions.wind_m_s.empty() || run.heading == 0) continue;
    sums[run.heading > 0 ? 0 : 1] += calc_mean(run.conditions.wind_m_s);
    counts[run.heading > 0 ? 0 : 1] += 1.0;
  }
  if (counts[0] == 0.0 || counts[1] == 0.0) return std::nullopt;
  return std::min(std::abs(sums[0] / counts[0]), std::abs(sums[1] / counts[1]));
}

CoastdownData keep_runs(const CoastdownData& data, const std::vector<std::size_t>& runs) {
  CoastdownData kept;
  for (const std::size_t run : runs) kept.runs.push_back(data.runs[run]);
  return kept;
}

void put_conditions(const CoastdownData& data, const RoadLoadProcedureOptions& options, const AirRule& rule,
                    RoadLoadProcedure& procedure) {
  constexpr double kColdest_K = kZeroCelsius_K + 5.0;
  constexpr double kHottest_K = kZeroCelsius_K + 35.0;
  constexpr double kMostChange_K = 5.0;
  ReferenceCorrection& correction = procedure.correction;
  correction.reference_pressure_Pa = options.reference_pressure_Pa.value_or(rule.reference_pressure_Pa);
  correction.ambient_K = mean_of_condition(data, &CoastdownConditions::ambient_K);
  correction.ambient_pressure_Pa = mean_of_condition(data, &CoastdownConditions::ambient_pressure_Pa);
  if (!correction.ambient_K.has_value()) {
    procedure.warnings.push_back("no column ambient_degC: the coefficients are not corrected for the air");
    procedure.checks.push_back({"ambient temperature", CheckStatus::kNotChecked, "no column ambient_degC",
                                "5 to 35 degC", rule.temperature_clause});
    return;
  }
  if (!correction.ambient_pressure_Pa.has_value()) {
    procedure.warnings.push_back(
        fmt::format("no column ambient_pressure_kPa: {:.5g} kPa, that of reference, is taken for it, which has an "
                    "effect on f2",
                    1e-3 * correction.reference_pressure_Pa));
  }
  if (const auto doubt = doubt_ambient(data)) procedure.warnings.push_back(*doubt);
  double coldest_K = std::numeric_limits<double>::infinity();
  double hottest_K = 0.0;
  for (const CoastdownRun& run : data.runs) {
    for (const double ambient_K : run.conditions.ambient_K) {
      coldest_K = std::min(coldest_K, ambient_K);
      hottest_K = std::max(hottest_K, ambient_K);
    }
  }
  const std::string found =
      fmt::format("{:.1f} to {:.1f} degC", coldest_K - kZeroCelsius_K, hottest_K - kZeroCelsius_K);
  const bool within = coldest_K >= kColdest_K && hottest_K <= kHottest_K;
  procedure.checks.push_back({"ambient temperature", within ? CheckStatus::kPass : CheckStatus::kFail, found,
                              "5 to 35 degC", rule.temperature_clause});
  if (hottest_K - coldest_K > kMostChange_K) {
    procedure.warnings.push_back(
        fmt::format("the air was at {}: one correction for all runs is coarse where it changes by more than {:.0f} K",
                    found, kMostChange_K));
  }
}

void put_reference_result(ReferenceResult result, const std::map<int, double>& speeds_m_s,
                          RoadLoadProcedure& procedure) {
  procedure.warnings.insert(procedure.warnings.end(), result.warnings.begin(), result.warnings.end());
  for (const int km_h : result.speeds) procedure.reference_speeds_m_s.push_back(speeds_m_s.at(km_h));
  procedure.reference = std::move(result);
}

void put_used_conditions(const CoastdownData& data, const RoadLoadProcedureOptions& options,
                         std::vector<RoadLoadCheck> wind_checks, RoadLoadProcedure& procedure) {
  const CoastdownData used = keep_runs(data, procedure.reference.list_used_runs());
  put_conditions(used, options, kWltpAir, procedure);
  procedure.checks.insert(procedure.checks.end(), wind_checks.begin(), wind_checks.end());
  procedure.wind_m_s = find_common_wind(used);
  procedure.correction.wind_m_s = procedure.wind_m_s.value_or(0.0);
}

void finish_procedure(const RoadLoadProcedureOptions& options, RoadLoadProcedure& procedure) {
  const ReferenceResult& reference = procedure.reference;
  const double force_per_unit = procedure.tested.force_per_unit;
  Eigen::Matrix3d jacobian;  // the correction is linear in the coefficients
  for (int i = 0; i < 3; ++i) {
    jacobian.col(i) = force_per_unit * correct_to_reference(Eigen::Vector3d::Unit(i), procedure.correction);
  }
  procedure.as_tested = reference.coefficients;
  procedure.corrected = correct_to_reference(reference.coefficients, procedure.correction);
  procedure.road_load = force_per_unit * procedure.corrected;
  procedure.repeatability = jacobian * reference.covariance * jacobian.transpose();
  procedure.freedom = reference.freedom;
  procedure.tested.measured = procedure.as_tested;
  procedure.tested.correction = procedure.correction;
  procedure.tested.has_mass_correction = options.corrected_to_mass_kg.has_value();
  if (!procedure.rotating_mass_assumed) procedure.tested.rotating_mass_kg = procedure.rotating_mass_kg;
  if (options.sensor_accuracy) procedure.sensors = list_sensor_contributions(procedure.tested);
}

void put_fitted(RoadLoadProcedure& procedure) {
  for (ProcedurePoint& point : procedure.points) {
    point.fitted =
        procedure.as_tested(0) + point.speed_m_s * (procedure.as_tested(1) + point.speed_m_s * procedure.as_tested(2));
  }
}

void check_reference_precision(RoadLoadProcedure& procedure) {
  constexpr double kLimit = 0.03;
  double worst = 0.0;
  std::string found;
  int fewest = std::numeric_limits<int>::max();
  for (std::size_t i = 0; i < procedure.reference.speeds.size(); ++i) {
    const ReferencePrecision& at = procedure.reference.precisions[i];
    fewest = std::min(fewest, at.pairs);
    if (!found.empty() && at.precision <= worst) continue;
    worst = at.precision;
    found = fmt::format("{:.2f} % at {:.4g} km/h", 100.0 * at.precision, kKmhPerMs * procedure.reference_speeds_m_s[i]);
  }
  constexpr const char* kClause = "UN GTR 15 Annex 4, 4.3.1.4.2";
  procedure.checks.push_back(
      {"pairs at each reference speed", CheckStatus::kPass, fmt::format("{}", fewest), ">= 3", kClause});
  const CheckStatus status = worst <= kLimit ? CheckStatus::kPass : CheckStatus::kFail;
  procedure.checks.push_back({"statistical precision", status, found, "<= 3 %", kClause});
  if (status == CheckStatus::kFail) {
    procedure.warnings.push_back(
        fmt::format("the statistical precision is {}, above 3 %: more pairs are needed", found));
  }
}

void check_reference_speeds(RoadLoadProcedure& procedure) {
  constexpr int kLowest_km_h = 20;
  constexpr int kExtraHigh_km_h = 130;  // the highest speed of the WLTC of class 3 is 131.3 km/h
  const std::vector<int>& speeds = procedure.reference.speeds;
  const bool whole = speeds.back() <= kLowest_km_h && speeds.front() >= kExtraHigh_km_h;
  procedure.checks.push_back({"reference speeds", whole ? CheckStatus::kPass : CheckStatus::kFail,
                              fmt::format("{} to {} km/h", speeds.back(), speeds.front()),
                              "20 to 130 km/h or more (class 3)", "UN GTR 15 Annex 4, 2.2"});
}

void doubt_units(RoadLoadProcedure& procedure) {
  constexpr double kLeastRolling = 0.0003, kMostRolling = 0.15;  // Assumed: five times as far off as what is doubted
  const double mass_kg = procedure.correction.mass_kg;
  const models::RoadLoad<double> load{procedure.road_load(0), procedure.road_load(1), procedure.road_load(2)};
  double top_m_s = 0.0;
  for (const ProcedurePoint& point : procedure.points) top_m_s = std::max(top_m_s, point.speed_m_s);
  const double rolling = calc_rolling_share(load, mass_kg);
  if (!(rolling > kLeastRolling && rolling < kMostRolling)) {
    throw InputError(
        {fmt::format("the rolling loss at 50 km/h is {:.3g} of the weight, which no vehicle has: are the mass "
                     "and the units of the columns right?",
                     rolling),
         "", 0, "--mass", fmt::format("{:g}", mass_kg), "a loss near that of cars, 0.004 to 0.016", ""});
  }
  for (std::string& doubt : doubt_road_load(load, mass_kg, top_m_s)) procedure.warnings.push_back(std::move(doubt));
  if (load.A_N < 0.0 || load.C_N_s2_per_m2 < 0.0) {
    procedure.warnings.push_back("f0 or f2 is below 0: the data do not fit a vehicle that coasts freely");
  }
}

std::vector<RunResistance> list_resistances(const CoastdownData& data, const std::vector<std::string>& without,
                                            const RoadLoadProcedure& procedure) {
  std::vector<RunResistance> runs;
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    const std::string name = name_of_run(data.runs[i], data);
    if (std::find(without.begin(), without.end(), name) != without.end()) continue;
    RunResistance of_run{i, {}, {}};
    for (const ProcedurePoint& point : procedure.points) {
      if (point.run != name) continue;
      of_run.speed_m_s.push_back(point.speed_m_s);
      of_run.force_N.push_back(procedure.tested.force_per_unit * point.measured);
    }
    if (!of_run.speed_m_s.empty()) runs.push_back(std::move(of_run));
  }
  return runs;
}

void doubt_recorded_conditions(const CoastdownData& data, const std::string& column, SlopeForce slope_force,
                               RoadLoadProcedure& procedure) {
  const std::vector<RunResistance> runs = list_resistances(data, {}, procedure);
  const double drag_N_s2_per_m2 = procedure.tested.force_per_unit * procedure.as_tested(2);
  add_warnings(doubt_winds(list_winds_by_force(data, runs, drag_N_s2_per_m2), "the headings show a wind of", column),
               procedure);
  const double mass_kg = procedure.correction.mass_kg;
  if (has_recorded_slopes(data)) {
    add_warnings(doubt_slopes(list_slopes_by_force(data, runs, mass_kg, slope_force)), procedure);
  } else if (auto doubt = doubt_session_headings(data, runs, mass_kg)) {
    add_warnings({std::move(*doubt)}, procedure);
  }
}

void doubt_sessions(const CoastdownData& data, const std::vector<std::string>& without, RoadLoadProcedure& procedure) {
  const std::vector<RunResistance> runs = list_resistances(data, without, procedure);
  std::map<std::size_t, double> deviations;
  for (const RunResistance& run : runs) {
    const auto deviation = find_mean_deviation(name_of_run(data.runs[run.run], data), procedure);
    if (deviation.has_value()) deviations[run.run] = *deviation;
  }
  if (auto doubt = doubt_session_difference(data, deviations, SessionWinds::kInDeviations)) {
    procedure.warnings.push_back(std::move(*doubt));
  }
  const std::vector<std::string> partial = list_partial_sessions(data, deviations);
  if (!partial.empty()) {
    procedure.warnings.push_back(fmt::format(
        "one heading only in {} '{}': a wind or a slope there is in the force, which is not compared with other "
        "sessions",
        partial.size() == 1 ? "session" : "sessions", fmt::join(partial, "', '")));
  }
}

void add_warnings(const std::vector<std::string>& warnings, RoadLoadProcedure& procedure) {
  procedure.warnings.insert(procedure.warnings.end(), warnings.begin(), warnings.end());
}

AirFlow calc_air_flow(double speed_m_s, double against_m_s, double across_m_s) {
  const double along_m_s = speed_m_s + against_m_s;
  return {std::hypot(along_m_s, across_m_s), std::atan2(across_m_s, along_m_s)};
}

double calc_coastdown_force_N(double effective_mass_kg, double fall_m_s, double duration_s, double mass_kg,
                              double slope) {
  return effective_mass_kg * fall_m_s / duration_s - mass_kg * kStandardGravity_m_s2 * slope;
}

}  // namespace rollrig::estimation
