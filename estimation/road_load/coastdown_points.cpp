#include "estimation/road_load/coastdown_points.h"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>

#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

/// Sums over neighboring samples, for a line through them.
struct LineSums {
  double n = 0.0, t = 0.0, v = 0.0, tt = 0.0, tv = 0.0;

  void add(double time, double speed, double sign) {
    n += sign;
    t += sign * time;
    v += sign * speed;
    tt += sign * time * time;
    tv += sign * time * speed;
  }
  double at(double time) const {
    const double spread = tt - t * t / n;
    const double mean = v / n;
    return spread > 1e-9 ? mean + (tv - t * v / n) / spread * (time - t / n) : mean;
  }
};

/// Lines through some seconds to either side, to say which cell a sample belongs to. Shorter ones would sort
/// samples by their noise.
std::vector<double> smooth(const CoastdownRun& run) {
  constexpr double kHalfWindow_s = 3.0;  // Assumed
  const std::size_t n = run.time_s.size();
  std::vector<double> smoothed(n);
  LineSums sums;
  std::size_t first = 0;
  std::size_t end = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double now = run.time_s[i];
    const auto time = [&](std::size_t k) { return run.time_s[k] - run.time_s[0]; };
    while (end < n && run.time_s[end] <= now + kHalfWindow_s) {
      sums.add(time(end), run.speed_m_s[end], 1.0);
      ++end;
    }
    while (run.time_s[first] < now - kHalfWindow_s) {
      sums.add(time(first), run.speed_m_s[first], -1.0);
      ++first;
    }
    smoothed[i] = sums.at(time(i));
  }
  return smoothed;
}

/// Samples [first, end) in which the vehicle coasts; `smoothed` is made to fall there.
struct Range {
  std::size_t first = 0;
  std::size_t end = 0;
};
Range find_coast(std::vector<double>& smoothed, double low_m_s) {
  constexpr double kRise_m_s = 0.3;  // Assumed: more than noise, less than any acceleration
  Range range;
  const double top = *std::max_element(smoothed.begin(), smoothed.end());
  for (std::size_t i = 0; i < smoothed.size(); ++i) {
    if (smoothed[i] >= top - 1e-12) range.first = i;
  }
  double lowest = top;
  for (range.end = range.first; range.end < smoothed.size(); ++range.end) {
    double& speed = smoothed[range.end];
    if (speed > lowest + kRise_m_s || speed < low_m_s) break;
    lowest = std::min(lowest, speed);
    speed = lowest;
  }
  return range;
}

SpeedCell make_cell(const CoastdownRun& run, std::size_t first, std::size_t end, double nominal_m_s) {
  SpeedCell cell;
  cell.nominal_speed_m_s = nominal_m_s;
  cell.first_sample = first;
  cell.end_sample = end;
  cell.samples = static_cast<int>(end - first);
  const double n = cell.samples;
  cell.length_s = (run.time_s[end - 1] - run.time_s[first]) * n / (n - 1.0);
  for (std::size_t i = first; i < end; ++i) {
    cell.mean_time_s += (run.time_s[i] - run.time_s[first]) / n;
    cell.mean_speed_m_s += run.speed_m_s[i] / n;
  }
  cell.mean_time_s += run.time_s[first];
  double across = 0.0;
  for (std::size_t i = first; i < end; ++i) {
    const double s = run.time_s[i] - cell.mean_time_s;
    const double dv = run.speed_m_s[i] - cell.mean_speed_m_s;
    cell.time_moment_2_s2 += s * s / n;
    cell.time_moment_3_s3 += s * s * s / n;
    across += s * dv;
    cell.scatter_m2_s2 += dv * dv;
  }
  if (cell.time_moment_2_s2 > 0.0) cell.scatter_m2_s2 -= across * across / (n * cell.time_moment_2_s2);
  return cell;
}

/// The samples [first, end) of `coast` that the parabola about a speed is fitted to.
Range find_window(const std::vector<double>& smoothed, const Range& coast, double speed_m_s) {
  constexpr double kHalf_m_s = 2.5 / kKmhPerMs;
  constexpr double kWidest_m_s = 10.0 / kKmhPerMs;
  constexpr std::size_t kWanted = 5;
  const auto distance = [&](std::size_t i) { return std::abs(smoothed[i] - speed_m_s); };
  Range window = coast;
  while (window.first < coast.end && smoothed[window.first] > speed_m_s + kHalf_m_s) ++window.first;
  window.end = window.first;
  while (window.end < coast.end && smoothed[window.end] >= speed_m_s - kHalf_m_s) ++window.end;
  while (window.end - window.first < kWanted) {
    const bool has_before = window.first > coast.first && distance(window.first - 1) <= kWidest_m_s;
    const bool has_after = window.end < coast.end && distance(window.end) <= kWidest_m_s;
    if (!has_before && !has_after) break;
    if (has_before && (!has_after || distance(window.first - 1) < distance(window.end))) {
      --window.first;
    } else {
      ++window.end;
    }
  }
  return window;
}

