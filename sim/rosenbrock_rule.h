#pragma once
/// Coefficients of the Rosenbrock-W method ROS34PW2.

#include <Eigen/Dense>

namespace rollrig::sim {

/// Source    J. Rang and L. Angermann, BIT 45 (2005) 761, table 4.2; the variables u = G k, with which a stage takes no
///           product with A: Hairer and Wanner, Solving Ordinary Differential Equations II, section IV.7
/// Checked   tests/sim/rosenbrock_integrator_test.cpp
struct RosenbrockRule {
  static constexpr int kStages = 4;
  static constexpr double kGamma = 0.435866521508459;  // of every stage: the diagonal of G

  Eigen::Matrix4d alpha;       // of a stage's argument, in the k of the stages before
  Eigen::Matrix4d g;           // of A k
  Eigen::RowVector4d b;        // of the solution of order 3
  Eigen::RowVector4d b_lower;  // of the embedded solution of order 2

  // In the variables u.
  Eigen::Matrix4d argument;   // alpha G^-1
  Eigen::Matrix4d coupling;   // with the stages before: diag(1/gamma) - G^-1
  Eigen::RowVector4d weight;  // b G^-1
  Eigen::RowVector4d error;   // (b - b_lower) G^-1
  Eigen::Vector4d time;       // row sums of alpha
  Eigen::Vector4d drift;      // row sums of G

  RosenbrockRule() {
    alpha.setZero();
    alpha(1, 0) = 0.87173304301691801;
    alpha(2, 0) = 0.84457060015369423;
    alpha(2, 1) = -0.11299064236484185;
    alpha(3, 2) = 1.0;
    g = kGamma * Eigen::Matrix4d::Identity();
    g(1, 0) = -0.87173304301691801;
    g(2, 0) = -0.90338057013044082;
    g(2, 1) = 0.054180672388095326;
    g(3, 0) = 0.24212380706095346;
    g(3, 1) = -1.2232505839045147;
    g(3, 2) = 0.54526025533510214;
    b = alpha.row(3) + g.row(3);  // so that a stiff component ends where its rate is zero
    b_lower << 0.37810903145819369, -0.096042292212423178, 0.5, 0.21793326075422950;
    const Eigen::Matrix4d inverse = g.inverse();
    argument = alpha * inverse;
    coupling = Eigen::Matrix4d::Identity() / kGamma - inverse;
    weight = b * inverse;
    error = (b - b_lower) * inverse;
    time = alpha.rowwise().sum();
    drift = g.rowwise().sum();
  }
};

}  // namespace rollrig::sim
