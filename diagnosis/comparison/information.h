#pragma once
/// What an outcome would tell of which hypothesis is true.

#include <Eigen/Core>
#include <vector>

namespace rollrig::diagnosis {

/// What a hypothesis predicts: a normal distribution. All outcomes of one test are in the same coordinates.
struct PredictedOutcome {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

/// Distance of Bhattacharyya, -ln of the integral of sqrt(p q).
double calc_overlap_distance_nats(const PredictedOutcome& a, const PredictedOutcome& b);

/// Expected fall of the entropy of "which hypothesis is true", from below.
/// Equation  I >= -sum_i w_i log2 sum_j w_j exp(-D_ij)
/// Symbols   I information, bits; w probabilities of the hypotheses before the test; D distance of Bhattacharyya
///           (calc_overlap_distance_nats), nats
/// Validity  0 where all predict the same, the entropy of w where no two overlap, never above it
/// Source    Kolchinsky and Tracey, Entropy 19, 361 (2017), equation 10 with alpha = 1/2
/// Checked   tests/diagnosis/next_test_test.cpp
double calc_information_bits(const std::vector<double>& probabilities, const std::vector<PredictedOutcome>& outcomes);

}  // namespace rollrig::diagnosis
