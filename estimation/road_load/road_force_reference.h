#pragma once
/// What the other runs say of the force of a run: a robust road load, to find the odd one.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "estimation/road_load/coastdown_model.h"
#include "estimation/run_checks/odd_runs.h"

namespace rollrig::estimation {

/// Mean force over a bin.
struct BinForce {
  double speed_m_s = 0.0;  // the middle
  double force_N = 0.0;    // m dv/dt
};

/// Mean force over a bin; of a trace, by the mean speeds and times of the cells at its ends. Nothing if the speed does
/// not fall.
std::optional<BinForce> find_bin_force(const FitRun& run, const FitBin& bin, double mass_kg);

/// A road load through mean forces over bins that a few odd runs do not move.
/// Equation  f - offset(v) = L + h (d_0 + d_1s v), L = k (A + D_s + (B + E_s) v) + q (C + F_s) u|u|, Tukey's weights on
///           the residuals over L (c = 4.685 robust standard deviations), Huber's (c = 1.345) first
/// Symbols   f m dv/dt of a bin, at its middle speed v; u = v + h w; d_1s, D_s, E_s, F_s one for each session, the
///           last three where there are several; others as in fit_road_load()
/// Method    The terms of a session have a normal prior about 0, each of a standard deviation of 30 % of the force
///           (Assumed): a session may be far from the others, say in another unit, without an odd run, and where its
///           runs have no weight the prior holds it.
/// Validity  to look for deviations, not to estimate A, B, C: dv/dt is taken at the middle speed
/// Source    Holland and Welsch, Communications in Statistics A6 (1977) 813 (the weights)
/// Checked   tests/estimation/odd_runs_test.cpp
class RoadForceReference {
 public:
  /// From the runs for which `used` holds.
  RoadForceReference(const CoastdownData& data, const std::vector<FitRun>& runs, const std::vector<bool>& used,
                     double mass_kg);

  /// Force of the run less that of the reference, for each bin, over L, or over a fifth of the mean force if that is
  /// larger. L has no slope in it, so that the same scatter counts alike uphill and downhill. `place` is the place of the
  /// run among the runs.
  RunDeviation deviation_of(const FitRun& run, std::size_t place) const;

 private:
  struct Point {
    double speed_m_s = 0.0;
    double force_N = 0.0;
    Eigen::VectorXd factors;
    Eigen::VectorXd level_factors;  // without d_0 and d_1s; a recorded wind stays in u
  };
  std::vector<Point> list_points(const FitRun& run) const;
  Eigen::Index count_factors() const;
  void solve(const std::vector<Point>& points);

  const CoastdownData& data_;
  double mass_kg_;
  std::map<std::string, Eigen::Index> sessions_;
  Eigen::VectorXd coefficients_;
  double least_scale_N_ = 0.0;  // deviations are relative to L, or to this if it is larger
};

}  // namespace rollrig::estimation
