#pragma once
/// A road load by the procedure of a regulation or a standard: what all of them give.

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "estimation/road_load/coastdown_file.h"
#include "estimation/road_load/reference_conditions.h"
#include "estimation/road_load/reference_speeds.h"
#include "estimation/road_load/road_load_checks.h"
#include "estimation/road_load/session_units.h"
#include "estimation/run_checks/run_doubt.h"
#include "include/rollrig/road_load_options.h"

namespace rollrig::estimation {

/// A measured resistance at a speed, and the fitted one, as tested.
struct ProcedurePoint {
  std::string run;  // empty: of all runs
  int heading = 0;  // 0: of both
  double speed_m_s = 0.0;
  double measured = 0.0;  // N, or Nm
  double fitted = 0.0;
};

/// A coefficient beside f0, f1, f2.
struct FurtherCoefficient {
  std::string key;    // with its unit, as in files
  std::string label;  // in words
  double value = 0.0;
  double sd = 0.0;
};

struct RoadLoadProcedure {
  RoadLoadProcedureKind kind = RoadLoadProcedureKind::kWltp;
  bool is_simulated = false;                                // the recording is one of a simulation
  Eigen::Vector3d as_tested = Eigen::Vector3d::Zero();      // SI, of a force; of a torque by the torque-meter method
  Eigen::Vector3d corrected = Eigen::Vector3d::Zero();      // the same at reference conditions
  Eigen::Vector3d road_load = Eigen::Vector3d::Zero();      // of the force at reference conditions
  Eigen::Matrix3d repeatability = Eigen::Matrix3d::Zero();  // covariance of road_load by the scatter of the runs
  Eigen::Vector3d freedom = Eigen::Vector3d::Zero();        // of that
  TestedRoadLoad tested;                                    // of which road_load is the force at reference
  std::vector<SensorContribution> sensors;                  // to road_load
  std::vector<FurtherCoefficient> further;
  ReferenceCorrection correction;
  std::optional<double> wind_m_s;  // along the road, that both headings have; absent: not measured
  double rotating_mass_kg = 0.0;
  bool rotating_mass_assumed = false;
  double wheel_radius_m = 0.0;  // of the torque-meter method
  std::vector<std::string> run_names;
  ReferenceResult reference;  // of procedures with reference speeds
  std::vector<double> reference_speeds_m_s;
  std::vector<ProcedurePoint> points;
  std::vector<RoadLoadCheck> checks;
  std::vector<RunDoubt> doubts;  // of runs; their texts are among the warnings too
  std::vector<std::string> warnings;

