#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <boost/math/constants/constants.hpp>

#include "estimation/road_load/coastdown_repeats.h"
#include "estimation/road_load/coastdown_rows.h"
#include "estimation/road_load/coastdown_units.h"
#include "estimation/road_load/road_load_doubts.h"
#include "estimation/road_load/road_load_procedure.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

constexpr const char* kTorqueClause = "Regulation (EU) 2017/1151, 4.4 of Sub-Annex 4";
// Share of the road load that the torque meters do not see. UN GTR 15 Annex 4 (not from the text).
constexpr double kDrivelineFactor = 1.02;

/// Samples of one run at one reference speed.
struct TorqueMeasurement {
  std::size_t run = 0;
  int reference_km_h = 0;
  std::vector<double> time_s, speed_m_s, torque_Nm, wheel_Hz;
};

struct MeanTorque {
  double speed_m_s = 0.0;
  double torque_Nm = 0.0;
  double acceleration_m_s2 = 0.0;
};

struct TorqueFile {
  CoastdownData runs;  // their names, headings and conditions
  std::vector<TorqueMeasurement> measurements;
  bool has_times = false;
  bool has_wheel_speeds = false;
};

std::vector<std::string> list_torque_columns() {
  std::vector<std::string> columns{"reference_km_h", "speed_km_h", "wheel_torque_Nm", "time_s", "wheel_speed_Hz", "run",
                                   "session",        "heading",    "vehicle"};
  for (const std::string& column : list_condition_columns()) columns.push_back(column);
  return columns;
}

TorqueFile read_torque_file(const std::string& path, BadRows bad_rows) {
  CheckedRows rows(path);
  const CsvTable& table = rows.table();
  table.require_known(list_torque_columns());
  require_one_vehicle(table);
  TorqueFile file;
  file.has_times = table.has("time_s");
  file.has_wheel_speeds = table.has("wheel_speed_Hz");
  const std::vector<double> references = rows.numbers({"reference_km_h", between(1.0, 300.0), ""});
  const std::vector<double> speeds = rows.numbers({"speed_km_h", between(0.0, 500.0), ""});
  const std::vector<double> torques = rows.numbers({"wheel_torque_Nm", any_number(), ""});
  const std::vector<double> none;
  const std::vector<double> times = file.has_times ? rows.numbers({"time_s", any_number(), ""}) : none;
  const std::vector<double> wheels = file.has_wheel_speeds ? rows.numbers({"wheel_speed_Hz", positive(), ""}) : none;
  const CoastdownConditions conditions = read_conditions(rows);
  std::vector<bool> begins(rows.row_count(), false);
  if (!begins.empty()) begins.front() = true;
  const std::vector<RowsOfRun> of_runs = sort_into_runs(rows, begins, std::vector<bool>(rows.row_count(), true));
  if (file.has_times) {
    for (const RowsOfRun& run : of_runs) {
      rows.check_times("time_s", run.rows, times, fmt::format(" within run '{}'", run.id));
    }
  }
  rows.settle(bad_rows);
  for (const RowsOfRun& of_run : of_runs) {
    CoastdownRun run;
    run.id = of_run.id;
    run.session = of_run.session;
    run.heading = of_run.heading;
    std::map<int, TorqueMeasurement> measurements;
    for (const std::size_t row : of_run.rows) {
      if (rows.is_out(row)) continue;
      const int reference_km_h = static_cast<int>(std::lround(kKmhPerMs * references[row]));
      TorqueMeasurement& at = measurements[reference_km_h];
      at.run = file.runs.runs.size();
      at.reference_km_h = reference_km_h;
      at.speed_m_s.push_back(speeds[row]);
      at.torque_Nm.push_back(torques[row]);
      if (file.has_times) at.time_s.push_back(times[row]);
      if (file.has_wheel_speeds) at.wheel_Hz.push_back(wheels[row]);
      add_conditions(conditions, row, run.conditions);
    }
    if (measurements.empty()) continue;
    for (auto& [speed, measurement] : measurements) file.measurements.push_back(std::move(measurement));
    file.runs.runs.push_back(std::move(run));
  }
  return file;
}

