#include "estimation/tire_fit/drum_residuals.h"

#include <cmath>
#include <map>

#include "measurements/sample_selection.h"
#include "sim/core/parallel.h"

namespace rollrig::estimation {
namespace {

/// Rows of a channel that the fit compares. Of a force those at constant speed, if the run has enough of them: the
/// others contain the inertia of the drum, of which no file says how well it is known.
std::vector<std::size_t> find_fitted_rows(const measurements::MeasuredRun& run, const Quantity& channel) {
  constexpr std::size_t kEnough = 30;  // Assumed: as of the two-step regression
  std::vector<std::size_t> rows = measurements::find_compared_rows(run, channel);
  if (!rigs::is_force(channel)) return rows;
  std::vector<std::size_t> steady;
  for (const std::size_t row : rows) {
    const double acceleration_m_s2 = measurements::find_acceleration(run, row);
    if (std::abs(acceleration_m_s2) < measurements::kSteadyAcceleration_m_s2) steady.push_back(row);
  }
  return steady.size() >= kEnough ? steady : rows;
}

}  // namespace

DrumResiduals::DrumResiduals(const measurements::MeasurementSet& set, models::Context<double> context,
                             std::vector<FreeParameter> parameters, int threads)
    : set_(set), context_(std::move(context)), parameters_(std::move(parameters)), threads_(threads) {
  for (const measurements::MeasuredRun& run : set_.runs) runs_.emplace_back(run, *set_.kind);
  collect_series();
  const Eigen::MatrixXd factor = calc_prior_factor(parameters_);
  prior_whitener_ =
      factor.triangularView<Eigen::Lower>().solve(Eigen::MatrixXd::Identity(factor.rows(), factor.cols()));
  residual_count_ = sample_count_ + static_cast<std::size_t>(factor.rows()) + offset_sd_.size();
}

void DrumResiduals::collect_series() {
  std::map<std::pair<std::string, Quantity>, std::size_t> offsets;  // by session and channel
  for (std::size_t r = 0; r < set_.runs.size(); ++r) {
    const measurements::MeasuredRun& run = set_.runs[r];
    for (const Quantity& channel : measurements::measured_channels(*set_.kind)) {
      if (!run.has(channel)) continue;
      const models::SensorParameters& sensor = set_.sensors.at(channel);
      std::vector<std::size_t> rows = find_fitted_rows(run, channel);
      if (rows.empty()) continue;
      const auto [it, fresh] = offsets.emplace(std::pair(run.session, channel), offset_sd_.size());
      if (fresh) offset_sd_.push_back(sensor.offset_sd);
      measurements::Whitener whitener(sensor, measurements::find_times(run, rows));
      ComparedSeries series{r, channel, it->second, std::move(rows), std::move(whitener), sample_count_};
      whitened_ones_.emplace_back(series.rows.size(), 1.0);
      series.whitener.apply(whitened_ones_.back().data(), 1);
      sample_count_ += series.rows.size();
      series_.push_back(std::move(series));
    }
  }
}

std::vector<double> DrumResiduals::start() const {
  std::vector<double> unknowns(unknown_count(), 0.0);
  for (std::size_t i = 0; i < parameters_.size(); ++i) unknowns[i] = parameters_[i].start_SI;
  return unknowns;
}

template <class S>
void DrumResiduals::evaluate_run(std::size_t r, const std::vector<S>& values, const Columns& columns,
                                 double* residuals) const {
  models::Context<S> context = models::convert_context<S>(context_);
  for (std::size_t i = 0; i < parameters_.size(); ++i) find_parameter(context, parameters_[i].key) = values[i];
  models::Corner<S> corner(std::move(context), {});
  const measurements::MeasuredRun& run = set_.runs[r];
  const sim::Recording<S> recording = runs_[r].simulate(set_, run, corner);
  for (const ComparedSeries& series : series_) {
    if (series.run != r) continue;
    const std::vector<S>& simulated = recording.channel(series.channel);
    const std::vector<double>& measured = run.column(series.channel);
    const std::size_t n = series.rows.size();
    std::vector<double> difference(n);
    std::vector<double> derivatives(n * columns.count);
    for (std::size_t k = 0; k < n; ++k) {
      const S& at = simulated[series.rows[k]];
      difference[k] = measured[series.rows[k]] - value_of(at);
      if constexpr (std::is_same_v<S, Jet>) {
        for (std::size_t c = 0; c < columns.count; ++c)
          derivatives[k * columns.count + c] = at.v[static_cast<Eigen::Index>(c)];
      }
    }
    series.whitener.apply(difference.data(), 1);
    std::copy(difference.begin(), difference.end(), residuals + series.first_residual);
    if (columns.count == 0) continue;
    series.whitener.apply(derivatives.data(), columns.count);
    for (std::size_t k = 0; k < n; ++k) {
      double* row = columns.jacobian + (series.first_residual + k) * unknown_count() + columns.first;
      for (std::size_t c = 0; c < columns.count; ++c) row[c] = -derivatives[k * columns.count + c];
    }
  }
}

void DrumResiduals::add_offsets_and_priors(const double* unknowns, double* residuals, double* jacobian) const {
  const std::size_t width = unknown_count();
  const double* offsets = unknowns + parameters_.size();
  for (std::size_t s = 0; s < series_.size(); ++s) {
    const std::size_t offset = series_[s].offset;
    for (std::size_t k = 0; k < whitened_ones_[s].size(); ++k) {
      const double per_sd = offset_sd_[offset] * whitened_ones_[s][k];
      residuals[series_[s].first_residual + k] -= offsets[offset] * per_sd;
      if (jacobian != nullptr) {
        jacobian[(series_[s].first_residual + k) * width + parameters_.size() + offset] = -per_sd;
      }
    }
  }
  add_priors(unknowns, residuals, jacobian);
  const std::size_t first = residual_count_ - offset_sd_.size();
  for (std::size_t i = 0; i < offset_sd_.size(); ++i) {
    residuals[first + i] = offsets[i];
    if (jacobian != nullptr) jacobian[(first + i) * width + parameters_.size() + i] = 1.0;
  }
}

void DrumResiduals::add_priors(const double* unknowns, double* residuals, double* jacobian) const {
  const Eigen::Index count = prior_whitener_.rows();
  Eigen::Map<Eigen::VectorXd> whitened(residuals + sample_count_, count);
  whitened.setZero();
  Eigen::Index prior = 0;
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const double sd = parameters_[i].prior_sd_SI;
    if (!(sd > 0.0)) continue;
    whitened += prior_whitener_.col(prior) * ((unknowns[i] - parameters_[i].start_SI) / sd);
    for (Eigen::Index row = 0; row < count && jacobian != nullptr; ++row) {
      jacobian[(sample_count_ + static_cast<std::size_t>(row)) * unknown_count() + i] =
          prior_whitener_(row, prior) / sd;
    }
    ++prior;
  }
}

void DrumResiduals::evaluate(const double* unknowns, double* residuals, double* jacobian) const {
  const std::size_t p = parameters_.size();
  const auto evaluate_runs = [&](const auto& values, const Columns& columns) {
    parallel_for(set_.runs.size(), threads_, [&](std::size_t r) { evaluate_run(r, values, columns, residuals); });
  };
  if (jacobian == nullptr) {
    evaluate_runs(std::vector<double>(unknowns, unknowns + p), {});
  } else {
    std::fill(jacobian, jacobian + residual_count_ * unknown_count(), 0.0);
    for (std::size_t first = 0; first < p; first += kJetWidth) {
      const std::size_t columns = std::min<std::size_t>(kJetWidth, p - first);
      std::vector<Jet> values;
      for (std::size_t i = 0; i < p; ++i) {
        const bool varied = i >= first && i < first + columns;
        values.push_back(varied ? Jet(unknowns[i], static_cast<int>(i - first)) : Jet(unknowns[i]));
      }
      evaluate_runs(values, {jacobian, first, columns});
    }
  }
  add_offsets_and_priors(unknowns, residuals, jacobian);
}

}  // namespace rollrig::estimation
