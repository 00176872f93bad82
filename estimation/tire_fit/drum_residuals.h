#pragma once
/// Whitened difference between a measured drum set and the quasi-static simulation, with derivatives.

#include <vector>

#include "estimation/normal_prior.h"
#include "measurements/resimulation.h"
#include "measurements/whitener.h"

namespace rollrig::estimation {

/// Samples of one channel of one run that are compared.
struct ComparedSeries {
  std::size_t run = 0;
  Quantity channel;
  std::size_t offset = 0;  // index of the sensor offset that it shares with its session
  std::vector<std::size_t> rows;
  measurements::Whitener whitener;
  std::size_t first_residual = 0;  // index of its first residual
};

/// Residuals in units of one standard deviation, as a function of free parameters and sensor offsets:
/// all samples, whitened, then one residual for each prior and each offset.
/// Equation  r = W (y - h(parameters) - offset); of the priors L^-1 (x - x0)/s (calc_prior_factor)
/// Noise     one model: session offset, autoregressive drift, white noise, resolution (formats.md)
class DrumResiduals {
 public:
  DrumResiduals(const measurements::MeasurementSet& set, models::Context<double> context,
                std::vector<FreeParameter> parameters, int threads);

  std::size_t residual_count() const { return residual_count_; }
  std::size_t unknown_count() const { return parameters_.size() + offset_sd_.size(); }
  const std::vector<FreeParameter>& parameters() const { return parameters_; }
  const std::vector<ComparedSeries>& series() const { return series_; }
  std::vector<double> start() const;

  /// Offset of the sensor of a series.
  double calc_offset_SI(const ComparedSeries& series, const double* unknowns) const {
    return unknowns[parameters_.size() + series.offset] * offset_sd_[series.offset];
  }

  /// `unknowns`: parameters in SI units, then offsets in their standard deviations. `jacobian`, row-major,
  /// may be null.
  void evaluate(const double* unknowns, double* residuals, double* jacobian) const;

 private:
  /// Columns of the Jacobian that one pass fills.
  struct Columns {
    double* jacobian = nullptr;  // row-major, all columns
    std::size_t first = 0;
    std::size_t count = 0;
  };
  template <class S>
  void evaluate_run(std::size_t run, const std::vector<S>& values, const Columns& columns, double* residuals) const;
  void add_offsets_and_priors(const double* unknowns, double* residuals, double* jacobian) const;
  void add_priors(const double* unknowns, double* residuals, double* jacobian) const;
  void collect_series();

  const measurements::MeasurementSet& set_;
  models::Context<double> context_;
  std::vector<FreeParameter> parameters_;
  Eigen::MatrixXd prior_whitener_;  // L^-1
  std::vector<measurements::Resimulation> runs_;
  std::vector<ComparedSeries> series_;
  std::vector<double> offset_sd_;
  std::vector<std::vector<double>> whitened_ones_;  // one a series: what a unit offset does to its residuals
  std::size_t sample_count_ = 0;
  std::size_t residual_count_ = 0;
  int threads_;
};

}  // namespace rollrig::estimation
