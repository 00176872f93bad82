#include "estimation/road_load/road_force_reference.h"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>

#include "estimation/run_checks/robust_statistics.h"

namespace rollrig::estimation {
namespace {

constexpr Eigen::Index kCommonFactors = 4;   // A, B, C, d_0
constexpr Eigen::Index kSessionFactors = 4;  // d_1, D, E, F
constexpr double kSessionShare = 0.3;        // Assumed: standard deviation of each of them, as a share of the force

/// Precisions of the priors: of the square of a factor's share of the force, on average.
Eigen::VectorXd find_precisions(const Eigen::MatrixXd& X, const Eigen::VectorXd& y) {
  const Eigen::MatrixXd shares = y.cwiseInverse().asDiagonal() * X;
  Eigen::VectorXd precisions = shares.colwise().squaredNorm().transpose();
  for (Eigen::Index i = 0; i < precisions.size(); ++i) {
    const auto in_use = static_cast<double>((shares.col(i).array() != 0.0).count());
    precisions(i) = i < kCommonFactors || in_use == 0.0 ? 0.0 : precisions(i) / in_use / kSessionShare / kSessionShare;
  }
  return precisions;
}

std::vector<double> to_sizes(const Eigen::VectorXd& values) {
  std::vector<double> sizes;
  for (const double value : values) sizes.push_back(std::abs(value));
  return sizes;
}

double calc_reference_weight(double u, bool tukey) {
  constexpr double kHuberLimit = 1.345, kTukeyLimit = 4.685;
  if (!tukey) return u <= kHuberLimit ? 1.0 : kHuberLimit / u;
  const double share = u / kTukeyLimit;
  return share >= 1.0 ? 0.0 : (1.0 - share * share) * (1.0 - share * share);
}

}  // namespace

std::optional<BinForce> find_bin_force(const FitRun& run, const FitBin& bin, double mass_kg) {
  double high_m_s = bin.high_m_s, low_m_s = bin.low_m_s, duration_s = bin.duration_s;
  if (bin.upper_cell >= 0) {
    const SpeedCell& upper = run.cells[static_cast<std::size_t>(bin.upper_cell)];
    const SpeedCell& lower = run.cells[static_cast<std::size_t>(bin.upper_cell) + 1];
    high_m_s = upper.mean_speed_m_s;
    low_m_s = lower.mean_speed_m_s;
    duration_s = lower.mean_time_s - upper.mean_time_s;
  }
  if (duration_s <= 0.0) return std::nullopt;
  return BinForce{0.5 * (high_m_s + low_m_s), mass_kg * (high_m_s - low_m_s) / duration_s};
}

RoadForceReference::RoadForceReference(const CoastdownData& data, const std::vector<FitRun>& runs,
                                       const std::vector<bool>& used, double mass_kg)
    : data_(data), mass_kg_(mass_kg) {
  for (const FitRun& run : runs) {
    sessions_.try_emplace(data.runs[run.index].session, static_cast<Eigen::Index>(sessions_.size()));
  }
  std::vector<Point> points;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!used[i]) continue;
    const std::vector<Point> of_run = list_points(runs[i]);
    points.insert(points.end(), of_run.begin(), of_run.end());
  }
  solve(points);
}

Eigen::Index RoadForceReference::count_factors() const {
  return kCommonFactors + kSessionFactors * static_cast<Eigen::Index>(sessions_.size());
}

std::vector<RoadForceReference::Point> RoadForceReference::list_points(const FitRun& run) const {
  const Eigen::Index session = sessions_.at(data_.runs[run.index].session);
  std::vector<Point> points;
  for (const FitBin& bin : run.bins) {
    const std::optional<BinForce> found = find_bin_force(run, bin, mass_kg_);
    if (!found.has_value()) continue;
    Point point;
    point.speed_m_s = found->speed_m_s;
    point.force_N = found->force_N - bin.at.offset_N - bin.at.offset_N_s_per_m * point.speed_m_s;
    if (point.force_N <= 0.0) continue;
    const double air_m_s = point.speed_m_s + bin.at.wind_m_s;
    const Eigen::Vector3d load(bin.at.rolling, bin.at.rolling * point.speed_m_s,
                               bin.at.density * air_m_s * std::abs(air_m_s));
    point.factors = Eigen::VectorXd::Zero(count_factors());
    point.factors.head(kCommonFactors) << load, run.heading;
    const Eigen::Index of_session = kCommonFactors + kSessionFactors * session;
    point.factors(of_session) = run.heading * point.speed_m_s;
    if (sessions_.size() > 1) point.factors.segment(of_session + 1, load.size()) = load;
    point.level_factors = point.factors;
    point.level_factors(kCommonFactors - 1) = 0.0;
    point.level_factors(of_session) = 0.0;
    points.push_back(point);
  }
  return points;
}

void RoadForceReference::solve(const std::vector<Point>& points) {
  constexpr int kIterations = 40;
  constexpr int kHuberFirst = 25;
  constexpr double kFirstSd = 0.02, kLeastSd = 1e-4;  // relative: Assumed; rounding
  constexpr double kLeastShare = 0.2;
  const auto n = static_cast<Eigen::Index>(points.size());
  coefficients_ = Eigen::VectorXd::Zero(count_factors());
  if (n == 0) return;
  Eigen::MatrixXd X(n, coefficients_.size()), level(n, coefficients_.size());
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    X.row(i) = points[static_cast<std::size_t>(i)].factors;
    level.row(i) = points[static_cast<std::size_t>(i)].level_factors;
    y(i) = points[static_cast<std::size_t>(i)].force_N;
  }
  const Eigen::VectorXd precisions = find_precisions(X, y);
  Eigen::VectorXd scale = y, weights = Eigen::VectorXd::Ones(n);
  double sd = kFirstSd;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Eigen::VectorXd root = weights.cwiseSqrt().cwiseQuotient(scale);
    Eigen::MatrixXd with_priors(n + X.cols(), X.cols());
    with_priors << root.asDiagonal() * X, Eigen::MatrixXd((sd * precisions.cwiseSqrt()).asDiagonal());
    Eigen::VectorXd wanted = Eigen::VectorXd::Zero(n + X.cols());
    wanted.head(n) = root.cwiseProduct(y);
    coefficients_ = with_priors.completeOrthogonalDecomposition().solve(wanted);
    const Eigen::VectorXd fitted = X * coefficients_;
    // a reference force near zero would make one bin count for all
    least_scale_N_ = kLeastShare * fitted.mean();
    scale = (level * coefficients_).cwiseMax(least_scale_N_);
    const Eigen::VectorXd residual = (y - fitted).cwiseQuotient(scale);
    sd = std::max(kLeastSd, 1.4826 * calc_median(to_sizes(residual)));
    weights =
        residual.unaryExpr([&](double r) { return calc_reference_weight(std::abs(r) / sd, iteration > kHuberFirst); });
  }
}

RunDeviation RoadForceReference::deviation_of(const FitRun& run, std::size_t place) const {
  RunDeviation deviation;
  deviation.run = place;
  deviation.group = static_cast<std::size_t>(sessions_.at(data_.runs[run.index].session));
  for (const Point& point : list_points(run)) {
    const double reference_N = point.factors.dot(coefficients_);
    deviation.speed_m_s.push_back(point.speed_m_s);
    const double level_N = point.level_factors.dot(coefficients_);
    deviation.relative.push_back((point.force_N - reference_N) / std::max(level_N, least_scale_N_));
  }
  return deviation;
}

}  // namespace rollrig::estimation