/// Keeps the runs for which `keeps` is true, and their measurements.
template <class Keeps>
void keep_torque_runs(const Keeps& keeps, TorqueFile& file) {
  const std::size_t runs = file.runs.runs.size();
  std::vector<std::size_t> places(runs, runs);
  std::vector<CoastdownRun> kept;
  for (std::size_t i = 0; i < runs; ++i) {
    if (!keeps(i)) continue;
    places[i] = kept.size();
    kept.push_back(file.runs.runs[i]);
  }
  std::vector<TorqueMeasurement> measurements;
  for (TorqueMeasurement& at : file.measurements) {
    if (places[at.run] == runs) continue;
    at.run = places[at.run];
    measurements.push_back(std::move(at));
  }
  file.runs.runs = std::move(kept);
  file.measurements = std::move(measurements);
}

/// Samples of `second` that are those of a measurement of `first`.
std::size_t count_shared_samples(const TorqueFile& file, std::size_t first, std::size_t second) {
  std::size_t shared = 0;
  for (const TorqueMeasurement& at : file.measurements) {
    if (at.run != second) continue;
    const bool is_copy =
        std::any_of(file.measurements.begin(), file.measurements.end(), [&](const TorqueMeasurement& other) {
          return other.run == first && other.speed_m_s == at.speed_m_s && other.torque_Nm == at.torque_Nm;
        });
    if (is_copy) shared += at.torque_Nm.size();
  }
  return shared;
}

/// Whether a measurement scatters, as no simulation without noise does.
bool has_noise(const TorqueMeasurement& at) {
  constexpr double kLeastScatter = 1e-4;  // Assumed: of the torque
  const std::size_t n = at.torque_Nm.size();
  double squares = 0.0;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    squares += std::pow(at.torque_Nm[i - 1] - 2.0 * at.torque_Nm[i] + at.torque_Nm[i + 1], 2);
  }
  return n > 2 && std::sqrt(squares / static_cast<double>(n - 2)) > kLeastScatter * std::abs(calc_mean(at.torque_Nm));
}

/// Whether two runs can differ: the measurements scatter, or runs of one heading are not all alike. Else they are
/// those of a simulation without noise, and no copies.
bool can_differ(const TorqueFile& file) {
  return std::any_of(file.measurements.begin(), file.measurements.end(), [&file](const TorqueMeasurement& at) {
    return has_noise(at) ||
           std::any_of(file.measurements.begin(), file.measurements.end(), [&](const TorqueMeasurement& other) {
             return other.reference_km_h == at.reference_km_h &&
                    file.runs.runs[other.run].heading == file.runs.runs[at.run].heading &&
                    other.torque_Nm != at.torque_Nm;
           });
  });
}

/// Takes out runs whose samples are those of another run; warns of them.
void leave_out_repeated_torques(TorqueFile& file, std::vector<std::string>& warnings) {
  constexpr double kWhole = 0.9;             // Assumed: as a copy may lack some rows
  constexpr std::size_t kFewestSamples = 4;  // Assumed: fewer agree by chance
  if (!can_differ(file)) return;
  const std::size_t runs = file.runs.runs.size();
  std::vector<std::size_t> samples(runs, 0);
  for (const TorqueMeasurement& at : file.measurements) samples[at.run] += at.torque_Nm.size();
  std::vector<bool> gone(runs, false);
  for (std::size_t second = 1; second < runs; ++second) {
    for (std::size_t first = 0; first < second && !gone[second]; ++first) {
      const std::size_t shared = count_shared_samples(file, first, second);
      const bool is_copy =
          shared >= kFewestSamples && static_cast<double>(shared) >= kWhole * static_cast<double>(samples[second]);
      if (gone[first] || !is_copy) continue;
      gone[second] = true;
      warnings.push_back(fmt::format("{} and {} are the same recording: it is counted once", call_run(file.runs, first),
                                     call_run(file.runs, second)));
    }
  }
  keep_torque_runs([&gone](std::size_t run) { return !gone[run]; }, file);
}

