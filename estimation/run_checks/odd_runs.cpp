#include "estimation/run_checks/odd_runs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include <boost/math/distributions/students_t.hpp>

#include "estimation/run_checks/robust_statistics.h"

namespace rollrig::estimation {
namespace {

constexpr std::size_t kBands = 4;

/// Level and slope of one run's deviations.
struct RunLine {
  double level = 0.0;
  double slope = 0.0;
  double spread = 0.0;  // sum of squares of x about its mean
  std::vector<double> rest;
};

/// Scatter of the runs of a group.
struct GroupScatter {
  double middle_m_s = 0.0;  // x = (v - middle)/half
  double half_m_s = 1.0;
  double run2 = 0.0;
  double slope2 = 0.0;
  std::array<double, kBands> along2{};  // by bands of speed
  double freedom = 1.0;

  double x(double speed_m_s) const { return (speed_m_s - middle_m_s) / half_m_s; }
  std::size_t band(double speed_m_s) const {
    const double share = std::clamp(0.5 * (x(speed_m_s) + 1.0), 0.0, 0.999);
    return static_cast<std::size_t>(share * static_cast<double>(kBands));
  }
};

RunLine fit_line(const RunDeviation& run, const GroupScatter& group) {
  const auto n = static_cast<double>(run.relative.size());
  RunLine line;
  double mean_x = 0.0;
  for (std::size_t i = 0; i < run.relative.size(); ++i) {
    mean_x += group.x(run.speed_m_s[i]) / n;
    line.level += run.relative[i] / n;
  }
  double products = 0.0;
  for (std::size_t i = 0; i < run.relative.size(); ++i) {
    const double x = group.x(run.speed_m_s[i]) - mean_x;
    line.spread += x * x;
    products += x * (run.relative[i] - line.level);
  }
  if (run.relative.size() > 2 && line.spread > 0.0) line.slope = products / line.spread;
  const double lost = run.relative.size() > 2 ? 2.0 : 1.0;
  for (std::size_t i = 0; i < run.relative.size() && n > lost; ++i) {
    const double fitted = line.level + line.slope * (group.x(run.speed_m_s[i]) - mean_x);
    line.rest.push_back((run.relative[i] - fitted) * std::sqrt(n / (n - lost)));
  }
  return line;
}

double square(double value) { return value * value; }

GroupScatter find_scatter(const std::vector<const RunDeviation*>& runs, const ScatterPrior& prior) {
  constexpr double kLeastAlong = 1e-3;
  constexpr double kMedianToSd = 1.4826;
  constexpr std::size_t kFewestInBand = 12;
  GroupScatter group;
  double high = 0.0, low = 1e9;
  for (const RunDeviation* run : runs) {
    high = std::max(high, run->speed_m_s.front());
    low = std::min(low, run->speed_m_s.back());
  }
  group.middle_m_s = 0.5 * (high + low);
  group.half_m_s = std::max(0.5 * (high - low), 1e-3);
  std::vector<double> levels, slopes, slope_noise, rest;
  std::array<std::vector<double>, kBands> rest_in_band;
  for (const RunDeviation* run : runs) {
    const RunLine line = fit_line(*run, group);
    levels.push_back(line.level);
    if (line.spread > 0.0) {
      slopes.push_back(line.slope);
      slope_noise.push_back(1.0 / line.spread);
    }
    for (std::size_t i = 0; i < line.rest.size(); ++i) {
      rest.push_back(std::abs(line.rest[i]));
      rest_in_band[group.band(run->speed_m_s[i])].push_back(rest.back());
    }
  }
  // about zero: the deviations are from what the others say
  const double along = std::max(kLeastAlong, kMedianToSd * calc_median(rest));
  for (std::size_t band = 0; band < kBands; ++band) {
    const bool enough = rest_in_band[band].size() >= kFewestInBand;
    group.along2[band] = square(enough ? std::max(along, kMedianToSd * calc_median(rest_in_band[band])) : along);
  }
  group.slope2 = std::max(0.0, square(calc_mad_sd(slopes)) - square(along) * calc_median(slope_noise));
  const double freedom = std::max(0.0, static_cast<double>(runs.size()) - 2.0);
  group.freedom = prior.freedom + freedom;
  group.run2 = (prior.freedom * square(prior.run_sd) + freedom * square(calc_mad_sd(levels))) / group.freedom;
  return group;
}

/// The stretch of one run with the largest deviation by its own standard deviation.
OddRun find_largest_stretch(const RunDeviation& run, const GroupScatter& group) {
  constexpr std::size_t kFewestNeighbors = 2;  // Assumed: one value alone may be a slip, not a run
  constexpr double kWholeShare = 0.9;          // Assumed
  OddRun largest, whole;
  largest.run = run.run;
  const std::size_t n = run.relative.size();
  const std::size_t shortest = std::min(n, kFewestNeighbors);
  for (std::size_t first = 0; first < n; ++first) {
    double sum = 0.0, sum_x = 0.0, along2 = 0.0;
    for (std::size_t last = first; last < n; ++last) {
      sum += run.relative[last];
      sum_x += group.x(run.speed_m_s[last]);
      along2 += group.along2[group.band(run.speed_m_s[last])];
      const auto count = static_cast<double>(last - first + 1);
      const double variance = group.run2 + group.slope2 * square(sum_x / count) + along2 / count / count;
      const double sds = sum / count / std::sqrt(variance);
      if (last + 1 - first < shortest) continue;
      const bool is_whole = first == 0 && last + 1 == n;
      const OddRun stretch{run.run, sum / count, run.speed_m_s[first], run.speed_m_s[last], is_whole, sds};
      if (is_whole) whole = stretch;
      if (std::abs(sds) > std::abs(largest.sds)) largest = stretch;
    }
  }
  // noise alone makes some part of a run deviate more than the whole
  return std::abs(whole.sds) > kWholeShare * std::abs(largest.sds) ? whole : largest;
}

}  // namespace

std::optional<OddRun> find_odd_run(const std::vector<RunDeviation>& deviations, const ScatterPrior& prior) {
  std::map<std::size_t, std::vector<const RunDeviation*>> groups;
  std::size_t values = 0;
  for (const RunDeviation& run : deviations) {
    if (run.relative.empty()) continue;
    groups[run.group].push_back(&run);
    values += run.relative.size();
  }
  std::optional<OddRun> oddest;
  double most = 1.0;  // over the limit of its group
  for (const auto& [name, runs] : groups) {
    if (runs.size() < prior.fewest) continue;
    const GroupScatter scatter = find_scatter(runs, prior);
    const boost::math::students_t student(scatter.freedom);
    const double limit =
        boost::math::quantile(boost::math::complement(student, prior.alarms / (2.0 * static_cast<double>(values))));
    for (const RunDeviation* run : runs) {
      const OddRun stretch = find_largest_stretch(*run, scatter);
      if (std::abs(stretch.sds) <= most * limit) continue;
      most = std::abs(stretch.sds) / limit;
      oddest = stretch;
    }
  }
  return oddest;
}

}  // namespace rollrig::estimation
