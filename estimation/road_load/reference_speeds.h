#pragma once
/// Measurements at reference speeds in both headings: pairs, split runs, statistical precision, and three coefficients.

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "estimation/road_load/reference_pairs.h"

namespace rollrig::estimation {

/// How the pairs agree at one reference speed.
struct ReferencePrecision {
  int pairs = 0;
  double mean = 0.0;       // of the pairs' values
  double sd = 0.0;         // of one pair's value
  double precision = 0.0;  // h sd/(sqrt(pairs) mean)
};

/// Values of pairs at a speed: how two runs give one, and what the resistance is then.
struct PairRule {
  bool harmonic = false;   // 2/(1/a + 1/b) of times; else the mean
  double numerator = 1.0;  // resistance = numerator/value of times; else numerator * value
  const char* quantity = "coastdown times";

  double join(double plus, double minus) const;
  double resistance(double value) const { return harmonic ? numerator / value : numerator * value; }
};

struct ReferenceResult {
  std::vector<int> speeds;                     // reference speeds in km/h, falling
  std::vector<ReferencePair> pairs;            // with the speeds that are used
  std::vector<ReferencePrecision> precisions;  // by speed
  std::vector<double> resistances;             // by speed
  std::vector<int> overlaps;                   // speeds in km/h that parts of split runs share
  std::vector<double> overlap_differences;     // of the resistances there, lower part less upper part
  Eigen::Vector3d coefficients = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Eigen::Vector3d freedom = Eigen::Vector3d::Zero();
  bool has_session_scatter = false;  // whether the covariance has a part of sessions, since they differ
  std::vector<std::string> warnings;

  /// Runs of the pairs that are not rejected, rising.
  std::vector<std::size_t> list_used_runs() const;
};

/// Coefficient of the statistical precision for so many pairs, at least two.
/// Equation  h: Student's t, two-sided 95 %, n - 1 degrees of freedom, to one decimal; 2.5 for n = 7
/// Source    table of 70/220/EEC Annex III for n = 4 to 15, as Racelogic prints it (racelogic.support, Coastdown test
///           theory; its 2.2 for n = 10 contradicts its own t/sqrt(n) = 0.73, so 2.3). For other n: Student's t
/// Checked   tests/estimation/reference_speeds_test.cpp
double calc_precision_coefficient(int pairs);

/// Equation  p = h s/(sqrt(n) mean)
/// Source    UN GTR 15 Annex 4, 4.3.1.4.2 (docs/road_load_procedures.md: not from the text)
/// Checked   tests/estimation/reference_speeds_test.cpp
ReferencePrecision calc_precision(const std::vector<double>& values);

/// Pairs of the runs, statistical precision, resistance at each speed, and f0, f1, f2 by least squares over the speeds.
///
/// A pair counts at the speeds that both of its runs have. Speeds are those of ReferenceChoice. Where the precision is
/// not met, the pair farthest from the mean is rejected, as long as three pairs stay at each speed and at most a third
/// of all is rejected.
/// Equation  F_j mean over the n_j pairs with speed j;  f = sum_j H_j F_j,  H = (X'X)^-1 X',  X = [1 v v^2]
///           covariance sum_i e_i e_i',  e_i = sum_j H_j (F_ij - F_j)/sqrt(n_j (n_j - 1)) over the speeds of pair i
///           where sessions differ (one-way analysis of variance of the pairs, p < 0.01)
///           + (n - 1)/n k/(k - 1) sum_s E_s E_s',  E_s sum of e_i over the pairs of session s;
///           k - 1 degrees of freedom
/// Symbols   n pairs, k sessions; F_ij resistance of pair i at speed j. Of pairs with all speeds, the first sum is the
///           covariance of their mean, and the second one is that of the mean of their sessions
/// Validity  pairs independent of each other; freedom by Welch and Satterthwaite, with the shares of the pairs in the
///           variance as if all resistances scattered alike. The covariance of speeds that share few pairs comes out
///           small, by a third where they share one of three
/// Errors    InputError: one heading alone, fewer than three pairs or fewer than four speeds
/// Source    UN GTR 15 Annex 4, 4.3.1.3 and 4.3.1.4; Welch, Biometrika 34 (1947) 28
/// Checked   tests/estimation/reference_speeds_test.cpp, tests/estimation/wltp_coverage_test.cpp
ReferenceResult evaluate_reference_runs(const std::vector<ReferenceRun>& runs, const std::map<int, double>& speeds_m_s,
                                        const PairRule& rule, const std::vector<std::string>& windy);

}  // namespace rollrig::estimation
