#pragma once
/// What a channel of a run measured beside its simulation, in the form in which hypotheses on mistakes are compared.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "diagnosis/checks/plausibility.h"

namespace rollrig::diagnosis {

/// Rows of the measured channels by which the hypotheses on a run are compared, the same for all of them.
using ComparedRows = QuantityMap<std::vector<std::size_t>>;

/// Rows of a run as it is: on a vehicle all samples, else those that a comparison uses, or all where these are fewer
/// than half of the samples (as where the speed is not one).
ComparedRows choose_rows(const measurements::MeasurementSet& set, const measurements::MeasuredRun& run);

/// Residual of a channel and the parts that a simulation may not know, whitened: what its likelihood is made of. Parts
/// are in their standard deviations; those of the first `scaled` grow with the unknown size, the last is the offset of
/// the sensor.
struct ChannelProducts {
  double count = 0.0;
  double residual = 0.0;       // squared
  Eigen::VectorXd projection;  // of the residual on the parts
  Eigen::MatrixXd gram;        // of the parts
  Eigen::Index scaled = 0;
};

/// By channel; in all runs in the order of the measured channels of the set's kind. None where there are no samples.
using RunProducts = std::vector<std::optional<ChannelProducts>>;

/// `times_s` are those of the file, by which samples are averaged: a hypothesis on the unit of time must not change how
/// many averages it is judged by.
RunProducts calc_products(const measurements::MeasurementSet& set, const measurements::MeasuredRun& run,
                          const sim::Recording<double>& simulated, const ComparedRows& rows,
                          const std::vector<double>& times_s);

}  // namespace rollrig::diagnosis
