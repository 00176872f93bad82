#pragma once
/// A, B, C of a vehicle from its coastdowns.

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "estimation/road_load/coastdown_file.h"
#include "estimation/run_checks/run_doubt.h"
#include "include/rollrig/fit_options.h"
#include "models/vehicle/road_load.h"

namespace rollrig::estimation {

using rollrig::RoadLoadBounds, rollrig::RoadLoadFitOptions;

/// Effective mass over test mass where the rotating mass is not known. Source: SAE J2263, light-duty vehicles.
constexpr double kDefaultEffectiveRatio = 1.03;

/// The test mass; where it is not given, what belongs to that effective mass.
inline double find_test_mass_kg(const RoadLoadFitOptions& options, double effective_mass_kg) {
  return options.mass_kg.value_or(effective_mass_kg / kDefaultEffectiveRatio);
}

/// Air density at the reference conditions: p/(R T), 1.167 kg/m3 by default (40 CFR 1066.310: 1.17).
double calc_reference_density_kg_m3(const RoadLoadFitOptions& options);

/// One point of the residual plot: the mean force over a speed bin. Forces per unit of mass where no mass is given.
struct RoadLoadPoint {
  std::size_t run = 0;
  double high_m_s = 0.0;
  double low_m_s = 0.0;
  double duration_s = 0.0;
  double speed_m_s = 0.0;   // mean over the time in the bin
  double force_N = 0.0;     // m dv/dt, as tested
  double fit_N = 0.0;       // as tested, with wind, slope and weather
  double residual_N = 0.0;  // force - fit
  double sd_N = 0.0;        // of one point, by the scatter found but that of sessions; weight = 1/sd^2
};

/// Scatter that the fit found. Those that the data cannot decide are absent.
struct RoadLoadScatter {
  std::optional<double> sample_sd_m_s;        // of one speed sample, within cells of a trace
  std::optional<double> speed_sd_m_s;         // of one sample (trace) or of one passing (bins)
  std::optional<double> gust_N_sqrt_s;        // white force along a run: sd of its mean over T is this / sqrt(T)
  std::optional<double> run_force_N;          // force from run to run
  std::optional<double> run_speed_N_s_per_m;  // force in proportion to speed, from run to run
  std::optional<double> session_force_N;      // force from session to session, alike at all speeds
  std::optional<double> session_share;        // instead of it: share of the force, alike at all speeds
};

struct RoadLoadEstimate {
  models::RoadLoad<double> load;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // of A, B, C in SI units

  std::array<double, 3> values() const { return {load.A_N, load.B_N_s_per_m, load.C_N_s2_per_m2}; }
  double sd(int i) const;
  double force_N(double speed_m_s) const { return models::calc_road_load_N(load, speed_m_s); }
  double force_sd_N(double speed_m_s) const;
};

struct SessionWind {
  std::string session;
  double wind_m_s = 0.0;  // beyond the measured one; positive against the + heading
  double sd_m_s = 0.0;
};

struct HeadingFit {
  int heading = 0;
  int runs = 0;
  RoadLoadEstimate estimate;
};

struct RoadLoadFit : RoadLoadEstimate {     // at reference conditions
  std::array<double, 3> degrees_freedom{};  // of the intervals of A, B, C
  std::array<bool, 3> on_bound{};
  std::optional<RoadLoadBounds> bounds;
  std::array<std::array<double, 2>, 3> free_interval_95{};  // as without bounds
  models::RoadLoad<double> as_tested;                       // at the mean weather of the test, no wind
  bool per_mass = false;
  double effective_mass_kg = 1.0;
  bool ambient_corrected = false;
  bool wind_corrected = false;
  std::optional<double> slope;  // beyond the measured one; uphill in the + heading
  double slope_sd = 0.0;
  std::vector<SessionWind> winds;
  RoadLoadScatter scatter;
  std::vector<HeadingFit> headings;
  std::vector<RoadLoadPoint> points;
  double high_m_s = 0.0;  // speeds that the data cover
  double low_m_s = 0.0;
  double chi2_per_dof = 0.0;
  int iterations = 0;
  std::vector<std::string> warnings;
  std::vector<RunDoubt> doubts;               // of fit_checked_road_load()
  std::shared_ptr<const RoadLoadFit> others;  // likewise: the fit without the runs in doubt

  /// Interval of 95 % of A, B or C, by Student's t, cut at the bounds. Of one on its bound it begins there, and reaches
  /// as far as that without bounds.
  std::array<double, 2> interval_95(int i) const;
  /// Whether the interval was cut at a bound.
  bool is_cut(int i) const;
};

/// Generalized least squares on mean forces over speed bins.
/// Equation  time through a bin T = int m dv / F(v);  force of the bin f = m (v_hi - v_lo) / dt;
///           F(v) = k (A + B v) + q C (v + h w)^2 + h (m g s + d_0 + d_1 v) + d_1^2/(4 C)
///           k = 1/(1 + K_0 (T_amb - T_0)), q = rho/rho_0, rho = p/(R T)
///           covariance: passing times shared by neighboring bins, gusts, run to run (constant, in
///           proportion to speed), session to session (constant, or in proportion to the force where that is 20
///           times as likely), by restricted maximum likelihood
/// Symbols   m effective mass [kg]; h heading +1 or -1; w wind against + [m/s]; s slope; d_0 [N], d_1 [N s/m]
///           what slope and wind remain, d_1 = 2 C times the wind of a session; K_0 [1/K]; rho air density [kg/m3]
/// Validity  F > 0 at every speed of the data; coasting throughout, no braking; wind below the speed
/// Errors    InputError: fewer than four bins, or no mass where one is needed; RunFailure: A, B, C not decided
///           by the speeds, no convergence
/// Source    SAE J2263 and UN GTR 15 Annex 4 for model and corrections; Harville 1977 for the scatter
/// Checked   tests/estimation/road_load_fit_test.cpp, tests/estimation/road_load_coverage_test.cpp
RoadLoadFit fit_road_load(const CoastdownData& data, const RoadLoadFitOptions& options);

}  // namespace rollrig::estimation