/// The dynamic radius, and the speeds of vehicle and wheels at which it was found; 0 where it is given.
struct DynamicRadius {
  double radius_m = 0.0;
  double speed_m_s = 0.0;
  double wheel_speed_Hz = 0.0;
};

/// Throws InputError where speed and turns of the wheels give a radius that no road vehicle has.
void require_possible_radius(const std::string& path, double radius_m, double turns_Hz) {
  constexpr double kLeast_m = 0.22, kMost_m = 0.7;  // Assumed: from the smallest car to the largest truck
  constexpr double kUsualCar_m = 0.31;
  constexpr double kPerMinute = 60.0;
  if (radius_m >= kLeast_m && radius_m <= kMost_m) return;
  const auto is_usual_after = [radius_m](double factor) {
    return radius_m * factor > 0.8 * kUsualCar_m && radius_m * factor < 1.3 * kUsualCar_m;
  };
  const char* guess = is_usual_after(kPerMinute) ? "; wheel_speed_Hz looks as if it were in 1/min"
                      : is_usual_after(boost::math::constants::two_pi<double>())
                          ? "; wheel_speed_Hz looks as if it were in rad/s"
                          : "; are both speeds in the units of their columns?";
  throw InputError({std::string("speed and turns of the wheels give a radius that no tire has") + guess, path, 0,
                    "wheel_speed_Hz", fmt::format("{:.4g}, a dynamic radius of {:.4g} m", turns_Hz, radius_m),
                    fmt::format("a radius of {:g} to {:g} m", kLeast_m, kMost_m), ""});
}

/// By the wheels' rotation at 80 km/h, or at the highest reference speed below.
DynamicRadius measure_wheel_radius(const TorqueFile& file) {
  constexpr int kRadiusSpeed_km_h = 80;
  int highest_km_h = 0;
  for (const TorqueMeasurement& at : file.measurements) {
    if (at.reference_km_h <= kRadiusSpeed_km_h) highest_km_h = std::max(highest_km_h, at.reference_km_h);
  }
  double speed_m_s = 0.0, turns_Hz = 0.0, count = 0.0;
  for (const TorqueMeasurement& at : file.measurements) {
    if (at.reference_km_h != highest_km_h) continue;
    speed_m_s += calc_mean(at.speed_m_s);
    turns_Hz += calc_mean(at.wheel_Hz);
    count += 1.0;
  }
  const double radius_m = speed_m_s / (boost::math::constants::two_pi<double>() * turns_Hz);
  return {radius_m, speed_m_s / count, turns_Hz / count};
}

/// The radius that is given, with a warning where the wheels say another one; else that of the wheels.
DynamicRadius find_wheel_radius(const std::string& path, const TorqueFile& file,
                                const RoadLoadProcedureOptions& options, std::vector<std::string>& warnings) {
  constexpr double kMostDifference = 0.05;  // Assumed: of a nominal radius from the dynamic one
  if (!options.wheel_radius_m.has_value()) {
    if (!file.has_wheel_speeds) {
      throw InputError({"the dynamic radius of the tires is missing: a torque becomes a force by it", "command line", 0,
                        "--wheel-radius", "", "--wheel-radius <m>, or a column wheel_speed_Hz", ""});
    }
    const DynamicRadius measured = measure_wheel_radius(file);
    require_possible_radius(path, measured.radius_m, measured.wheel_speed_Hz);
    return measured;
  }
  const double given_m = *options.wheel_radius_m;
  if (file.has_wheel_speeds) {
    const DynamicRadius measured = measure_wheel_radius(file);
    if (std::abs(given_m / measured.radius_m - 1.0) > kMostDifference) {
      warnings.push_back(fmt::format(
          "--wheel-radius is {:.3f} m, but speed_km_h and wheel_speed_Hz give {:.3f} m at {:.0f} km/h; all forces are "
          "in inverse proportion to the radius",
          given_m, measured.radius_m, kKmhPerMs * measured.speed_m_s));
    }
  }
  return {given_m, 0.0, 0.0};
}

