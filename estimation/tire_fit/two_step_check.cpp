#include "estimation/tire_fit/two_step_check.h"

#include <fmt/format.h>

#include <cmath>

#include "models/sensor.h"

namespace rollrig::estimation {
namespace {

/// What the two-step regression says at one speed.
struct TwoStepAtSpeed {
  double fall_per_K = 0.0;
  double conductance_W_per_K = 0.0;
};

std::vector<TwoStepAtSpeed> find_in_two_steps(const measurements::MeasurementSet& set,
                                              const std::vector<AtSpeed>& speeds) {
  const TwoStepEstimate estimate = estimate_in_two_steps(set);
  std::vector<TwoStepAtSpeed> found;
  for (const AtSpeed& speed : speeds) {
    const double v = speed.at.speed_m_s;
    found.push_back({estimate.B0_per_K + estimate.B1_s_per_m_K * v,
                     estimate.rest_conductance_W_per_K + estimate.speed_conductance_W_s_per_m_K * v});
  }
  return found;
}

/// The set with the errors of its sensors once more.
measurements::MeasurementSet add_errors(measurements::MeasurementSet set, std::uint64_t seed) {
  for (measurements::MeasuredRun& run : set.runs) {
    for (const auto& [channel, sensor] : set.sensors) {
      if (!run.has(channel)) continue;
      models::apply_sensor(sensor, channel, {seed, run.session, run.id}, run.time_s, run.columns.at(channel));
    }
  }
  return set;
}

/// Standard uncertainty of the regression at each speed.
std::vector<TwoStepAtSpeed> find_scatter_of_steps(const measurements::MeasurementSet& set,
                                                  const std::vector<AtSpeed>& speeds,
                                                  const std::vector<TwoStepAtSpeed>& middle) {
  constexpr int kDraws = 24;  // Assumed: the scatter is then known to 15 %
  std::vector<TwoStepAtSpeed> sums(speeds.size());
  for (int draw = 1; draw <= kDraws; ++draw) {
    const auto found = find_in_two_steps(add_errors(set, static_cast<std::uint64_t>(draw)), speeds);
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      sums[i].fall_per_K += std::pow(found[i].fall_per_K - middle[i].fall_per_K, 2);
      sums[i].conductance_W_per_K += std::pow(found[i].conductance_W_per_K - middle[i].conductance_W_per_K, 2);
    }
  }
  for (TwoStepAtSpeed& sum : sums) {
    sum = {std::sqrt(sum.fall_per_K / kDraws), std::sqrt(sum.conductance_W_per_K / kDraws)};
  }
  return sums;
}

void add_warning(const char* what, double speed_m_s, const Uncertain& two_step, const Uncertain& joint,
                 const char* unit, std::vector<std::string>& warnings) {
  constexpr double kMost = 3.0;  // Assumed
  const double sd = std::hypot(two_step.sd, joint.sd);
  if (!(std::abs(two_step.value - joint.value) > kMost * sd)) return;  // of a number that is not known: none
  warnings.push_back(fmt::format(
      "at {:.0f} km/h the two-step regression and the fit differ by {:.1f} standard uncertainties in the {}: "
      "{:.4g} +- {:.2g} and {:.4g} +- {:.2g} {}. The model lacks something, or a number that was held is "
      "wrong",
      3.6 * speed_m_s, std::abs(two_step.value - joint.value) / sd, what, two_step.value, two_step.sd, joint.value,
      joint.sd, unit));
}

}  // namespace

std::vector<std::string> compare_two_steps(const measurements::MeasurementSet& set, const models::TireFile& fitted,
                                           const std::vector<AtSpeed>& joint) {
  measurements::MeasurementSet with_fitted = set;
  with_fitted.tire.values = fitted.values;
  with_fitted.tire.rig_thermal = fitted.rig_thermal;
  const std::vector<TwoStepAtSpeed> found = find_in_two_steps(with_fitted, joint);
  const std::vector<TwoStepAtSpeed> sd = find_scatter_of_steps(with_fitted, joint, found);
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < joint.size(); ++i) {
    const double v = joint[i].at.speed_m_s;
    add_warning("fall of the loss with temperature", v, {found[i].fall_per_K, sd[i].fall_per_K}, joint[i].fall_per_K,
                "1/degC", warnings);
    add_warning("conductance to the surroundings", v, {found[i].conductance_W_per_K, sd[i].conductance_W_per_K},
                joint[i].conductance_W_per_K, "W/K", warnings);
  }
  return warnings;
}

}  // namespace rollrig::estimation
