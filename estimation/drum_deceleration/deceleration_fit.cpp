#include "estimation/drum_deceleration/deceleration_fit.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace rollrig::estimation {
namespace {

constexpr double kTukey = 4.685;     // 95 % efficiency with normal noise (Holland and Welsch 1977)
constexpr double kHuber = 1.345;     // likewise
constexpr double kMadToSd = 1.4826;  // of the normal distribution
constexpr int kLossTerms = 3;

/// Rows in the band, part by part.
struct Rows {
  std::vector<double> time_s;
  std::vector<double> speed_m_s;
  std::vector<std::size_t> part_starts;
  std::size_t below = 0;
  std::size_t above = 0;
};

Rows choose_rows(const Coast& coast, double speed_m_s, double half_band_m_s, const std::vector<SpeedRange>& left_out) {
  Rows rows;
  bool joined = false;
  for (std::size_t i = 0; i < coast.time_s.size(); ++i) {
    const double smooth_m_s = coast.smooth_m_s[i];
    const bool out = is_left_out(left_out, smooth_m_s);
    if (out) joined = false;
    if (out || std::abs(smooth_m_s - speed_m_s) > half_band_m_s) continue;
    if (!joined) rows.part_starts.push_back(rows.time_s.size());
    joined = true;
    rows.time_s.push_back(coast.time_s[i]);
    rows.speed_m_s.push_back(coast.speed_m_s[i]);
    ++(smooth_m_s < speed_m_s ? rows.below : rows.above);
  }
  return rows;
}

/// The solution of the equation of motion and its derivatives by the unknowns a_0, a_1, a_2, starts of parts.
class CoastSolution {
 public:
  CoastSolution(const Rows& rows, double speed_m_s, double half_band_m_s)
      : rows_(rows), speed_m_s_(speed_m_s), half_band_m_s_(half_band_m_s) {}

  Eigen::Index unknown_count() const { return kLossTerms + static_cast<Eigen::Index>(rows_.part_starts.size()); }

  /// a_0 from the fall over the whole band, the rest none.
  Eigen::VectorXd make_start() const {
    Eigen::VectorXd unknowns = Eigen::VectorXd::Zero(unknown_count());
    double fall_m_s = 0.0;
    double lasting_s = 0.0;
    for (std::size_t part = 0; part < rows_.part_starts.size(); ++part) {
      const std::size_t first = rows_.part_starts[part];
      const std::size_t last = end_of(part) - 1;
      fall_m_s += rows_.speed_m_s[first] - rows_.speed_m_s[last];
      lasting_s += rows_.time_s[last] - rows_.time_s[first];
      unknowns(kLossTerms + static_cast<Eigen::Index>(part)) = rows_.speed_m_s[first];
    }
    unknowns(0) = lasting_s > 0.0 ? fall_m_s / lasting_s : 0.0;
    return unknowns;
  }

  void evaluate(const Eigen::VectorXd& unknowns, Eigen::VectorXd& fitted, Eigen::MatrixXd& jacobian) const {
    const auto n = static_cast<Eigen::Index>(rows_.time_s.size());
    fitted.resize(n);
    jacobian.setZero(n, unknowns.size());
    for (std::size_t part = 0; part < rows_.part_starts.size(); ++part) {
      const Eigen::Index start = kLossTerms + static_cast<Eigen::Index>(part);
      State state = State::Zero();  // v, dv/da_0, dv/da_1, dv/da_2, dv/dv_start
      state(0) = unknowns(start);
      state(4) = 1.0;
      for (std::size_t i = rows_.part_starts[part]; i < end_of(part); ++i) {
        if (i > rows_.part_starts[part]) state = step(state, rows_.time_s[i] - rows_.time_s[i - 1], unknowns);
        const auto row = static_cast<Eigen::Index>(i);
        fitted(row) = state(0);
        for (Eigen::Index k = 0; k < kLossTerms; ++k) jacobian(row, k) = state(k + 1);
        jacobian(row, start) = state(4);
      }
    }
  }

