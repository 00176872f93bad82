#include "estimation/tire_fit/at_speeds.h"

#include <array>
#include <cmath>

#include "models/tire/tire_model.h"

namespace rollrig::estimation {
namespace {

enum Number { kLoss, kFall, kConductance, kTimeConstant, kNumberCount };
using Numbers = Eigen::Matrix<double, kNumberCount, 1>;

double calc_loss_N(const models::Context<double>& context, const SpeedConditions& at, double temperature_K) {
  models::Instant<double> now;
  now.context = &context;
  now.motion.speed_m_s = at.speed_m_s;
  now.motion.load_N = at.load_N;
  now.pressure_Pa = at.pressure_Pa;
  now.loss.temperature_K = temperature_K;
  return context.tire.model().hooks<double>().calc_loss_N(now);
}

Numbers calc_numbers(const models::Context<double>& context, const SpeedConditions& at) {
  constexpr double kStep_K = 0.1;
  const models::TireThermalParameters<double>& thermal = context.tire.thermal;
  const double conductance_W_per_K = models::calc_cooling_W_per_K(thermal, at.speed_m_s);
  Numbers numbers;
  numbers[kLoss] = calc_loss_N(context, at, at.temperature_K);
  numbers[kFall] = std::log(calc_loss_N(context, at, at.temperature_K - kStep_K) /
                            calc_loss_N(context, at, at.temperature_K + kStep_K)) /
                   (2.0 * kStep_K);
  numbers[kConductance] = conductance_W_per_K;
  numbers[kTimeConstant] = thermal.heat_capacity_J_per_K / conductance_W_per_K;
  return numbers;
}

/// Derivatives by the fitted numbers, one column each.
Eigen::MatrixXd calc_derivatives(const models::Context<double>& best, const FitUnknowns& unknowns,
                                 const Eigen::MatrixXd& covariance, const SpeedConditions& at) {
  constexpr double kStep = 1e-3;  // Assumed: of a standard uncertainty, small against what bends the law
  const auto count = static_cast<Eigen::Index>(unknowns.parameters.size());
  Eigen::MatrixXd derivatives(static_cast<Eigen::Index>(kNumberCount), count);
  models::Context<double> context = best;
  for (Eigen::Index i = 0; i < count; ++i) {
    double& number = find_parameter(context, unknowns.parameters[static_cast<std::size_t>(i)].key);
    const double step = kStep * std::sqrt(covariance(i, i));
    const double middle = number;
    number = middle + step;
    const Numbers above = calc_numbers(context, at);
    number = middle - step;
    derivatives.col(i) = (above - calc_numbers(context, at)) / (2.0 * step);
    number = middle;
  }
  return derivatives;
}

}  // namespace

std::vector<AtSpeed> find_at_speeds(const measurements::MeasurementSet& set, const FitUnknowns& unknowns,
                                    const std::vector<double>& found, const Eigen::MatrixXd& covariance) {
  models::Context<double> best = unknowns.start;
  for (std::size_t i = 0; i < unknowns.parameters.size(); ++i) {
    find_parameter(best, unknowns.parameters[i].key) = found[i];
  }
  const auto count = static_cast<Eigen::Index>(unknowns.parameters.size());
  std::vector<AtSpeed> speeds;
  for (const SpeedConditions& at : find_speeds(set)) {
    const Numbers values = calc_numbers(best, at);
    const Eigen::MatrixXd derivatives = calc_derivatives(best, unknowns, covariance, at);
    const Numbers variances =
        (derivatives * covariance.topLeftCorner(count, count) * derivatives.transpose()).diagonal();
    const auto number = [&](Number which) { return Uncertain{values[which], std::sqrt(variances[which])}; };
    speeds.push_back({at, number(kLoss), number(kFall), number(kConductance), number(kTimeConstant)});
  }
  return speeds;
}

}  // namespace rollrig::estimation
