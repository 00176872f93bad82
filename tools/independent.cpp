#include "tools/independent.h"

#include <algorithm>
#include <boost/math/statistics/bivariate_statistics.hpp>
#include <boost/math/statistics/linear_regression.hpp>
#include <cmath>
#include <functional>

namespace rollrig::tools::independent {
namespace {

double measure_N(const StudyTire& tire, const TestConditions& conditions) {
  return measure_steady(tire, conditions).reported_N;
}

double measure_at_share(const StudyTire& tire, double load_share, double pressure_share) {
  TestConditions conditions = make_iso_conditions(tire);
  conditions.load_N *= load_share;
  conditions.pressure_Pa *= pressure_share;
  return measure_N(tire, conditions);
}

/// Largest distance of `measure` from the straight line through it, over five places from `low` to `high`.
double find_bend(double low, double high, const std::function<double(double)>& measure) {
  constexpr int kCount = 5;
  std::vector<double> x, y;
  for (int i = 0; i < kCount; ++i) {
    x.push_back(low + (high - low) * i / (kCount - 1));
    y.push_back(measure(x.back()));
  }
  const auto [start, slope] = boost::math::statistics::simple_ordinary_least_squares(x, y);
  double largest = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) largest = std::max(largest, std::abs(y[i] - start - slope * x[i]));
  return largest;
}

SteadyLoss measure_in_air(const StudyTire& tire, double air_degC, double speed_m_s = 80.0 / 3.6) {
  TestConditions conditions = make_iso_conditions(tire);
  conditions.speed_m_s = speed_m_s;
  conditions.ambient_K = kZeroCelsius_K + air_degC;
  return measure_steady(tire, conditions);
}

constexpr double to_m_s(double speed_km_h) { return speed_km_h / 3.6; }

constexpr double kMinute_s = 60.0;
constexpr double kTruckStep_s = 240.0 * kMinute_s;  // Assumed: four hours at each speed
constexpr double kCold_K = kZeroCelsius_K + 5.0;

}  // namespace

double find_pressure_change(const StudyTire& tire, double from_psi, double to_psi) {
  TestConditions conditions = make_iso_conditions(tire);
  conditions.pressure_Pa = from_psi * kPsi_Pa;
  const double from_N = measure_N(tire, conditions);
  conditions.pressure_Pa = to_psi * kPsi_Pa;
  return measure_N(tire, conditions) / from_N - 1.0;
}

double find_rise_per_psi(const StudyTire& tire, double from_psi, double to_psi) {
  return std::pow(1.0 + find_pressure_change(tire, from_psi, to_psi), 1.0 / (from_psi - to_psi)) - 1.0;
}

double find_pressure_exponent(const StudyTire& tire) {
  return std::log(measure_at_share(tire, 1.0, 1.15) / measure_at_share(tire, 1.0, 0.75)) / std::log(1.15 / 0.75);
}

double find_load_exponent(const StudyTire& tire) {
  return std::log(measure_at_share(tire, 1.0, 1.0) / measure_at_share(tire, 0.5, 1.0)) / std::log(2.0);
}

double find_speed_rise(const StudyTire& tire) {
  TestConditions conditions = make_iso_conditions(tire);
  const double slow_N = measure_N(tire, conditions);
  conditions.speed_m_s = to_m_s(120.0);
  return measure_N(tire, conditions) / slow_N - 1.0;
}

double find_bend_over_load(const StudyTire& tire) {
  return find_bend(0.5, 1.0, [&](double share) { return measure_at_share(tire, share, 1.0); }) /
         measure_at_share(tire, 1.0, 1.0);
}

double find_bend_over_inverse_pressure(const StudyTire& tire) {
  return find_bend(1.0 / 1.15, 1.0 / 0.75, [&](double inverse) { return measure_at_share(tire, 1.0, 1.0 / inverse); }) /
         measure_at_share(tire, 1.0, 1.0);
}

double find_air_slope_per_K(const StudyTire& tire, double SteadyLoss::*loss) {
  const auto loss_at = [&](double air_degC) { return measure_in_air(tire, air_degC).*loss; };
  return (loss_at(20.0) - loss_at(30.0)) / (10.0 * loss_at(25.0));
}

double find_air_excess(const StudyTire& tire, double air_degC) {
  return measure_in_air(tire, air_degC).reported_N / measure_in_air(tire, 25.0).reported_N - 1.0;
}

double find_cold_ratio(const StudyTire& tire, double speed_km_h) {
  const double speed_m_s = to_m_s(speed_km_h);
  return measure_in_air(tire, -20.0, speed_m_s).reported_N / measure_in_air(tire, 25.0, speed_m_s).reported_N;
}

std::vector<SpeedStep> step_truck_tire(double cooling_factor) {
  const StudyTire usual = read_study_tire(kTruckTire);
  StudyTire changed = usual;
  changed.scale_cooling(cooling_factor);
  const std::vector<double> speeds_km_h{30.0, 50.0, 70.0, 90.0};
  std::vector<Step> steps;
  for (const double speed_km_h : speeds_km_h) steps.push_back({kTruckStep_s, to_m_s(speed_km_h), kCold_K});
  const auto before = roll_steps(usual, usual.load_N(), usual.pressure_Pa(), steps);
  const auto after = roll_steps(changed, usual.load_N(), usual.pressure_Pa(), steps);
  std::vector<SpeedStep> all;
  for (std::size_t i = 0; i < steps.size(); ++i) all.push_back({speeds_km_h[i], before[i], after[i]});
  return all;
}

Correlation correlate_truck_tire() {
  const StudyTire tire = read_study_tire(kTruckTire);
  std::vector<double> loss_N, tread_K, air_K;
  for (const double air_degC : {-30.0, -15.0, 0.0, 12.5, 25.0}) {
    const double here_K = kZeroCelsius_K + air_degC;
    for (const RollingState& state :
         roll_steps(tire, tire.load_N(), tire.pressure_Pa(), {{180.0 * kMinute_s, to_m_s(80.0), here_K}}, kMinute_s)) {
      loss_N.push_back(state.loss_N);
      tread_K.push_back(state.tread_K);
      air_K.push_back(here_K);
    }
  }
  using boost::math::statistics::correlation_coefficient;
  return {correlation_coefficient(loss_N, tread_K), correlation_coefficient(loss_N, air_K)};
}

}  // namespace rollrig::tools::independent