 private:
  using State = Eigen::Matrix<double, 5, 1>;

  std::size_t end_of(std::size_t part) const {
    return part + 1 < rows_.part_starts.size() ? rows_.part_starts[part + 1] : rows_.time_s.size();
  }

  State rate(const State& state, const Eigen::VectorXd& a) const {
    const double x = (state(0) - speed_m_s_) / half_band_m_s_;
    const double slope = (a(1) + 2.0 * a(2) * x) / half_band_m_s_;
    State rate = -slope * state;
    rate(0) = -(a(0) + a(1) * x + a(2) * x * x);
    rate(1) -= 1.0;
    rate(2) -= x;
    rate(3) -= x * x;
    return rate;
  }

  /// Runge and Kutta's step of fourth order: from row to row the speed falls by a small part of the band.
  State step(const State& state, double dt_s, const Eigen::VectorXd& a) const {
    const State k1 = rate(state, a);
    const State k2 = rate(state + 0.5 * dt_s * k1, a);
    const State k3 = rate(state + 0.5 * dt_s * k2, a);
    const State k4 = rate(state + dt_s * k3, a);
    return state + dt_s / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }

  const Rows& rows_;
  double speed_m_s_;
  double half_band_m_s_;
};

double calc_robust_sd(const Eigen::VectorXd& residual) {
  std::vector<double> size(static_cast<std::size_t>(residual.size()));
  for (std::size_t i = 0; i < size.size(); ++i) size[i] = std::abs(residual(static_cast<Eigen::Index>(i)));
  const auto middle = size.begin() + static_cast<std::ptrdiff_t>(size.size() / 2);
  std::nth_element(size.begin(), middle, size.end());
  constexpr double kLeast_m_s = 1e-6;  // rounding: data free of noise
  return std::max(kLeast_m_s, kMadToSd * *middle);
}

Eigen::VectorXd calc_weights(const Eigen::VectorXd& residual, double sd, bool tukey) {
  return residual.unaryExpr([sd, tukey](double r) {
    const double u = std::abs(r) / sd;
    if (!tukey) return u <= kHuber ? 1.0 : kHuber / u;
    const double share = u / kTukey;
    return share >= 1.0 ? 0.0 : (1.0 - share * share) * (1.0 - share * share);
  });
}

/// Derivative of weight times residual by the residual, for Tukey's weights.
Eigen::VectorXd calc_psi_slopes(const Eigen::VectorXd& residual, double sd) {
  return residual.unaryExpr([sd](double r) {
    const double share2 = r * r / (kTukey * kTukey * sd * sd);
    return share2 >= 1.0 ? 0.0 : (1.0 - share2) * (1.0 - 5.0 * share2);
  });
}

/// Newey and West's sandwich: curvature inverse, spread of the scores with correlated neighbors, curvature inverse.
Eigen::MatrixXd calc_covariance(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residual,
                                const Eigen::VectorXd& weights, double sd) {
  const Eigen::Index n = jacobian.rows();
  const Eigen::MatrixXd scores = (weights.cwiseProduct(residual)).asDiagonal() * jacobian;
  Eigen::MatrixXd spread = scores.transpose() * scores;
  const auto lags = static_cast<Eigen::Index>(std::floor(4.0 * std::pow(static_cast<double>(n) / 100.0, 2.0 / 9.0)));
  for (Eigen::Index lag = 1; lag <= std::min(lags, n - 1); ++lag) {
    const Eigen::MatrixXd of_lag = scores.bottomRows(n - lag).transpose() * scores.topRows(n - lag);
    const double bartlett = 1.0 - static_cast<double>(lag) / static_cast<double>(lags + 1);
    spread += bartlett * (of_lag + of_lag.transpose());
  }
  const Eigen::MatrixXd curvature = jacobian.transpose() * calc_psi_slopes(residual, sd).asDiagonal() * jacobian;
  const Eigen::MatrixXd inverse =
      curvature.completeOrthogonalDecomposition().solve(Eigen::MatrixXd::Identity(curvature.rows(), curvature.cols()));
  const double small_sample = static_cast<double>(n) / static_cast<double>(n - jacobian.cols());
  return small_sample * inverse * spread * inverse.transpose();
}

std::string find_lack(const Rows& rows, Eigen::Index unknowns) {
  constexpr std::size_t kFewestSide = 3;
  if (rows.below < kFewestSide || rows.above < kFewestSide) return "the coast does not pass this speed on both sides";
  if (rows.time_s.size() < static_cast<std::size_t>(2 * unknowns)) return "too few rows about this speed";
  return {};
}

}  // namespace

