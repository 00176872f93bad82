#include "measurements/logs/tie.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <boost/math/tools/minima.hpp>

#include "measurements/whitener.h"

namespace rollrig::measurements {
namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Rows [first, last) of a tie whose times the torque log covers, by a clock.
struct Overlap {
  const Tie& tie;
  const Clock& clock;
  std::size_t first = 0;
  std::size_t last = 0;
};

Overlap find_overlap(const Tie& tie, const Clock& clock) {
  Overlap overlap{tie, clock, 0, tie.time_s.size()};
  while (overlap.first < overlap.last && clock.to_torque(tie.time_s[overlap.first]) < tie.basis.node_s.front()) {
    ++overlap.first;
  }
  while (overlap.last > overlap.first && clock.to_torque(tie.time_s[overlap.last - 1]) > tie.basis.node_s.back()) {
    --overlap.last;
  }
  return overlap;
}

/// The functions f at the rows of an overlap, moved by `extra_s`.
void fill_functions(const Overlap& overlap, double extra_s, std::size_t column, RowMatrix& to) {
  const Tie& tie = overlap.tie;
  const std::vector<double>& node_s = tie.basis.node_s;
  std::size_t node = 1;
  for (std::size_t row = overlap.first; row < overlap.last; ++row) {
    const double at_s = std::clamp(overlap.clock.to_torque(tie.time_s[row]) + extra_s, node_s.front(), node_s.back());
    while (node + 1 < node_s.size() && node_s[node] < at_s) ++node;
    const double share = (at_s - node_s[node - 1]) / (node_s[node] - node_s[node - 1]);
    for (std::size_t f = 0; f < tie.basis.functions.size(); ++f) {
      const std::vector<double>& values = tie.basis.functions[f];
      to(static_cast<Eigen::Index>(row - overlap.first), static_cast<Eigen::Index>(column + f)) =
          values[node - 1] + share * (values[node] - values[node - 1]);
    }
  }
}

/// g, f and y side by side.
RowMatrix make_columns(const Overlap& overlap) {
  const Tie& tie = overlap.tie;
  const std::size_t own = 1 + tie.decay_s.size();
  const std::size_t count = overlap.last - overlap.first;
  RowMatrix columns(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(own + tie.basis.functions.size() + 1));
  for (std::size_t row = 0; row < count; ++row) {
    const auto r = static_cast<Eigen::Index>(row);
    const double since_s = tie.time_s[overlap.first + row] - tie.time_s[overlap.first];
    columns(r, 0) = 1.0;
    for (std::size_t d = 0; d < tie.decay_s.size(); ++d) {
      columns(r, static_cast<Eigen::Index>(d + 1)) = std::exp(-since_s / tie.decay_s[d]);
    }
    columns(r, columns.cols() - 1) = tie.values[overlap.first + row];
  }
  fill_functions(overlap, 0.0, own, columns);
  return columns;
}

/// Least squares by the columns of a matrix, near dependent ones left out.
class Projection {
 public:
  explicit Projection(const Eigen::MatrixXd& columns) {
    Eigen::MatrixXd scaled = columns;
    scale_ = columns.colwise().norm().cwiseMax(1e-300);
    for (Eigen::Index c = 0; c < columns.cols(); ++c) scaled.col(c) /= scale_(c);
    constexpr double kDependent = 1e-7;
    solver_.setThreshold(kDependent);
    solver_.compute(scaled);
    basis_ = solver_.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), solver_.rank());
  }
  Eigen::Index rank() const { return solver_.rank(); }
  Eigen::VectorXd take_out(const Eigen::VectorXd& y) const { return y - basis_ * (basis_.transpose() * y); }
  Eigen::VectorXd solve(const Eigen::VectorXd& y) const {
    const Eigen::VectorXd right = basis_.transpose() * y;
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(scale_.size());
    weights.head(rank()) = solver_.matrixR().topLeftCorner(rank(), rank()).triangularView<Eigen::Upper>().solve(right);
    return (solver_.colsPermutation() * weights).cwiseQuotient(scale_.transpose());
  }

 private:
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver_;
  Eigen::RowVectorXd scale_;
  Eigen::MatrixXd basis_;
};

/// Derivatives of what the functions come to by the clock's shift and drift, by differences of `step_s`.
RowMatrix calc_slopes(const Overlap& overlap, double step_s, const Eigen::VectorXd& weights) {
  const auto functions = static_cast<Eigen::Index>(overlap.tie.basis.functions.size());
  const auto rows = static_cast<Eigen::Index>(overlap.last - overlap.first);
  RowMatrix later(rows, functions), earlier(rows, functions);
  fill_functions(overlap, step_s, 0, later);
  fill_functions(overlap, -step_s, 0, earlier);
  const Eigen::VectorXd slope = (later - earlier) * weights.tail(functions) / (2.0 * step_s);
  RowMatrix slopes(rows, 2);
  for (Eigen::Index row = 0; row < rows; ++row) {
    slopes(row, 0) = slope(row);
    const double time_s = overlap.tie.time_s[overlap.first + static_cast<std::size_t>(row)];
    slopes(row, 1) = slope(row) * (time_s - overlap.clock.reference_s);
  }
  return slopes;
}

}  // namespace

