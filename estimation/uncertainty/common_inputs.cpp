#include "estimation/uncertainty/common_inputs.h"

#include <fmt/format.h>

#include <cmath>

namespace rollrig::estimation {

UncertainInput make_assumed_input(const std::string& name, const std::string& key, double value, double half_width,
                                  const std::string& limits) {
  UncertainInput input{name, key, value, half_width / std::sqrt(3.0), Distribution::kRectangular};
  input.source = fmt::format("Assumed: +-{}, rectangular; no file gives it", limits);
  input.is_from_limits = true;
  return input;
}

std::vector<UncertainInput> make_scatter_inputs(std::size_t count, double degrees_freedom, const std::string& name,
                                                const std::string& source) {
  UncertainInput error{name, "scatter", 0.0, 1.0, Distribution::kNormal, Evaluation::kTypeA, degrees_freedom};
  error.source = source;
  std::vector<UncertainInput> inputs(count, error);
  UncertainInput scale = error;
  scale.value = 1.0;
  scale.standard_uncertainty = 0.0;
  if (std::isfinite(degrees_freedom)) scale.distribution = Distribution::kMultivariateT;
  inputs.push_back(scale);
  return inputs;
}

void share_scatter(const std::vector<UncertainInput>& scatter, UncertainInput& input) {
  input.pool = scatter.front().name;
  input.distribution = Distribution::kNormal;
  input.evaluation = Evaluation::kTypeA;
  input.degrees_freedom = scatter.front().degrees_freedom;
}

double take_scale(const std::vector<double>& inputs, std::size_t first, std::size_t count) {
  return inputs[first + count];
}

std::vector<double> take_scatter(const std::vector<double>& inputs, std::size_t first, std::size_t count) {
  std::vector<double> errors(count);
  for (std::size_t i = 0; i < count; ++i) errors[i] = inputs[first + count] * inputs[first + i];
  return errors;
}

}  // namespace rollrig::estimation
