#include "validation/scoring/baselines/gaussian_process.h"

#include <Eigen/Cholesky>
#include <array>
#include <limits>
#include <vector>

#include "diagnosis/comparison/eigen_index.h"

namespace rollrig::validation {
namespace {

namespace quantities = models::quantities;

using diagnosis::PreparedSet;
using diagnosis::Series;
using diagnosis::to_index;

Eigen::MatrixXd calc_kernel(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double factor) {
  Eigen::MatrixXd squares = -2.0 * a * b.transpose();
  squares.colwise() += a.rowwise().squaredNorm();
  squares.rowwise() += b.rowwise().squaredNorm().transpose();
  return (squares.array() / (-2.0 * factor * factor)).exp();
}

constexpr Eigen::Index kInputs = 4;

/// Inputs of every block of a series. Assumed: length scales of 600 s, 30 km/h, 1500 N and 5 K.
Eigen::MatrixXd find_inputs(const PreparedSet& set, const Series& series) {
  const measurements::MeasuredRun& run = set.runs()[series.run].measured;
  Eigen::MatrixXd inputs(to_index(series.size()), kInputs);
  for (std::size_t k = 0; k < series.size(); ++k) {
    const auto mean = [&](const Quantity& quantity) {
      const std::vector<double>& values = run.column(quantity);
      return series.mean_over(series.blocks[k], [&](std::size_t row) { return values[row]; });
    };
    inputs.row(to_index(k)) << (series.time_s[k] - run.time_s.front()) / 600.0, mean(quantities::kSpeed) / (30.0 / 3.6),
        mean(quantities::kLoad) / 1500.0, mean(quantities::kAmbient) / 5.0;
  }
  return inputs;
}

/// Rows of inputs, and values in noise floors.
struct Examples {
  std::vector<Eigen::RowVectorXd> inputs;
  std::vector<double> values;
  std::vector<std::size_t> offsets;  // which offset of a sensor a value holds
  std::vector<double> offset_sds;    // of that, in noise floors

  GaussianProcess learn() const {
    const Eigen::Index count = to_index(values.size());
    Eigen::MatrixXd rows(count, kInputs);
    Eigen::MatrixXd noise = Eigen::MatrixXd::Identity(count, count);
    for (std::size_t i = 0; i < values.size(); ++i) {
      rows.row(to_index(i)) = inputs[i];
      for (std::size_t k = 0; k < values.size(); ++k) {
        if (offsets[i] == offsets[k]) noise(to_index(i), to_index(k)) += offset_sds[i] * offset_sds[k];
      }
    }
    return {std::move(rows), Eigen::Map<const Eigen::VectorXd>(values.data(), count), noise};
  }
};

/// Adds a series, so many blocks of one phase at a time as their mean.
void add_means(const PreparedSet& set, const Series& series, const Eigen::VectorXd& difference, std::size_t blocks,
               Examples& examples) {
  const Eigen::MatrixXd inputs = find_inputs(set, series);
  for (std::size_t first = 0, last = 0; first < series.size(); first = last) {
    while (last < series.size() && last < first + blocks && series.phase[last] == series.phase[first]) ++last;
    const Eigen::Index count = to_index(last - first);
    examples.inputs.emplace_back(inputs.middleRows(to_index(first), count).colwise().mean());
    examples.values.push_back(difference.segment(to_index(series.first_residual + first), count).mean() / series.floor);
    examples.offsets.push_back(series.offset);
    examples.offset_sds.push_back(series.offset_sd / series.floor);
  }
}

}  // namespace

GaussianProcess::GaussianProcess(Eigen::MatrixXd inputs, const Eigen::VectorXd& values, const Eigen::MatrixXd& noise)
    : inputs_(std::move(inputs)), weights_(Eigen::VectorXd::Zero(values.size())) {
  constexpr std::array<double, 4> kFactors{0.5, 1.0, 2.0, 4.0};
  constexpr std::array<double, 7> kSizes{0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0};
  double best = -std::numeric_limits<double>::infinity();
  for (const double factor : kFactors) {
    const Eigen::MatrixXd kernel = calc_kernel(inputs_, inputs_, factor);
    for (const double size : kSizes) {
      const Eigen::LLT<Eigen::MatrixXd> covariance(size * size * kernel + noise);
      const Eigen::VectorXd solved = covariance.solve(values);
      const double log_root = covariance.matrixLLT().diagonal().array().log().sum();
      const double log_likelihood = -0.5 * values.dot(solved) - log_root;
      if (!(log_likelihood > best)) continue;
      best = log_likelihood;
      factor_ = factor;
      weights_ = size * size * solved;
    }
  }
}

Eigen::VectorXd GaussianProcess::predict(const Eigen::MatrixXd& inputs) const {
  return calc_kernel(inputs, inputs_, factor_) * weights_;
}

Eigen::VectorXd subtract_gaussian_process(const PreparedSet& set, const Eigen::VectorXd& difference, std::size_t run) {
  constexpr std::size_t kMostExamples = 300;  // Assumed: of a channel, some more where phases are short
  Eigen::VectorXd rest = difference;
  for (std::size_t channel = 0; channel < set.channels().size(); ++channel) {
    std::size_t blocks = 0;
    const auto visit = [&](auto&& act) {
      for (const Series& series : set.series()) {
        if (series.channel == channel && series.run != run) act(series);
      }
    };
    visit([&](const Series& series) { blocks += series.size(); });
    Examples examples;
    visit([&](const Series& series) { add_means(set, series, difference, 1 + blocks / kMostExamples, examples); });
    if (examples.values.empty()) continue;
    const GaussianProcess process = examples.learn();
    for (const Series& series : set.series()) {
      if (series.channel != channel || series.run != run) continue;
      rest.segment(to_index(series.first_residual), to_index(series.size())) -=
          series.floor * process.predict(find_inputs(set, series));
    }
  }
  return rest;
}

}  // namespace rollrig::validation
