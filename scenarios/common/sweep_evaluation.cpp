#include "scenarios/common/sweep_evaluation.h"

#include <algorithm>
#include <cmath>

#include <boost/math/statistics/linear_regression.hpp>

namespace rollrig::scenarios {

bool has_two_values(const std::vector<double>& x) {
  return std::adjacent_find(x.begin(), x.end(), std::not_equal_to<>()) != x.end();
}

double fit_power(const std::vector<double>& x, const std::vector<double>& y) {
  const auto logarithms = [](std::vector<double> values) {
    for (double& value : values) value = std::log(value);
    return values;
  };
  return boost::math::statistics::simple_ordinary_least_squares(logarithms(x), logarithms(y)).second;
}

Cycle average_cycles(const std::vector<Cycle>& cycles) {
  Cycle mean = cycles.back();
  mean.parasitic_N = mean.rolling_resistance_N = mean.rrc = mean.force_method_N = 0.0;
  const auto n = static_cast<double>(cycles.size());
  for (const Cycle& cycle : cycles) {
    mean.parasitic_N += cycle.parasitic_N / n;
    mean.rolling_resistance_N += cycle.rolling_resistance_N / n;
    mean.rrc += cycle.rrc / n;
    mean.force_method_N += cycle.force_method_N / n;
  }
  for (Reading Cycle::*part : {&Cycle::loaded, &Cycle::skim}) {
    std::optional<double>& torque_Nm = (mean.*part).drum_torque_Nm;
    if (!torque_Nm.has_value()) continue;
    torque_Nm = 0.0;
    for (const Cycle& cycle : cycles) *torque_Nm += *(cycle.*part).drum_torque_Nm / n;
  }
  return mean;
}

std::vector<double> default_sweep_loads_N(const RunSpec& spec) {
  if (!spec.tire.sweep_loads_N.empty()) return spec.tire.sweep_loads_N;
  const double iso_N = spec.tire.iso_28580.has_value() ? spec.tire.iso_28580->load_N : 1.25 * kVehicleLoad_N;
  return {iso_N, 0.5 * (iso_N + kVehicleLoad_N), kVehicleLoad_N};
}

}  // namespace rollrig::scenarios