bool is_left_out(const std::vector<SpeedRange>& ranges, double speed_m_s) {
  return std::any_of(ranges.begin(), ranges.end(),
                     [speed_m_s](const SpeedRange& range) { return range.contains(speed_m_s); });
}

DecelerationFit fit_deceleration(const Coast& coast, double speed_m_s, double half_band_m_s,
                                 const std::vector<SpeedRange>& left_out) {
  constexpr double kLargestShare = 0.75;  // of the speed: the band stays above standstill
  constexpr int kMostIterations = 60;
  constexpr int kHuberIterations = 6;
  constexpr int kScaleIterations =
      20;  // afterwards the scale is held: with few rows it and the weights may go in turns
  DecelerationFit fit;
  const double band_m_s = std::min(half_band_m_s, kLargestShare * speed_m_s);
  const Rows rows = choose_rows(coast, speed_m_s, band_m_s, left_out);
  const CoastSolution solution(rows, speed_m_s, band_m_s);
  fit.rows = rows.time_s.size();
  fit.why = find_lack(rows, solution.unknown_count());
  if (!fit.why.empty()) return fit;

  const Eigen::VectorXd measured =
      Eigen::Map<const Eigen::VectorXd>(rows.speed_m_s.data(), static_cast<Eigen::Index>(fit.rows));
  Eigen::VectorXd unknowns = solution.make_start();
  Eigen::VectorXd fitted, weights;
  Eigen::MatrixXd jacobian;
  bool converged = false;
  for (int iteration = 0; iteration < kMostIterations && !converged; ++iteration) {
    solution.evaluate(unknowns, fitted, jacobian);
    const Eigen::VectorXd residual = measured - fitted;
    if (iteration < kScaleIterations) fit.scatter_m_s = calc_robust_sd(residual);
    weights = calc_weights(residual, fit.scatter_m_s, iteration >= kHuberIterations);
    const Eigen::VectorXd root = weights.cwiseSqrt();
    const Eigen::VectorXd change =
        (root.asDiagonal() * jacobian).colPivHouseholderQr().solve(root.cwiseProduct(residual));
    unknowns += change;
    if (!unknowns.allFinite()) break;
    converged = iteration > kHuberIterations && std::abs(change(0)) <= 1e-7 * std::abs(unknowns(0));
  }
  if (!converged) {
    fit.why = "the fit of the speed over time does not converge";
    return fit;
  }
  solution.evaluate(unknowns, fitted, jacobian);
  const Eigen::VectorXd residual = measured - fitted;
  fit.value_m_s2 = unknowns(0);
  fit.sd_m_s2 = std::sqrt(std::max(0.0, calc_covariance(jacobian, residual, weights, fit.scatter_m_s)(0, 0)));
  for (std::size_t i = 0; i < fit.rows; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    fit.residuals.push_back({rows.time_s[i], rows.speed_m_s[i], fitted(row), weights(row)});
  }
  fit.available = fit.value_m_s2 > 0.0;
  if (!fit.available) fit.why = "the speed does not fall";
  return fit;
}

}  // namespace rollrig::estimation
