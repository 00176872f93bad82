#include "diagnosis/checks/mistake_evidence.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

namespace rollrig::diagnosis {
namespace {

namespace quantities = models::quantities;
using measurements::MeasuredRun;
using measurements::MeasurementSet;

using Values = std::vector<double>;

constexpr std::array<double, 7> kNoiseFactors{1.0, 1.5, 2.5, 5.0, 10.0, 20.0, 50.0};

/// Logarithm of the likelihood for given sizes of the parts and a given factor on the noise.
double calc_gaussian(const ChannelProducts& products, double scaled, double fixed, double noise) {
  Eigen::VectorXd sd = Eigen::VectorXd::Constant(products.projection.size(), fixed / noise);
  sd.head(products.scaled).setConstant(scaled / noise);
  sd[sd.size() - 1] = 1.0 / noise;
  Eigen::MatrixXd information = sd.asDiagonal() * products.gram * sd.asDiagonal();
  information.diagonal().array() += 1.0;
  const Eigen::LLT<Eigen::MatrixXd> cholesky(information);
  const Eigen::MatrixXd factor = cholesky.matrixL();
  const Eigen::VectorXd solved = cholesky.matrixL().solve(sd.cwiseProduct(products.projection));
  const double squares = (products.residual - solved.squaredNorm()) / (noise * noise);
  return 0.5 * products.count - 0.5 * squares - factor.diagonal().array().log().sum() -
         products.count * std::log(noise);
}

double add_logs(double a, double b) {
  const double larger = std::max(a, b);
  return larger + std::log1p(std::exp(std::min(a, b) - larger));
}

double calc_student(double difference, double scale) {
  constexpr double kFreedom = 5.0;
  const double z = difference / scale;
  return -0.5 * (kFreedom + 1.0) * std::log1p(z * z / kFreedom);
}

double calc_mean(const Values& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Logarithm of the likelihood of the mean height of a run, given those of the others.
double judge_height(const MeasurementSet& set, std::size_t r, const MeasuredRun& run) {
  constexpr std::size_t kFewest = 3;
  constexpr double kLeast_m = 100.0;
  constexpr double kSdOfMedian = 1.4826;
  Values others_m;
  for (std::size_t other = 0; other < set.runs.size(); ++other) {
    if (other != r) others_m.push_back(calc_mean(set.runs[other].column(quantities::kElevation)));
  }
  if (others_m.size() < kFewest) return 0.0;
  const double middle_m = calc_upper_median(others_m);
  for (double& height_m : others_m) height_m = std::abs(height_m - middle_m);
  const double scatter_m = std::max(kLeast_m, kSdOfMedian * calc_upper_median(others_m));
  return calc_student(calc_mean(run.column(quantities::kElevation)) - middle_m, scatter_m);
}

}  // namespace

double calc_log_likelihood(const RunProducts& products, const CommonParts& common, double size) {
  constexpr double kShareOfRun = 0.5;  // of the size, where the runs have parts in common
  constexpr double kPower = 0.5;       // what B lacks makes many samples wrong alike, so that they are less independent
  double sum = 0.0;
  for (std::size_t c = 0; c < products.size(); ++c) {
    if (!products[c].has_value()) continue;
    const bool is_common = !common.empty();
    const ChannelProducts left = is_common ? subtract_common(*products[c], common[c]) : *products[c];
    const double share = is_common ? kShareOfRun : 1.0;
    double of_channel = -HUGE_VAL;
    for (const double noise : kNoiseFactors) {
      of_channel = add_logs(of_channel, calc_gaussian(left, share * size, 1.0, noise) - 2.0 * std::log(noise));
    }
    sum += kPower * of_channel;
  }
  return sum;
}

double calc_given_log_likelihood(const MeasurementSet& set, std::size_t r, const MeasuredRun& run) {
  constexpr double kUsual_K = 3.0;
  double sum = 0.0;
  const bool is_soaked = !run.started_warm && !run.rest_before_s.has_value();
  const double above_K = run.column(quantities::kAmbient).front() - run.initial_tire_temperature_K;
  if (is_soaked || above_K > 0.0) sum += calc_student(above_K, kUsual_K);
  if (run.has(quantities::kElevation)) sum += judge_height(set, r, run);
  return sum;
}

}  // namespace rollrig::diagnosis
