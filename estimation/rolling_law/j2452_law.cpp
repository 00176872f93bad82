#include "estimation/rolling_law/j2452_law.h"

#include <cmath>

#include "sim/core/units.h"

namespace rollrig::estimation {

double J2452Law::calc_force_N(double pressure_Pa, double load_N, double speed_m_s) const {
  const double v = kKmhPerMs * speed_m_s;
  return std::pow(pressure_Pa / 1e3, alpha) * std::pow(load_N, beta) * (a + v * (b + v * c));
}

SpeedMoments calc_speed_moments(const std::vector<double>& time_s, const std::vector<double>& speed_m_s) {
  SpeedMoments moments;
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    const double step_s = time_s[i] - time_s[i - 1];
    const double from = speed_m_s[i - 1];
    const double to = speed_m_s[i];
    const double middle = 0.5 * (from + to);
    const auto integrate = [&](int power) {
      return step_s / 6.0 * (std::pow(from, power) + 4.0 * std::pow(middle, power) + std::pow(to, power));
    };
    moments.distance_m += integrate(1);
    moments.mean_m_s += integrate(2);
    moments.mean_square_m2_s2 += integrate(3);
  }
  moments.mean_m_s /= moments.distance_m;
  moments.mean_square_m2_s2 /= moments.distance_m;
  return moments;
}

SpeedMoments mix_moments(const SpeedMoments& first, double weight, const SpeedMoments& second) {
  const auto mix = [weight](double x, double y) { return weight * x + (1.0 - weight) * y; };
  return {mix(first.distance_m, second.distance_m), mix(first.mean_m_s, second.mean_m_s),
          mix(first.mean_square_m2_s2, second.mean_square_m2_s2)};
}

double calc_mean_force_N(const J2452Law& law, double pressure_Pa, double load_N, const SpeedMoments& moments) {
  const double level = std::pow(pressure_Pa / 1e3, law.alpha) * std::pow(load_N, law.beta);
  return level *
         (law.a + law.b * kKmhPerMs * moments.mean_m_s + law.c * kKmhPerMs * kKmhPerMs * moments.mean_square_m2_s2);
}

}  // namespace rollrig::estimation
