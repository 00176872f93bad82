/// The form of SAE J2452, fitted to a virtual stepwise coastdown.
#include <Eigen/Dense>
#include <cmath>

#include "tools/independent.h"

namespace rollrig::tools::independent {
namespace {

constexpr std::array<double, 7> kSpeeds_km_h{115.0, 95.0, 80.0, 65.0, 50.0, 30.0, 15.0};
constexpr auto kSpeedCount = static_cast<Eigen::Index>(kSpeeds_km_h.size());

/// One coastdown: a warm tire goes through all speeds so fast that its temperature hardly changes.
struct Coastdown {
  double pressure_kPa = 0.0;
  double load_N = 0.0;
  std::vector<double> loss_N;
};

Coastdown run_coastdown(const StudyTire& tire, double pressure_share, double load_share) {
  constexpr double kWarmUp_s = 3600.0, kWarmUpTruck_s = 14400.0, kStep_s = 15.0;  // Assumed
  Coastdown test{pressure_share * tire.pressure_Pa() / 1e3, load_share * tire.load_N(), {}};
  std::vector<Step> steps{{tire.is_truck() ? kWarmUpTruck_s : kWarmUp_s, 80.0 / 3.6}};
  for (const double speed_km_h : kSpeeds_km_h) steps.push_back({kStep_s, speed_km_h / 3.6});
  const std::vector<RollingState> states = roll_steps(tire, test.load_N, 1e3 * test.pressure_kPa, steps);
  for (std::size_t i = 1; i < states.size(); ++i) test.loss_N.push_back(states[i].loss_N);
  return test;
}

/// ln R = level of the speed + alpha ln P + beta ln Z
struct LogFit {
  double alpha = 0.0, beta = 0.0;
  Eigen::VectorXd levels;
};

LogFit fit_logarithms(const std::vector<Coastdown>& tests) {
  const Eigen::Index rows = kSpeedCount * static_cast<Eigen::Index>(tests.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(rows, kSpeedCount + 2);
  Eigen::VectorXd logs(rows);
  Eigen::Index row = 0;
  for (const Coastdown& test : tests) {
    for (Eigen::Index i = 0; i < kSpeedCount; ++i, ++row) {
      matrix(row, i) = 1.0;
      matrix(row, kSpeedCount) = std::log(test.pressure_kPa);
      matrix(row, kSpeedCount + 1) = std::log(test.load_N);
      logs[row] = std::log(test.loss_N[static_cast<std::size_t>(i)]);
    }
  }
  const Eigen::VectorXd x = matrix.colPivHouseholderQr().solve(logs);
  return {x[kSpeedCount], x[kSpeedCount + 1], x.head(kSpeedCount)};
}

/// a + b V + c V^2 through the levels, by relative differences.
Eigen::Vector3d fit_parabola(const Eigen::VectorXd& levels) {
  Eigen::MatrixXd parabola(kSpeedCount, 3);
  for (Eigen::Index i = 0; i < kSpeedCount; ++i) {
    const double v = kSpeeds_km_h[static_cast<std::size_t>(i)];
    parabola.row(i) << 1.0, v, v * v;
  }
  const Eigen::VectorXd weights = (-levels).array().exp();
  return (weights.asDiagonal() * parabola).colPivHouseholderQr().solve(Eigen::VectorXd::Ones(kSpeedCount));
}

void find_misses(const std::vector<Coastdown>& tests, J2452Fit& fit) {
  double squares = 0.0;
  for (const Coastdown& test : tests) {
    const double factor = std::pow(test.pressure_kPa, fit.alpha) * std::pow(test.load_N, fit.beta);
    for (std::size_t i = 0; i < kSpeeds_km_h.size(); ++i) {
      const double v = kSpeeds_km_h[i];
      const double miss = factor * (fit.a + fit.b * v + fit.c * v * v) / test.loss_N[i] - 1.0;
      squares += miss * miss;
      fit.worst = std::max(fit.worst, std::abs(miss));
    }
  }
  fit.rms = std::sqrt(squares / static_cast<double>(tests.size() * kSpeeds_km_h.size()));
}

}  // namespace

J2452Fit fit_j2452(const StudyTire& tire) {
  std::vector<Coastdown> tests;
  for (const double pressure_share : {0.75, 1.0, 1.15}) {
    for (const double load_share : {0.5, 0.75, 1.0}) tests.push_back(run_coastdown(tire, pressure_share, load_share));
  }
  const LogFit logs = fit_logarithms(tests);
  const Eigen::Vector3d abc = fit_parabola(logs.levels);
  J2452Fit fit{logs.alpha, logs.beta, abc[0], abc[1], abc[2]};
  find_misses(tests, fit);
  return fit;
}

}  // namespace rollrig::tools::independent