/// Equation  C_m = mean C - (m_st + m_r) a r,  a slope of the speed over time
MeanTorque calc_mean_torque(const TorqueMeasurement& at, double effective_mass_kg, double radius_m) {
  MeanTorque mean{calc_mean(at.speed_m_s), calc_mean(at.torque_Nm), 0.0};
  if (at.time_s.size() < 2) return mean;
  const double middle_s = calc_mean(at.time_s);
  double across = 0.0, square = 0.0;
  for (std::size_t i = 0; i < at.time_s.size(); ++i) {
    across += (at.time_s[i] - middle_s) * (at.speed_m_s[i] - mean.speed_m_s);
    square += (at.time_s[i] - middle_s) * (at.time_s[i] - middle_s);
  }
  mean.acceleration_m_s2 = across / square;
  mean.torque_Nm -= effective_mass_kg * mean.acceleration_m_s2 * radius_m;
  return mean;
}

/// Throws InputError where a mean speed is not near its reference speed.
void require_reference_speeds(const std::string& path, const TorqueFile& file) {
  constexpr double kMostError = 0.1;  // Assumed: five times the limit of the procedure
  constexpr double kNear = 0.03;
  for (const TorqueMeasurement& at : file.measurements) {
    const double speed_km_h = kKmhPerMs * calc_mean(at.speed_m_s);
    const double share = speed_km_h / at.reference_km_h;
    if (std::abs(share - 1.0) <= kMostError) continue;
    throw InputError({"the mean speed is not near its reference speed" +
                          guess_speed_unit(share, "speed_km_h", "reference_km_h", kNear),
                      path, 0, "speed_km_h",
                      fmt::format("{:.1f} at reference_km_h = {}", speed_km_h, at.reference_km_h),
                      "a mean within 10 % of the reference speed; the procedure asks for 1 km/h or 2 %", ""});
  }
}

/// Throws InputError where the torques of a reference speed are not positive on the mean; one run may go downhill.
void require_driving_torques(const std::string& path, const TorqueFile& file, const std::vector<MeanTorque>& means) {
  std::map<int, std::vector<double>> torques_Nm;
  for (std::size_t i = 0; i < means.size(); ++i) {
    torques_Nm[file.measurements[i].reference_km_h].push_back(means[i].torque_Nm);
  }
  for (const auto& [reference_km_h, values_Nm] : torques_Nm) {
    const double mean_Nm = calc_mean(values_Nm);
    if (mean_Nm > 0.0) continue;
    throw InputError({"the wheel torque is not positive at a steady speed: is its sign reversed?", path, 0,
                      "wheel_torque_Nm",
                      fmt::format("{:.1f}, the mean at reference_km_h = {}", mean_Nm, reference_km_h),
                      "a torque that drives the vehicle is positive", ""});
  }
}

