#pragma once
/// Parts that the simulation lacks in all runs alike, and what they leave.

#include <Eigen/Core>
#include <vector>

#include "diagnosis/checks/channel_products.h"

namespace rollrig::diagnosis {

/// The parts that all runs have in common, by channel, in their standard deviations; empty for none.
using CommonParts = std::vector<Eigen::VectorXd>;

/// Fits the common parts to all runs, and again without those that they do not describe.
CommonParts fit_common(const std::vector<const RunProducts*>& runs);

/// Logarithm of the probability of common parts before the data, for an unknown size.
double calc_common_log_prior(const CommonParts& common, const RunProducts& products, double size);

/// The middle one of values; of an even number, the upper one of the middle two.
double calc_upper_median(std::vector<double> values);

/// The products of what common parts leave.
ChannelProducts subtract_common(ChannelProducts products, const Eigen::VectorXd& common);

}  // namespace rollrig::diagnosis