  /// Standard deviation of a coefficient: scatter of the runs and accuracy of the sensors.
  double sd(int i) const;
  /// Its interval of 95 %, with the effective freedom of Welch and Satterthwaite (GUM, G.4).
  std::array<double, 2> interval_95(int i) const;
  double force_N(double speed_m_s) const;
  double force_sd_N(double speed_m_s) const;
};

/// Effective mass: that of the test and what rotates, 3 % of it where nothing else is known.
/// Source    Regulation (EU) 2017/1151, 2.5.1 of Sub-Annex 4: 3 % of the mass in running order and 25 kg; of which
///           only the mass as tested is known here
void put_masses(const RoadLoadProcedureOptions& options, RoadLoadProcedure& procedure);

/// Mean of a condition over the samples of runs; absent where a run does not have it.
std::optional<double> mean_of_condition(const CoastdownData& data, std::vector<double> CoastdownConditions::*member);

/// What a procedure allows of the wind.
struct WindLimits {
  double mean_m_s = 0.0;
  double peak_m_s = 0.0;
  double across_m_s = 0.0;
  const char* clause = "";
  const char* across_column = "crosswind_m_s";  // whose absence leaves the wind across unknown
};
constexpr WindLimits kWltpWind{5.0, 8.0, 2.0, "UN GTR 15 Annex 4, 4.1.1.1.1"};
/// Runs whose wind is above the limits, and a check of each limit over all runs.
std::vector<std::string> check_winds(const CoastdownData& data, const WindLimits& limits,
                                     std::vector<RoadLoadCheck>& checks);

/// The wind that opposite headings do not cancel: the lower of the means of the headings; absent where no run of one of
/// them has a wind.
/// Source    UN GTR 15 Annex 4, 4.5.3.1 (not from the text)
std::optional<double> find_common_wind(const CoastdownData& data);

/// What a procedure has of the air: its pressure of reference, and where the limits of the temperature stand.
struct AirRule {
  double reference_pressure_Pa = 0.0;
  const char* temperature_clause = "";
};
constexpr AirRule kWltpAir{100e3, "UN GTR 15 Annex 4, 4.1.1.2 (not from the text)"};
constexpr AirRule kSaeAir{98.21e3, "SAE J1263"};  // pressure: 40 CFR 1066.305

/// Those of the runs whose indices are given.
CoastdownData keep_runs(const CoastdownData& data, const std::vector<std::size_t>& runs);

/// Weather of the test and the pressure of reference; warns of what is missing. `data` are the runs that the result
/// rests on: rejected ones have no part in its correction.
void put_conditions(const CoastdownData& data, const RoadLoadProcedureOptions& options, const AirRule& rule,
                    RoadLoadProcedure& procedure);

/// Warns where wind and slope as recorded in `data` contradict what the points of both headings show, or, without a
/// recorded slope, where sessions contradict each other (doubt_session_headings()).
/// `column`: that of the winds; `slope_force`: of points with a recorded slope.
void doubt_recorded_conditions(const CoastdownData& data, const std::string& column, SlopeForce slope_force,
                               RoadLoadProcedure& procedure);

/// The points of each run as forces, but for the runs in `without`, by name.
std::vector<RunResistance> list_resistances(const CoastdownData& data, const std::vector<std::string>& without,
                                            const RoadLoadProcedure& procedure);

/// Warns where sessions differ, or cannot be compared: doubt_session_difference(), list_partial_sessions(). The points
/// of the runs in `without`, by name, do not count.
void doubt_sessions(const CoastdownData& data, const std::vector<std::string>& without, RoadLoadProcedure& procedure);

void add_warnings(const std::vector<std::string>& warnings, RoadLoadProcedure& procedure);

/// The result at the reference speeds, and its warnings. `speeds_m_s` are the speeds by their reference speed in km/h.
void put_reference_result(ReferenceResult result, const std::map<int, double>& speeds_m_s,
                          RoadLoadProcedure& procedure);
/// Weather of the runs that the result at the reference speeds rests on: put_conditions(), and the wind that their
/// headings do not cancel. `wind_checks` are those of check_winds().
void put_used_conditions(const CoastdownData& data, const RoadLoadProcedureOptions& options,
                         std::vector<RoadLoadCheck> wind_checks, RoadLoadProcedure& procedure);

/// Corrects `reference.coefficients` to the conditions of reference, with what `tested` says of force and mass, and
/// puts both there. The contributions of the sensors are there unless the options leave them out.
void finish_procedure(const RoadLoadProcedureOptions& options, RoadLoadProcedure& procedure);
/// Fills `fitted` of the points, from `as_tested`.
void put_fitted(RoadLoadProcedure& procedure);
/// The lowest and the highest reference speed against those of the WLTP.
void check_reference_speeds(RoadLoadProcedure& procedure);
/// Pairs and statistical precision against the limits of the WLTP.
void check_reference_precision(RoadLoadProcedure& procedure);

/// Warns of what doubt_road_load() finds, and of coefficients below 0.
/// Errors  InputError: a rolling loss that no vehicle has
void doubt_units(RoadLoadProcedure& procedure);

/// What orders the runs, one number each: their start where all runs have one, else the number that each is named by,
/// else their place in the file.
std::vector<double> find_positions(const CoastdownData& data);

/// As a run is named in messages.
std::string name_of_run(const CoastdownRun& run, const CoastdownData& data);

/// Coastdown times at reference speeds.
/// Equation  F_j = (m_av + m_r) 2 Delta v/Delta t_j,  Delta v = 5 km/h, 1/Delta t_j mean of 1/Delta t over runs of both
///           headings
/// Symbols   Delta t_j time from v_j + Delta v to v_j - Delta v; m_av, m_r masses [kg]
/// Validity  reference speeds 20, 30, ... km/h; the force is that over 10 km/h, at its middle speed
/// Errors    InputError: those of evaluate_reference_runs(), bins that do not end at v_j + 5 and v_j - 5 km/h
/// Source    UN GTR 15 Annex 4, 4.3.1.4; Regulation (EU) 2017/1151, 2.5.2 and 8.1.3.2 of Sub-Annex 4 (force)
/// Checked   tests/estimation/wltp_coastdown_test.cpp, tests/estimation/wltp_coverage_test.cpp
RoadLoadProcedure evaluate_wltp_coastdowns(const CoastdownFile& file, const RoadLoadProcedureOptions& options);

/// Regression on speed traces with the air flow at each sample.
/// Equation  -M dv/dt = k (A + B v) + 1/2 rho v_a^2 (a_0 + a_1 psi + ... ) + m g s h + h d_0
/// Symbols   M effective, m vehicle mass [kg]; v_a air speed [m/s], psi yaw angle [rad]; rho air density [kg/m3];
///           a_i drag area by powers of yaw [m2]; k factor of rolling loss; s slope; h heading; d_0 [N] slope that was
///           not measured
/// Validity  all of v^2 is drag of the air: the road load is A, B, 1/2 rho0 a_0
/// Errors    InputError: no air flow and no wind (J2263), an air speed in another unit, one heading alone, runs that
///           are too short, fewer than three pairs; RunFailure
/// Source    SAE J2263 and Regulation (EU) 2017/1151, 4.3.2.5 of Sub-Annex 4 (form of the equation; there also C_m,
///           which
///           still air does not tell from a_0); 40 CFR 1037.528 (air flow and grade)
/// Checked   tests/estimation/anemometer_test.cpp
RoadLoadProcedure evaluate_traces(const CoastdownFile& file, const RoadLoadProcedureOptions& options);

/// Torque of the driven wheels at reference speeds.
/// Equation  C = c0 + c1 v + c2 v^2 by least squares;  f = 1.02 c*/r'
/// Symbols   c* at reference conditions [Nm]; r' dynamic radius [m]; 1.02 losses of the driveline that are not between
///           wheel and torque meter
/// Errors    InputError: a wrong file, no radius, fewer than three pairs
/// Source    Regulation (EU) 2017/1151, 4.4 of Sub-Annex 4; conversion: UN GTR 15 Annex 4 (not from the text)
/// Checked   tests/estimation/torque_meter_test.cpp
RoadLoadProcedure evaluate_torque_meter(const std::string& path, const RoadLoadProcedureOptions& options,
                                        const std::vector<std::string>& sessions, BadRows bad_rows);

struct AirFlow {
  double speed_m_s = 0.0;
  double yaw_rad = 0.0;
};

/// Air speed and direction at the vehicle from those of the wind.
/// Equation  v_a = sqrt((v + w)^2 + c^2),  psi = atan2(c, v + w)
/// Symbols   v speed; w wind against the vehicle, c across it [m/s]
/// Source    40 CFR 1037.528(g)(2), (3), with its worked example
/// Checked   tests/estimation/anemometer_test.cpp
AirFlow calc_air_flow(double speed_m_s, double against_m_s, double across_m_s);

/// Force between two points of a coastdown, without that of the slope.
/// Equation  F = M_e (v_1 - v_2)/(t_2 - t_1) - m g (h_2 - h_1)/(D_2 - D_1)
/// Source    40 CFR 1037.528(h)(4), with its worked example
/// Checked   tests/estimation/anemometer_test.cpp
double calc_coastdown_force_N(double effective_mass_kg, double fall_m_s, double duration_s, double mass_kg,
                              double slope);

}  // namespace rollrig::estimation