/// Speeds against those of reference, length and drift of the measurements.
void check_measurements(const TorqueFile& file, const std::vector<MeanTorque>& means, RoadLoadProcedure& procedure) {
  constexpr double kLeast_s = 5.0;
  constexpr double kLeastSpeedError_km_h = 1.0;
  constexpr double kSpeedShare = 0.02;
  double shortest_s = 1e9, farthest = 0.0, fastest_drift = 0.0;
  std::string found_speed;
  for (std::size_t i = 0; i < means.size(); ++i) {
    const TorqueMeasurement& at = file.measurements[i];
    if (file.has_times) shortest_s = std::min(shortest_s, at.time_s.back() - at.time_s.front());
    fastest_drift = std::max(fastest_drift, std::abs(means[i].acceleration_m_s2));
    const double error_km_h = kKmhPerMs * means[i].speed_m_s - at.reference_km_h;
    const double share = std::abs(error_km_h) / std::max(kLeastSpeedError_km_h, kSpeedShare * at.reference_km_h);
    if (!found_speed.empty() && share <= farthest) continue;
    farthest = share;
    found_speed = fmt::format("{:+.2f} km/h at {} km/h", error_km_h, at.reference_km_h);
  }
  const auto status = [](bool known, bool within) {
    return !known ? CheckStatus::kNotChecked : within ? CheckStatus::kPass : CheckStatus::kFail;
  };
  procedure.checks.push_back({"mean speeds", status(true, farthest <= 1.0), found_speed, "1 km/h or 2 %",
                              "Regulation (EU) 2017/1151, 4.4.2.4 of Sub-Annex 4"});
  const bool is_long = shortest_s >= kLeast_s - 0.11;  // less one sample at 10 Hz
  procedure.checks.push_back({"shortest measurement", status(file.has_times, is_long),
                              file.has_times ? fmt::format("{:.1f} s", shortest_s) : "no column time_s", ">= 5 s",
                              kTorqueClause});
  if (farthest > 1.0) {
    procedure.warnings.push_back(fmt::format("a mean speed is {} from its reference speed", found_speed));
  }
  constexpr double kLong_s = 1800.0;  // Assumed
  if (file.has_times && shortest_s > kLong_s) {
    procedure.warnings.push_back(
        fmt::format("each measurement lasts {:.0f} s or more: is time_s in seconds?", shortest_s));
  }
  if (!file.has_times) {
    procedure.warnings.push_back("no column time_s: torques are not corrected for a drift of the speed");
  } else if (fastest_drift > 0.05) {
    procedure.warnings.push_back(
        fmt::format("the speed changes by {:.2f} m/s2 during a measurement: it is not steady", fastest_drift));
  }
}

/// Keeps what the sessions and --leave-out leave.
void select_torque_runs(const RoadLoadProcedureOptions& options, const std::vector<std::string>& sessions,
                        TorqueFile& file) {
  keep_torque_runs(
      [&](std::size_t at) {
        const CoastdownRun& run = file.runs.runs[at];
        const bool left_out = std::any_of(
            options.leave_out.begin(), options.leave_out.end(),
            [&run](const std::string& name) { return name == run.id || name == run.session + "/" + run.id; });
        const bool is_of_session =
            sessions.empty() || std::find(sessions.begin(), sessions.end(), run.session) != sessions.end();
        return is_of_session && !left_out;
      },
      file);
  if (!file.measurements.empty()) return;
  throw InputError({"all runs are left out", "command line", 0, sessions.empty() ? "--leave-out" : "--session", "",
                    "a session of the file, and runs that stay", ""});
}

/// The mean torques of the runs at their reference speeds.
struct ReferenceTorques {
  std::vector<ReferenceRun> runs;
  std::vector<MeanTorque> means;     // of the measurements of the file
  std::map<int, double> speeds_m_s;  // mean over the runs, by the reference speed in km/h
};

/// Speeds outside of those of the options are not used.
ReferenceTorques find_reference_torques(const TorqueFile& file, const RoadLoadProcedureOptions& options,
                                        double effective_mass_kg, double radius_m) {
  ReferenceTorques torques;
  const std::vector<double> positions = find_positions(file.runs);
  for (const CoastdownRun& run : file.runs.runs) {
    torques.runs.push_back({name_of_run(run, file.runs), run.session, run.heading, {}, positions[torques.runs.size()]});
  }
  std::map<int, std::vector<double>> speeds_m_s;
  for (const TorqueMeasurement& at : file.measurements) {
    torques.means.push_back(calc_mean_torque(at, effective_mass_kg, radius_m));
    const double reference_m_s = at.reference_km_h / kKmhPerMs;
    if (reference_m_s < options.speed_from_m_s || reference_m_s > options.speed_to_m_s) continue;
    torques.runs[at.run].values[at.reference_km_h] = torques.means.back().torque_Nm;
    speeds_m_s[at.reference_km_h].push_back(torques.means.back().speed_m_s);
  }
  for (const auto& [km_h, values_m_s] : speeds_m_s) torques.speeds_m_s[km_h] = calc_mean(values_m_s);
  return torques;
}

