#pragma once
/// What a smooth function of the inputs, without physics, makes of a discrepancy: a yardstick for named causes.

#include "diagnosis/comparison/eigen_index.h"
#include "diagnosis/comparison/prepared_set.h"

#include <Eigen/Core>

namespace rollrig::diagnosis {

/// The discrepancy of one run less what a ridge regression learned on the other runs predicts for it, channel by
/// channel. Features of a block: 1, v, v^2, load, load v, skim or not, air temperature, initial tire temperature, cold
/// pressure, e^(-t/300 s), e^(-t/1200 s) of the run's time t and of the time since the last change of load; each
/// standardized, with a weight of one noise floor.
Eigen::VectorXd subtract_black_box(const PreparedSet& set, const Eigen::VectorXd& difference, std::size_t run);

}  // namespace rollrig::diagnosis