/// Where a parabola over time through the samples of the window has the speed.
std::optional<double> solve_passing(const CoastdownRun& run, const Range& window, double speed_m_s) {
  constexpr std::size_t kFewest = 4;
  const std::size_t count = window.end - window.first;
  if (count < kFewest) return std::nullopt;
  double middle_s = 0.0;
  for (std::size_t i = window.first; i < window.end; ++i) middle_s += run.time_s[i] / static_cast<double>(count);
  Eigen::MatrixXd X(static_cast<Eigen::Index>(count), 3);
  Eigen::VectorXd y(static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const double s = run.time_s[window.first + i] - middle_s;
    X.row(static_cast<Eigen::Index>(i)) << 1.0, s, s * s;
    y(static_cast<Eigen::Index>(i)) = run.speed_m_s[window.first + i] - speed_m_s;
  }
  const Eigen::Vector3d parabola = X.colPivHouseholderQr().solve(y);
  double s = -parabola(0) / parabola(1);
  for (int i = 0; i < 4; ++i) s = -(parabola(0) + parabola(2) * s * s) / parabola(1);
  const double length_s = run.time_s[window.end - 1] - run.time_s[window.first];
  if (!std::isfinite(s) || std::abs(s) > length_s) return std::nullopt;
  return middle_s + s;
}

}  // namespace

std::vector<SpeedPassing> find_passing_times(const CoastdownRun& run, const std::vector<double>& speeds_m_s) {
  std::vector<SpeedPassing> passings;
  if (run.time_s.size() < 3 || speeds_m_s.empty()) return passings;
  constexpr double kBelow_m_s = 10.0 / kKmhPerMs;
  constexpr double kLeast_m_s = 0.5 / kKmhPerMs;
  std::vector<double> smoothed = smooth(run);
  const double lowest_m_s = *std::min_element(speeds_m_s.begin(), speeds_m_s.end());
  const Range coast = find_coast(smoothed, std::max(lowest_m_s - kBelow_m_s, kLeast_m_s));
  if (coast.end <= coast.first) return passings;
  for (const double speed_m_s : speeds_m_s) {
    if (speed_m_s > smoothed[coast.first] || speed_m_s < smoothed[coast.end - 1]) continue;
    passings.push_back({speed_m_s, solve_passing(run, find_window(smoothed, coast, speed_m_s), speed_m_s)});
  }
  return passings;
}

std::vector<SpeedCell> cut_into_cells(const CoastdownRun& run, const CellOptions& options) {
  constexpr double kLeastShare = 0.4;         // of its width, that a cell at an end must hold. Assumed
  constexpr double kNominal_m_s = 0.1 / 3.6;  // raster of nominal speeds, so that noise hardly moves them
  std::vector<SpeedCell> cells;
  if (run.time_s.size() < 3) return cells;
  std::vector<double> smoothed = smooth(run);
  const double width = options.width_m_s;
  const Range coast = find_coast(smoothed, std::max(options.low_m_s - 0.5 * width, 0.1 * width));
  const auto index_of = [width](double speed) { return std::lround(speed / width); };
  std::size_t first = coast.first;
  while (first < coast.end && smoothed[first] > options.high_m_s + 0.5 * width) ++first;
  while (first < coast.end) {
    const long index = index_of(smoothed[first]);
    std::size_t end = first;
    while (end < coast.end && index_of(smoothed[end]) == index) ++end;
    const bool whole = first > coast.first && end < coast.end;
    const double upper = whole ? (static_cast<double>(index) + 0.5) * width : smoothed[first];
    const double lower = whole ? (static_cast<double>(index) - 0.5) * width : smoothed[end - 1];
    const double center = static_cast<double>(index) * width;
    const double covered = std::min(upper, center + 0.5 * width) - std::max(lower, center - 0.5 * width);
    if (end - first >= 2 && covered >= kLeastShare * width) {
      const bool centered = covered > 0.9 * width;
      const double nominal = centered ? center : std::round(0.5 * (upper + lower) / kNominal_m_s) * kNominal_m_s;
      cells.push_back(make_cell(run, first, end, nominal));
      cells.back().high_m_s = upper;
      cells.back().low_m_s = lower;
    }
    first = end;
  }
  return cells;
}

double calc_passing_time_s(const SpeedCell& cell, const DecelerationCurve& deceleration) {
  const double a = deceleration.value_m_s2;
  const double c2 = 0.5 * a * deceleration.slope_per_s;
  const double c3 = -a * (deceleration.slope_per_s * deceleration.slope_per_s + a * deceleration.bend_per_m) / 6.0;
  double delta = (cell.nominal_speed_m_s - cell.mean_speed_m_s) / a;  // mean time after the passing
  for (int iteration = 0; iteration < 4; ++iteration) {
    const double square = cell.time_moment_2_s2 + delta * delta;
    const double cube = cell.time_moment_3_s3 + 3.0 * delta * cell.time_moment_2_s2 + delta * delta * delta;
    const double error = cell.nominal_speed_m_s - a * delta + c2 * square + c3 * cube - cell.mean_speed_m_s;
    delta -= error / (-a + 2.0 * c2 * delta + 3.0 * c3 * square);
  }
  return cell.mean_time_s - delta;
}

}  // namespace rollrig::estimation
