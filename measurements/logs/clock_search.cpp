#include "measurements/logs/clock_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/interrupt.h"

namespace rollrig::measurements {
namespace {

constexpr std::size_t kRowsOfScan = 800;
constexpr std::size_t kRowsOfFit = 4000;

double calc_gain(const std::vector<Tie>& ties, const Clock& clock, const ClockPrior& prior) {
  double gain = 0.0;
  for (const Tie& tie : ties) {
    const TieFit fit = fit_tie(tie, clock, false);
    if (fit.count > 0 && fit.chi2 > 0.0) {
      gain += 0.5 * static_cast<double>(fit.count) * std::log(fit.chi2_alone / fit.chi2);
    }
  }
  if (prior.rate_sd > 0.0) gain -= 0.5 * std::pow(clock.rate / prior.rate_sd, 2);
  if (prior.shift_sd_s > 0.0) gain -= 0.5 * std::pow((clock.shift_s - prior.center_s) / prior.shift_sd_s, 2);
  return gain;
}

std::vector<Tie> thin_all(const std::vector<Tie>& ties, std::size_t most) {
  std::vector<Tie> thin;
  for (const Tie& tie : ties) thin.push_back(thin_tie(tie, most));
  return thin;
}

double find_scan_step(const std::vector<Tie>& ties, const ClockPrior& prior) {
  double finest_s = std::numeric_limits<double>::infinity();
  for (const Tie& tie : ties) {
    const double span_s = tie.time_s.back() - tie.time_s.front();
    finest_s = std::min(finest_s, span_s / static_cast<double>(tie.time_s.size()));
  }
  return std::min(std::max(1.0, 0.5 * finest_s), prior.half_width_s / 15.0);
}

std::vector<double> make_grid(double half_width, double step) {
  std::vector<double> grid;
  const int count = static_cast<int>(std::ceil(half_width / step));
  for (int i = -count; i <= count; ++i) grid.push_back(half_width * i / std::max(1, count));
  return grid;
}

Clock scan(const std::vector<Tie>& ties, const ClockPrior& prior, double reference_s, double span_s) {
  const double step_s = find_scan_step(ties, prior);
  const double rate_step = 4.0 * step_s / span_s;
  constexpr double kMostRates = 30.0;  // to each side
  std::vector<double> rates{0.0};
  if (3.0 * prior.rate_sd > rate_step) {
    rates = make_grid(3.0 * prior.rate_sd, std::max(rate_step, 3.0 * prior.rate_sd / kMostRates));
  }
  Clock best{reference_s, prior.center_s, 0.0};
  double highest = -std::numeric_limits<double>::infinity();
  for (const double rate : rates) {
    for (const double shift_s : make_grid(prior.half_width_s, step_s)) {
      throw_if_interrupted();
      const Clock clock{reference_s, prior.center_s + shift_s, rate};
      const double gain = calc_gain(ties, clock, prior);
      if (gain > highest) {
        highest = gain;
        best = clock;
      }
    }
  }
  return best;
}

/// Curvature and gradient of the likelihood by shift and rate.
struct Normal {
  Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
};

Normal calc_normal(const std::vector<Tie>& ties, const Clock& clock, const ClockPrior& prior, double step_s) {
  Normal normal;
  for (const Tie& tie : ties) {
    const TieFit fit = fit_tie(tie, clock, true, step_s);
    if (fit.count == 0) continue;
    const double scale = fit.chi2 / static_cast<double>(fit.count - fit.rank);
    normal.matrix += fit.slope_white.transpose() * fit.slope_white / scale;
    normal.right += fit.slope_white.transpose() * fit.rest_white / scale;
  }
  if (prior.shift_sd_s > 0.0) {
    normal.matrix(0, 0) += 1.0 / (prior.shift_sd_s * prior.shift_sd_s);
    normal.right(0) -= (clock.shift_s - prior.center_s) / (prior.shift_sd_s * prior.shift_sd_s);
  }
  if (prior.rate_sd > 0.0) {
    normal.matrix(1, 1) += 1.0 / (prior.rate_sd * prior.rate_sd);
    normal.right(1) -= clock.rate / (prior.rate_sd * prior.rate_sd);
  } else {
    normal.matrix(0, 1) = normal.matrix(1, 0) = normal.right(1) = 0.0;
    normal.matrix(1, 1) = 1.0;
  }
  normal.matrix(0, 0) += 1e-18;  // nothing that moves with the shift: a standard deviation beyond any bound
  return normal;
}

/// Gauss-Newton with halved steps from where a scan found the peak.
void refine(const std::vector<Tie>& ties, const ClockPrior& prior, double step_s, ClockPeak& peak) {
  constexpr int kMostSteps = 30;
  constexpr int kMostHalvings = 6;
  const double longest_s = std::max(2.0, 0.1 * prior.half_width_s);
  peak.gain = calc_gain(ties, peak.clock, prior);
  for (int i = 0; i < kMostSteps; ++i) {
    throw_if_interrupted();
    const Normal normal = calc_normal(ties, peak.clock, prior, step_s);
    Eigen::Vector2d move = normal.matrix.ldlt().solve(normal.right);
    if (std::abs(move(0)) > longest_s) move *= longest_s / std::abs(move(0));
    const double sd_s = std::sqrt(normal.matrix.inverse()(0, 0));
    if (std::abs(move(0)) < 1e-3 * sd_s) break;
    bool better = false;
    for (int k = 0; k < kMostHalvings && !better; ++k, move *= 0.5) {
      Clock next = peak.clock;
      next.shift_s += move(0);
      next.rate += move(1);
      const double gain = calc_gain(ties, next, prior);
      better = gain > peak.gain;
      if (!better) continue;
      peak.clock = next;
      peak.gain = gain;
    }
    if (!better) break;
  }
  const Eigen::Matrix2d covariance = calc_normal(ties, peak.clock, prior, step_s).matrix.inverse();
  peak.shift_sd_s = std::sqrt(covariance(0, 0));
  peak.rate_sd = prior.rate_sd > 0.0 ? std::sqrt(covariance(1, 1)) : 0.0;
}

void estimate_all_noise(std::vector<Tie>& ties, const Clock& clock) {
  for (Tie& tie : ties) {
    const TieFit fit = fit_tie(tie, clock, false);
    if (fit.count > 0 && fit.chi2 > 0.0) tie.noise = estimate_noise(fit, tie.noise);
  }
}

double find_next_gain(const std::vector<Tie>& ties, const ClockPrior& prior, const ClockPeak& peak) {
  constexpr double kFar = 6.0;  // standard deviations
  const double step_s = find_scan_step(ties, prior);
  double highest = -std::numeric_limits<double>::infinity();
  for (const double shift_s : make_grid(prior.half_width_s, step_s)) {
    const Clock clock{peak.clock.reference_s, prior.center_s + shift_s, peak.clock.rate};
    if (std::abs(clock.shift_s - peak.clock.shift_s) < std::max(kFar * peak.shift_sd_s, step_s)) continue;
    highest = std::max(highest, calc_gain(ties, clock, prior));
  }
  return highest;
}

}  // namespace

ClockPeak search_clock(std::vector<Tie> ties, const ClockPrior& prior) {
  const double start_s = ties.front().time_s.front();
  const double end_s = ties.front().time_s.back();
  std::vector<Tie> coarse = thin_all(ties, kRowsOfScan);
  ClockPeak peak;
  peak.clock = scan(coarse, prior, 0.5 * (start_s + end_s), end_s - start_s);
  ties = thin_all(ties, kRowsOfFit);
  const double node_step_s = (ties.front().basis.node_s.back() - ties.front().basis.node_s.front()) /
                             static_cast<double>(ties.front().basis.node_s.size());
  const double step_s = 0.5 * node_step_s;  // a difference narrower than the nodes sees their corners
  refine(ties, prior, step_s, peak);
  constexpr int kRounds = 2;
  for (int round = 0; round < kRounds; ++round) {
    throw_if_interrupted();
    estimate_all_noise(ties, peak.clock);
    refine(ties, prior, step_s, peak);
  }
  estimate_all_noise(coarse, peak.clock);
  peak.gain = calc_gain(coarse, peak.clock, prior);
  peak.gain_next = find_next_gain(coarse, prior, peak);
  for (const Tie& tie : ties) peak.fits.push_back(fit_tie(tie, peak.clock, false));
  return peak;
}

}  // namespace rollrig::measurements
