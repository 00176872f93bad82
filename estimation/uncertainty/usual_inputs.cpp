#include "estimation/uncertainty/usual_inputs.h"

#include <fmt/format.h>

#include <cmath>

namespace rollrig::estimation {

UncertainInput make_assumed_limit(const std::string& name, const std::string& key, double value, double half_width,
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
  if (std::isfinite(degrees_freedom)) scale.distribution = Distribution::kStudentScale;
  inputs.push_back(scale);
  return inputs;
}

std::vector<double> take_scatter(const std::vector<double>& inputs, std::size_t first, std::size_t count) {
  std::vector<double> errors(count);
  for (std::size_t i = 0; i < count; ++i) errors[i] = inputs[first + count] * inputs[first + i];
  return errors;
}

Eigen::MatrixXd calc_covariance_root(const Eigen::MatrixXd& covariance) {
  constexpr double kNothing = 1e-12;  // of a variance: what rounding leaves
  Eigen::MatrixXd root = Eigen::MatrixXd::Zero(covariance.rows(), covariance.cols());
  for (Eigen::Index j = 0; j < covariance.rows(); ++j) {
    const double left = covariance(j, j) - root.row(j).head(j).squaredNorm();
    if (left <= kNothing * covariance(j, j)) continue;
    root(j, j) = std::sqrt(left);
    for (Eigen::Index i = j + 1; i < covariance.rows(); ++i) {
      root(i, j) = (covariance(i, j) - root.row(i).head(j).dot(root.row(j).head(j))) / root(j, j);
    }
  }
  return root;
}

}  // namespace rollrig::estimation
