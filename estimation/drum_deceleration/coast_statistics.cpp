#include "estimation/drum_deceleration/coast_statistics.h"

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rollrig::estimation {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kMostFreedom = 1e6;  // as good as the normal distribution

}  // namespace

Interval make_interval(double value, const std::vector<VariancePart>& parts) {
  Interval interval;
  interval.value = value;
  double variance = 0.0;
  double spread = 0.0;
  for (const VariancePart& part : parts) {
    variance += part.variance;
    if (part.freedom > 0.0) spread += part.variance * part.variance / part.freedom;
  }
  interval.sd = std::sqrt(variance);
  interval.freedom = spread > 0.0 ? std::min(kMostFreedom, variance * variance / spread) : kMostFreedom;
  const boost::math::students_t_distribution<double> student(interval.freedom);
  const double reach = boost::math::quantile(student, 0.975) * interval.sd;
  interval.lower = value - reach;
  interval.upper = value + reach;
  return interval;
}

RunTable collect(const CoastSet& set, const std::vector<CoastAnalysis>& analyses, CoastState state, CoastBody body) {
  std::vector<const CoastAnalysis*> chosen;
  for (const CoastAnalysis& analysis : analyses) {
    if (analysis.body == body && set.runs[analysis.run].state == state) chosen.push_back(&analysis);
  }
  const auto speeds = static_cast<Eigen::Index>(set.speeds_m_s.size());
  const auto runs = static_cast<Eigen::Index>(chosen.size());
  RunTable table{{}, Eigen::MatrixXd::Constant(runs, speeds, kNone), Eigen::MatrixXd::Constant(runs, speeds, kNone)};
  for (Eigen::Index run = 0; run < runs; ++run) {
    const CoastAnalysis& analysis = *chosen[static_cast<std::size_t>(run)];
    table.runs.push_back(analysis.run);
    for (Eigen::Index speed = 0; speed < speeds; ++speed) {
      const DecelerationFit& fit = analysis.decelerations[static_cast<std::size_t>(speed)];
      if (!fit.available) continue;
      table.value_m_s2(run, speed) = fit.value_m_s2;
      table.sd_m_s2(run, speed) = fit.sd_m_s2;
    }
  }
  return table;
}

MeanOfRuns calc_mean(const RunTable& table, Eigen::Index speed) {
  MeanOfRuns mean;
  double within = 0.0;
  for (Eigen::Index run = 0; run < table.value_m_s2.rows(); ++run) {
    if (std::isnan(table.value_m_s2(run, speed))) continue;
    ++mean.runs;
    mean.mean += table.value_m_s2(run, speed);
    within += table.sd_m_s2(run, speed) * table.sd_m_s2(run, speed);
  }
  if (mean.runs == 0) return mean;
  const auto n = static_cast<double>(mean.runs);
  mean.mean /= n;
  double squares = 0.0;
  for (Eigen::Index run = 0; run < table.value_m_s2.rows(); ++run) {
    if (std::isnan(table.value_m_s2(run, speed))) continue;
    squares += std::pow(table.value_m_s2(run, speed) - mean.mean, 2);
  }
  if (mean.runs == 1) {
    mean.sd = std::sqrt(within);
    mean.of_mean = {within, kMostFreedom};
  } else {
    mean.sd = std::sqrt(squares / (n - 1.0));
    mean.of_mean = {mean.sd * mean.sd / n, n - 1.0};
  }
  return mean;
}

double calc_mean_covariance(const RunTable& table, Eigen::Index speed_1, Eigen::Index speed_2) {
  if (speed_1 == speed_2) return calc_mean(table, speed_1).of_mean.variance;
  const MeanOfRuns mean_1 = calc_mean(table, speed_1);
  const MeanOfRuns mean_2 = calc_mean(table, speed_2);
  double products = 0.0;
  int both = 0;
  for (Eigen::Index run = 0; run < table.value_m_s2.rows(); ++run) {
    const double a = table.value_m_s2(run, speed_1);
    const double b = table.value_m_s2(run, speed_2);
    if (std::isnan(a) || std::isnan(b)) continue;
    products += (a - mean_1.mean) * (b - mean_2.mean);
    ++both;
  }
  return both < 2 ? 0.0 : products / (both - 1) / both;
}

