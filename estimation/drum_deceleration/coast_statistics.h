#pragma once
/// Statistics of decelerations over runs: what a level, a ratio and an exponent are worth.

#include <Eigen/Dense>

#include "estimation/drum_deceleration/drum_coastdown.h"

namespace rollrig::estimation {

/// A part of a variance with its degrees of freedom.
struct VariancePart {
  double variance = 0.0;
  double freedom = 0.0;
};

/// Interval of a value whose variance is the sum of independent parts.
Interval make_interval(double value, const std::vector<VariancePart>& parts);

/// One state's and body's decelerations, runs by speeds; NaN where not available.
struct RunTable {
  std::vector<std::size_t> runs;  // index in the set
  Eigen::MatrixXd value_m_s2;     // run, speed
  Eigen::MatrixXd sd_m_s2;
};

RunTable collect(const CoastSet& set, const std::vector<CoastAnalysis>& analyses, CoastState state, CoastBody body);

/// A mean over runs, with what is needed to carry its uncertainty on.
struct MeanOfRuns {
  std::size_t runs = 0;
  double mean = 0.0;
  double sd = 0.0;  // of a single run
  VariancePart of_mean;
};

/// Mean of a column; with one run its own standard deviation stands in, with no limit of freedom.
MeanOfRuns calc_mean(const RunTable& table, Eigen::Index speed);
/// Covariance of the means of two columns, over runs that have both.
double calc_mean_covariance(const RunTable& table, Eigen::Index speed_1, Eigen::Index speed_2);

/// Loaded runs of one set grouped by pressure and load.
struct Levels {
  std::vector<double> pressures_Pa;
  std::vector<double> loads_N;                  // 0 where not known
  std::vector<std::vector<Eigen::Index>> rows;  // of the loaded table
};
Levels group_by_pressure(const CoastSet& set, const RunTable& loaded);
/// The levels of the load that most runs have.
Levels keep_main_load(const Levels& levels);

/// Means of the levels at one speed and the scatter of runs about them, pooled.
struct LoadedScatter {
  std::vector<double> means_m_s2;  // NaN where no run passes
  std::vector<int> counts;
  VariancePart single_run;  // freedom 0: no pressure was run twice, the variance is that within runs
};
LoadedScatter calc_loaded_scatter(const RunTable& loaded, const Levels& levels, Eigen::Index speed);
/// Covariance of a single run's decelerations at two speeds, pooled in the same way.
double calc_run_covariance(const RunTable& loaded, const Levels& levels, Eigen::Index speed_1, Eigen::Index speed_2);

}  // namespace rollrig::estimation