/// A point for each torque of the runs.
void put_torque_points(const TorqueFile& file, const ReferenceTorques& torques, RoadLoadProcedure& procedure) {
  for (std::size_t i = 0; i < file.measurements.size(); ++i) {
    const TorqueMeasurement& at = file.measurements[i];
    const ReferenceRun& run = torques.runs[at.run];
    if (run.values.count(at.reference_km_h) == 0) continue;
    procedure.points.push_back({run.name, run.heading, torques.means[i].speed_m_s, torques.means[i].torque_Nm, 0.0});
  }
}

/// The force of a torque, and the speeds and torques that its uncertainty depends on.
void put_torque_scale(const DynamicRadius& radius, const std::vector<MeanTorque>& means, TestedRoadLoad& tested) {
  tested.in_proportion_to_mass = false;
  tested.force_per_unit = kDrivelineFactor / radius.radius_m;
  tested.radius_speed_m_s = radius.speed_m_s;
  tested.wheel_speed_Hz = radius.wheel_speed_Hz;
  for (const MeanTorque& mean : means) tested.most_torque_Nm = std::max(tested.most_torque_Nm, mean.torque_Nm);
}

void doubt_torques(const TorqueFile& file, const std::vector<std::string>& windy, RoadLoadProcedure& procedure) {
  doubt_units(procedure);
  doubt_sessions(file.runs, windy, procedure);
  add_warnings(doubt_session_units(file.runs, list_resistances(file.runs, {}, procedure),
                                   {/*is_from_speeds=*/false, "reference_km_h and speed_km_h"}),
               procedure);
  doubt_recorded_conditions(file.runs, "wind_m_s", SlopeForce::kIncluded, procedure);
  const models::RoadLoad<double> load{procedure.road_load(0), procedure.road_load(1), procedure.road_load(2)};
  if (const auto doubt = doubt_torque_scale(load, procedure.correction.mass_kg, procedure.wheel_radius_m)) {
    procedure.warnings.push_back(*doubt);
  }
}

}  // namespace

RoadLoadProcedure evaluate_torque_meter(const std::string& path, const RoadLoadProcedureOptions& options,
                                        const std::vector<std::string>& sessions, BadRows bad_rows) {
  RoadLoadProcedure procedure;
  procedure.kind = RoadLoadProcedureKind::kTorqueMeter;
  put_masses(options, procedure);
  TorqueFile file = read_torque_file(path, bad_rows);
  select_torque_runs(options, sessions, file);
  leave_out_repeated_torques(file, procedure.warnings);
  std::vector<RoadLoadCheck> wind_checks;
  const std::vector<std::string> windy = check_winds(file.runs, kWltpWind, wind_checks);
  require_reference_speeds(path, file);
  const DynamicRadius radius = find_wheel_radius(path, file, options, procedure.warnings);
  procedure.wheel_radius_m = radius.radius_m;
  const double effective_kg = procedure.correction.mass_kg + procedure.rotating_mass_kg;
  const ReferenceTorques torques = find_reference_torques(file, options, effective_kg, radius.radius_m);
  require_driving_torques(path, file, torques.means);
  for (const ReferenceRun& run : torques.runs) procedure.run_names.push_back(run.name);
  put_torque_points(file, torques, procedure);
  put_reference_result(evaluate_reference_runs(torques.runs, torques.speeds_m_s, {false, 1.0, "torques"}, windy),
                       torques.speeds_m_s, procedure);
  put_used_conditions(file.runs, options, std::move(wind_checks), procedure);
  check_measurements(file, torques.means, procedure);
  check_reference_speeds(procedure);
  check_reference_precision(procedure);
  put_torque_scale(radius, torques.means, procedure.tested);
  finish_procedure(options, procedure);
  put_fitted(procedure);
  doubt_torques(file, windy, procedure);
  return procedure;
}

}  // namespace rollrig::estimation
