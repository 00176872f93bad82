#include "diagnosis/comparison/black_box.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "diagnosis/kinds/measurement_kind.h"

namespace rollrig::diagnosis {
namespace {

constexpr Eigen::Index kFeatures = 13;

/// Features of every block of a series, before standardizing.
Eigen::MatrixXd find_features(const PreparedSet& set, const Series& series) {
  const PreparedRun& run = set.runs()[series.run];
  const double start_s = run.measured.time_s.front();
  const double skim_limit_N = set.kind().skim_limit_N(set.source(run.machine));
  Eigen::MatrixXd features(to_index(series.size()), kFeatures);
  for (std::size_t k = 0; k < series.size(); ++k) {
    const auto mean = [&](const Quantity& input) { return find_mean_input(set, series, k, input); };
    const double speed = mean(models::quantities::kSpeed) / 20.0;
    const double load = mean(models::quantities::kLoad) / 5000.0;
    const double skim = mean(models::quantities::kLoad) <= skim_limit_N ? 1.0 : 0.0;
    const double elapsed_s = series.time_s[k] - start_s;
    const double in_phase_s = series.time_s[k] - run.measured.time_s[run.phases[series.phase[k]].first];
    features.row(to_index(k)) << 1.0, speed, speed * speed, load, load * speed, skim,
        (mean(models::quantities::kAmbient) - 298.15) / 5.0, (run.measured.initial_tire_temperature_K - 298.15) / 10.0,
        (run.measured.cold_pressure_Pa - 2.5e5) / 5e4, std::exp(-elapsed_s / 300.0), std::exp(-elapsed_s / 1200.0),
        std::exp(-in_phase_s / 300.0), std::exp(-in_phase_s / 1200.0);
  }
  return features;
}

}  // namespace

Eigen::VectorXd subtract_black_box(const PreparedSet& set, const Eigen::VectorXd& difference, std::size_t run) {
  Eigen::VectorXd rest = difference;
  for (std::size_t channel = 0; channel < set.channels().size(); ++channel) {
    Eigen::MatrixXd curvature = Eigen::MatrixXd::Identity(kFeatures, kFeatures);
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(kFeatures);
    for (const Series& series : set.series()) {
      if (series.channel != channel || series.run == run) continue;
      const Eigen::MatrixXd features = find_features(set, series);
      curvature += features.transpose() * features;
      gradient += features.transpose() * series.rows_of(difference) / series.floor;
    }
    const Eigen::VectorXd weights = curvature.llt().solve(gradient);
    for (const Series& series : set.series()) {
      if (series.channel != channel || series.run != run) continue;
      series.rows_of(rest) -= series.floor * (find_features(set, series) * weights);
    }
  }
  return rest;
}

}  // namespace rollrig::diagnosis
