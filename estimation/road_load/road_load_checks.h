#pragma once
/// Whether coastdowns keep to what SAE J1263, J2263 and UN GTR 15 ask for, how they drift in a session, and how well
/// pairs of both headings repeat.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "estimation/road_load/road_load_fit.h"

namespace rollrig::estimation {

double calc_mean(const std::vector<double>& values);

/// Change of the times of a session from its first to its last run, headings averaged.
struct SessionDrift {
  std::string session;
  int runs = 0;
  double time_change = 0.0;  // relative, over the session
  double lower_95 = 0.0;
  double upper_95 = 0.0;
  double per_run = 0.0;
};

/// Statistical precision of the times of pairs through 10 km/h about a speed.
struct PairPrecision {
  double speed_m_s = 0.0;
  int pairs = 0;
  double mean_time_s = 0.0;
  double precision = 0.0;  // half-width of the 95 % interval over the mean
};

/// Line through the relative deviations of a session's runs, each heading with its own mean and its own share of
/// a change that the headings share with opposite signs (a wind that turns).
/// Equation  g_r = a_h + b x_r + c h x_r,  x from -1/2 to 1/2 over the session; time change = -b
/// Symbols   g_r mean of (force - fit)/L over the bins of a run, L road load as tested, without wind and slope;
///           h heading +1 or -1
/// Validity  two runs more than coefficients; least squares, Student's t
/// Checked   tests/estimation/road_load_checks_test.cpp
std::vector<SessionDrift> find_session_drifts(const CoastdownData& data, const RoadLoadFit& fit);

/// Mean relative deviation of each run that has points, weighted; g_r of find_session_drifts().
std::map<std::size_t, double> find_run_deviations(const RoadLoadFit& fit);

/// Equation  p = t s/(sqrt(n) mean), pair time 2/(1/dt_+ + 1/dt_-), t: Student's, two-sided 95 %
/// Source    70/220/EEC Annex III (the same form with 2 %); UN GTR 15 Annex 4, 4.3.1.4.2 (harmonized average, 3 %)
/// Checked   tests/estimation/road_load_checks_test.cpp
std::vector<PairPrecision> find_pair_precisions(const CoastdownData& data, const RoadLoadFit& fit);

enum class CheckStatus { kPass, kFail, kNotChecked };

struct RoadLoadCheck {
  std::string name;
  CheckStatus status = CheckStatus::kNotChecked;
  std::string found;   // with its unit; why, where it was not checked
  std::string limit;   // with its unit
  std::string clause;  // where the limit stands
};

struct RoadLoadChecks {
  std::vector<RoadLoadCheck> checks;
  std::vector<SessionDrift> drifts;
  std::vector<PairPrecision> precisions;
};

/// A question about air that is hotter than any test allows, as of degrees Fahrenheit.
/// Assumed: 40 degC on average; the procedures end at 35
std::optional<std::string> doubt_ambient(const CoastdownData& data);

/// The recorded slope against the limits of SAE J1263.
void check_slopes(const CoastdownData& data, std::vector<RoadLoadCheck>& checks);

RoadLoadChecks check_road_load(const CoastdownData& data, const RoadLoadFit& fit);

}  // namespace rollrig::estimation
