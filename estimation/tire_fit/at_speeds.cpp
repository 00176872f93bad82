#include "estimation/tire_fit/at_speeds.h"

#include <algorithm>
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

/// Temperature at which the tire loses to air of `ambient_K` the heat that it makes.
double find_steady_K(const models::Context<double>& context, const SpeedConditions& at, double ambient_K) {
  constexpr double kMostRise_K = 150.0;  // Assumed: no tire is as warm
  constexpr int kHalvings = 60;          // to less than a rounding error
  const double conductance_W_per_K = models::calc_cooling_W_per_K(context.tire.thermal, at.speed_m_s);
  double low_K = ambient_K;
  double high_K = ambient_K + kMostRise_K;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle_K = 0.5 * (low_K + high_K);
    const double warms_W = calc_loss_N(context, at, middle_K) * at.speed_m_s;
    (warms_W > conductance_W_per_K * (middle_K - ambient_K) ? low_K : high_K) = middle_K;
  }
  return 0.5 * (low_K + high_K);
}

/// The same numbers in steady state.
Numbers calc_steady_numbers(const models::Context<double>& context, SpeedConditions at, double ambient_K) {
  at.temperature_K = find_steady_K(context, at, ambient_K);
  return calc_numbers(context, at);
}

/// Numbers of the fitted tire with their standard uncertainties.
struct UncertainNumbers {
  Numbers values;
  Numbers variances;

  Uncertain operator[](Number which) const { return {values[which], std::sqrt(variances[which])}; }
};

/// `calc(context)` at the optimum, and what the covariance of the fitted numbers makes of it.
template <class Calc>
UncertainNumbers propagate(const models::Context<double>& best, const FitUnknowns& unknowns,
                           const Eigen::MatrixXd& covariance, const Calc& calc) {
  constexpr double kStep = 1e-3;  // Assumed: of a standard uncertainty, small against what bends the law
  const auto count = static_cast<Eigen::Index>(unknowns.parameters.size());
  Eigen::MatrixXd derivatives(static_cast<Eigen::Index>(kNumberCount), count);
  models::Context<double> context = best;
  for (Eigen::Index i = 0; i < count; ++i) {
    double& number = find_parameter(context, unknowns.parameters[static_cast<std::size_t>(i)].key);
    const double step = kStep * std::sqrt(covariance(i, i));
    const double middle = number;
    number = middle + step;
    const Numbers above = calc(context);
    number = middle - step;
    derivatives.col(i) = (above - calc(context)) / (2.0 * step);
    number = middle;
  }
  return {calc(best), (derivatives * covariance.topLeftCorner(count, count) * derivatives.transpose()).diagonal()};
}

models::Context<double> put_in(const FitUnknowns& unknowns, const std::vector<double>& found) {
  models::Context<double> best = unknowns.start;
  for (std::size_t i = 0; i < unknowns.parameters.size(); ++i) {
    find_parameter(best, unknowns.parameters[i].key) = found[i];
  }
  return best;
}

}  // namespace

std::vector<AtSpeed> find_at_speeds(const measurements::MeasurementSet& set, const FitUnknowns& unknowns,
                                    const std::vector<double>& found, const Eigen::MatrixXd& covariance) {
  const models::Context<double> best = put_in(unknowns, found);
  std::vector<AtSpeed> speeds;
  for (const SpeedConditions& at : find_speeds(set)) {
    const UncertainNumbers numbers =
        propagate(best, unknowns, covariance,
                  [&at](const models::Context<double>& context) { return calc_numbers(context, at); });
    speeds.push_back({at, numbers[kLoss], numbers[kFall], numbers[kConductance], numbers[kTimeConstant]});
  }
  return speeds;
}

SteadyTire find_steady_tire(const measurements::MeasurementSet& set, const FitUnknowns& unknowns,
                            const std::vector<double>& found, const Eigen::MatrixXd& covariance) {
  constexpr double kIsoSpeed_m_s = 80.0 / 3.6;
  constexpr double kIsoAmbient_K = 298.15;
  const std::vector<SpeedConditions> speeds = find_speeds(set);
  SteadyTire steady;
  steady.ambient_K = kIsoAmbient_K;
  steady.at = *std::min_element(speeds.begin(), speeds.end(), [](const SpeedConditions& a, const SpeedConditions& b) {
    return std::abs(a.speed_m_s - kIsoSpeed_m_s) < std::abs(b.speed_m_s - kIsoSpeed_m_s);
  });
  steady.at.speed_m_s = kIsoSpeed_m_s;
  const models::Context<double> best = put_in(unknowns, found);
  const UncertainNumbers numbers =
      propagate(best, unknowns, covariance, [&steady](const models::Context<double>& context) {
        return calc_steady_numbers(context, steady.at, kIsoAmbient_K);
      });
  steady.at.temperature_K = find_steady_K(best, steady.at, kIsoAmbient_K);
  steady.loss_N = numbers[kLoss];
  steady.rrc = {steady.loss_N.value / steady.at.load_N, steady.loss_N.sd / steady.at.load_N};
  steady.fall_per_K = numbers[kFall];
  steady.time_constant_s = numbers[kTimeConstant];
  return steady;
}

}  // namespace rollrig::estimation