Levels group_by_pressure(const CoastSet& set, const RunTable& loaded) {
  Levels levels;
  std::vector<Eigen::Index> order(loaded.runs.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Eigen::Index>(i);
  const auto pressure_of = [&](Eigen::Index row) {
    return set.runs[loaded.runs[static_cast<std::size_t>(row)]].pressure_Pa;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return pressure_of(a) < pressure_of(b); });
  for (const Eigen::Index row : order) {
    const double pressure_Pa = pressure_of(row);
    const double load_N = set.runs[loaded.runs[static_cast<std::size_t>(row)]].load_N;
    std::size_t level = 0;
    while (level < levels.rows.size() && (pressure_Pa > (1.0 + kSamePressure) * levels.pressures_Pa[level] ||
                                          !is_same_load(load_N, levels.loads_N[level]))) {
      ++level;
    }
    if (level == levels.rows.size()) {
      levels.pressures_Pa.push_back(pressure_Pa);
      levels.loads_N.push_back(load_N);
      levels.rows.emplace_back();
    }
    levels.rows[level].push_back(row);
  }
  return levels;
}

Levels keep_main_load(const Levels& levels) {
  std::size_t main = 0;
  std::size_t most = 0;
  for (std::size_t i = 0; i < levels.rows.size(); ++i) {
    std::size_t runs = 0;
    for (std::size_t k = 0; k < levels.rows.size(); ++k) {
      if (is_same_load(levels.loads_N[k], levels.loads_N[i])) runs += levels.rows[k].size();
    }
    if (runs <= most) continue;
    most = runs;
    main = i;
  }
  Levels kept;
  for (std::size_t i = 0; i < levels.rows.size(); ++i) {
    if (!is_same_load(levels.loads_N[i], levels.loads_N[main])) continue;
    kept.pressures_Pa.push_back(levels.pressures_Pa[i]);
    kept.loads_N.push_back(levels.loads_N[i]);
    kept.rows.push_back(levels.rows[i]);
  }
  return kept;
}

LoadedScatter calc_loaded_scatter(const RunTable& loaded, const Levels& levels, Eigen::Index speed) {
  LoadedScatter scatter;
  double squares = 0.0;
  double within = 0.0;
  int runs = 0;
  int passed = 0;
  for (const std::vector<Eigen::Index>& rows : levels.rows) {
    double sum = 0.0;
    int count = 0;
    for (const Eigen::Index row : rows) {
      if (std::isnan(loaded.value_m_s2(row, speed))) continue;
      sum += loaded.value_m_s2(row, speed);
      within += std::pow(loaded.sd_m_s2(row, speed), 2);
      ++count;
    }
    const double mean = count > 0 ? sum / count : kNone;
    for (const Eigen::Index row : rows) {
      if (!std::isnan(loaded.value_m_s2(row, speed))) squares += std::pow(loaded.value_m_s2(row, speed) - mean, 2);
    }
    scatter.means_m_s2.push_back(mean);
    scatter.counts.push_back(count);
    runs += count;
    passed += count > 0 ? 1 : 0;
  }
  const int freedom = runs - passed;
  scatter.single_run = freedom > 0 ? VariancePart{squares / freedom, static_cast<double>(freedom)}
                                   : VariancePart{runs > 0 ? within / runs : 0.0, 0.0};
  return scatter;
}

double calc_run_covariance(const RunTable& loaded, const Levels& levels, Eigen::Index speed_1, Eigen::Index speed_2) {
  const LoadedScatter scatter_1 = calc_loaded_scatter(loaded, levels, speed_1);
  const LoadedScatter scatter_2 = calc_loaded_scatter(loaded, levels, speed_2);
  if (speed_1 == speed_2) return scatter_1.single_run.variance;
  const double freedom = std::min(scatter_1.single_run.freedom, scatter_2.single_run.freedom);
  if (freedom <= 0.0) return 0.0;
  double products = 0.0;
  for (std::size_t level = 0; level < levels.rows.size(); ++level) {
    for (const Eigen::Index row : levels.rows[level]) {
      const double a = loaded.value_m_s2(row, speed_1);
      const double b = loaded.value_m_s2(row, speed_2);
      if (std::isnan(a) || std::isnan(b)) continue;
      products += (a - scatter_1.means_m_s2[level]) * (b - scatter_2.means_m_s2[level]);
    }
  }
  return products / freedom;
}

}  // namespace rollrig::estimation