TieFit fit_tie(const Tie& tie, const Clock& clock, bool with_slopes, double step_s) {
  constexpr std::size_t kRowsAnUnknown = 4;  // fewer would be followed by chance
  const Overlap overlap = find_overlap(tie, clock);
  TieFit fit;
  fit.count = overlap.last - overlap.first;
  const std::size_t unknowns = 1 + tie.decay_s.size() + tie.basis.functions.size();
  if (fit.count < kRowsAnUnknown * unknowns) return {};
  fit.time_s.assign(tie.time_s.begin() + static_cast<std::ptrdiff_t>(overlap.first),
                    tie.time_s.begin() + static_cast<std::ptrdiff_t>(overlap.last));
  const RowMatrix columns = make_columns(overlap);
  RowMatrix white = columns;
  const Whitener whitener(tie.noise, fit.time_s);
  whitener.apply(white.data(), static_cast<std::size_t>(white.cols()));
  const auto own = static_cast<Eigen::Index>(1 + tie.decay_s.size());
  const Eigen::Index all = white.cols() - 1;
  const Eigen::VectorXd y = white.col(all);
  const Projection alone(white.leftCols(own));
  const Projection together(white.leftCols(all));
  fit.chi2_alone = alone.take_out(y).squaredNorm();
  const Eigen::VectorXd weights = together.solve(y);
  fit.rest_white = together.take_out(y);
  fit.chi2 = fit.rest_white.squaredNorm();
  fit.rank = static_cast<std::size_t>(together.rank());
  if (tie.is_common && weights(own) <= 0.0) fit.chi2 = fit.chi2_alone;  // one quantity twice does not run backwards
  fit.rest = columns.col(all) - columns.leftCols(all) * weights;
  if (with_slopes) {
    RowMatrix slopes = calc_slopes(overlap, step_s, weights);
    whitener.apply(slopes.data(), 2);
    fit.slope_white.resize(slopes.rows(), 2);
    for (Eigen::Index c = 0; c < 2; ++c) fit.slope_white.col(c) = together.take_out(slopes.col(c));
  }
  return fit;
}

Tie thin_tie(const Tie& tie, std::size_t most) {
  const std::size_t group = (tie.time_s.size() + most - 1) / most;
  if (group <= 1) return tie;
  Tie thin = tie;
  thin.time_s.clear();
  thin.values.clear();
  for (std::size_t row = 0; row + group <= tie.time_s.size(); row += group) {
    double time_s = 0.0;
    double value = 0.0;
    for (std::size_t k = row; k < row + group; ++k) {
      time_s += tie.time_s[k] / static_cast<double>(group);
      value += tie.values[k] / static_cast<double>(group);
    }
    thin.time_s.push_back(time_s);
    thin.values.push_back(value);
  }
  const double white = tie.noise.noise_sd * tie.noise.noise_sd + tie.noise.resolution * tie.noise.resolution / 12.0;
  thin.noise.noise_sd = std::sqrt(white / static_cast<double>(group));
  thin.noise.resolution = 0.0;
  return thin;
}

models::SensorParameters estimate_noise(const TieFit& fit, const models::SensorParameters& start) {
  const auto n = static_cast<double>(fit.count);
  const double span_s = fit.time_s.back() - fit.time_s.front();
  const double step_s = span_s / (n - 1.0);
  double scale = 1.0;
  const auto calc_misfit = [&](double log_ratio, double log_time_s) {
    const models::SensorParameters noise{0.0, std::exp(log_ratio), std::exp(log_time_s), 1.0, 0.0};
    const Whitener whitener(noise, fit.time_s);
    Eigen::VectorXd white = fit.rest;
    whitener.apply(white.data(), 1);
    scale = white.squaredNorm() / (n - static_cast<double>(fit.rank));
    return n * std::log(scale) + whitener.log_determinant();
  };
  const double shortest = std::log(2.0 * step_s);
  const double longest = std::log(std::max(span_s / 4.0, 4.0 * step_s));
  double best_ratio = -5.0;
  double best_time = std::clamp(std::log(start.drift_time_s), shortest, longest);
  double best = calc_misfit(best_ratio, best_time);
  constexpr int kGrid = 7;
  for (int i = 0; i < kGrid; ++i) {
    for (int k = 0; k < kGrid; ++k) {
      const double ratio = -4.0 + 8.0 * i / (kGrid - 1);
      const double time = shortest + (longest - shortest) * k / (kGrid - 1);
      const double misfit = calc_misfit(ratio, time);
      if (misfit < best) std::tie(best, best_ratio, best_time) = std::tuple(misfit, ratio, time);
    }
  }
  constexpr int kBits = 12;
  for (int round = 0; round < 3; ++round) {
    const auto by_ratio = [&](double ratio) { return calc_misfit(ratio, best_time); };
    best_ratio = boost::math::tools::brent_find_minima(by_ratio, best_ratio - 1.0, best_ratio + 1.0, kBits).first;
    const auto by_time = [&](double time) { return calc_misfit(best_ratio, time); };
    best_time = boost::math::tools::brent_find_minima(by_time, std::max(shortest, best_time - 0.7),
                                                      std::min(longest, best_time + 0.7), kBits)
                    .first;
  }
  calc_misfit(best_ratio, best_time);
  const double noise_sd = std::sqrt(std::max(scale, 1e-300));
  return {0.0, noise_sd * std::exp(best_ratio), std::exp(best_time), noise_sd, 0.0};
}

}  // namespace rollrig::measurements
