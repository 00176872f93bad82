#include "sim/rosenbrock_integrator.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>

#include "sim/core/error.h"

namespace rollrig::sim {
namespace {

using Matrix4 = Eigen::Matrix4d;

/// Table 4.2 of the source, in the variables u = G k, with which a stage takes no product with A: Hairer and Wanner,
/// Solving Ordinary Differential Equations II, section IV.7.
struct Rule {
  Matrix4 argument;           // of a stage: alpha G^-1
  Matrix4 coupling;           // of earlier stages: diag(1/gamma) - G^-1
  Eigen::RowVector4d weight;  // b G^-1
  Eigen::RowVector4d error;   // (b - bh) G^-1
  Eigen::Vector4d time;       // row sums of alpha
  Eigen::Vector4d drift;      // row sums of G
  double gamma = 0.435866521508459;

  Rule() {
    Matrix4 alpha = Matrix4::Zero();
    alpha(1, 0) = 0.87173304301691801;
    alpha(2, 0) = 0.84457060015369423;
    alpha(2, 1) = -0.11299064236484185;
    alpha(3, 2) = 1.0;
    Matrix4 g = gamma * Matrix4::Identity();
    g(1, 0) = -0.87173304301691801;
    g(2, 0) = -0.90338057013044082;
    g(2, 1) = 0.054180672388095326;
    g(3, 0) = 0.24212380706095346;
    g(3, 1) = -1.2232505839045147;
    g(3, 2) = 0.54526025533510214;
    const Eigen::RowVector4d b = alpha.row(3) + g.row(3);  // stiffly accurate
    const Eigen::RowVector4d embedded(0.37810903145819369, -0.096042292212423178, 0.5, 0.21793326075422950);
    const Matrix4 inverse = g.inverse();
    argument = alpha * inverse;
    coupling = Matrix4::Identity() / gamma - inverse;
    weight = b * inverse;
    error = (b - embedded) * inverse;
    time = alpha.rowwise().sum();
    drift = g.rowwise().sum();
  }
};

const Rule& rule() {
  static const Rule kRule;
  return kRule;
}

constexpr int kStages = 4;
// Of a Jacobian. Assumed: a vehicle changes its speed by some 3 m/s meanwhile.
constexpr int kOldest_steps = 20;
constexpr double kOldest_s = 5.0;
constexpr double kFirstStep_s = 1e-3;  // Assumed: of a run; each segment begins with what the one before needed

/// By how much the next step may differ from one with this error, which goes with the third power of the step.
double find_change(double error, double least, double most) {
  constexpr double kSafety = 0.9;
  if (!std::isfinite(error)) return least;
  return std::clamp(kSafety / std::cbrt(std::max(error, 1e-12)), least, most);
}

}  // namespace

RosenbrockIntegrator::RosenbrockIntegrator(OdeSystem<double>& system, const RosenbrockOptions& options)
    : system_(system),
      n_(system.state_count()),
      total_(n_ + system.integrals().size()),
      differences_(system.state_tolerances()) {
  const auto size = static_cast<Eigen::Index>(total_);
  for (Vector* v :
       {&y_, &y_before_, &y_trial_, &argument_, &error_, &rate_, &rate_before_, &rate_other_, &tolerance_}) {
    v->setZero(size);
  }
  u_.assign(kStages, Vector::Zero(size));
  const auto n = static_cast<Eigen::Index>(n_);
  jacobian_.setZero(n, n);
  drift_.setZero(n);
  const std::vector<double> states = system.state_tolerances();
  for (std::size_t i = 0; i < total_; ++i) {
    const double absolute = i < n_ ? states[i] : system.integrals()[i - n_].tolerance_SI;
    tolerance_[static_cast<Eigen::Index>(i)] = options.tolerance_factor * options.absolute_factor * absolute;
  }
  relative_tolerance_ = options.relative_tolerance * options.tolerance_factor;
}

void RosenbrockIntegrator::begin_run(double time_s) {
  time_s_ = before_s_ = time_s;
  y_.setZero();
  first_h_s_ = kFirstStep_s;
}

/// A driver who lets go takes his own stiffness with him.
void RosenbrockIntegrator::begin_phase() { jacobian_age_ = kOldest_steps; }

void RosenbrockIntegrator::begin_segment(double, const StopCondition* stop) {
  stop_ = stop;
  has_rate_ = false;
  is_first_ = true;
  next_h_s_ = first_h_s_;
}

bool RosenbrockIntegrator::evaluate(double time_s, const Vector& y, Vector& rates) {
  system_.evaluate(time_s, y.data(), rates.data(), rates.data() + n_);
  ++statistics_.rate_evaluations;
  return rates.allFinite();
}

bool RosenbrockIntegrator::step(double end_time_s) {
  if (stop_ != nullptr && distance_to_stop(time_s_, y_.data()) <= 0.0) return true;
  const double left_s = end_time_s - time_s_;
  require_rates();
  if (is_first_) {
    find_drift(left_s);
  } else {
    follow_drift();
  }
  double h_s = fit_step(next_h_s_, left_s);
  int failures = 0;
  while (!try_step(h_s)) {
    h_s = fit_step(h_s * find_change(calc_error(), 0.1, 0.7), left_s);
    ++failures;
    ++statistics_.error_test_failures;
    if (failures > 1 && jacobian_age_ > 0) jacobian_age_ = kOldest_steps;
    if (h_s < 1e-13 * std::max(1.0, std::abs(time_s_))) fail("steps become too short to go on");
  }
  const double error = calc_error();
  if (is_first_) first_h_s_ = h_s * find_change(error, 0.2, failures > 0 ? 1.0 : 5.0);
  next_h_s_ = h_s * find_change(error, 0.2, 6.0);
  is_first_ = false;
  advance(h_s);
  if (h_s == left_s) time_s_ = end_time_s;
  return stop_ != nullptr && stop_inside_step();
}

void RosenbrockIntegrator::fail(const char* why) const {
  throw RunFailure(
      fmt::format("integration failed at t = {} s: {}; the last good state is that of this time", time_s_, why));
}

/// The step, or as much as is left; two equal ones instead of one and a short one.
double RosenbrockIntegrator::fit_step(double h_s, double left_s) {
  if (h_s >= left_s) return left_s;
  return std::min(h_s, 0.5 * left_s);
}

/// A step from y_ to y_trial_; false where its error is too large.
bool RosenbrockIntegrator::try_step(double h_s) {
  if (jacobian_age_ >= kOldest_steps || time_s_ - jacobian_s_ > kOldest_s) find_jacobian();
  const Rule& r = rule();
  if (factored_h_s_ != h_s) {
    Eigen::MatrixXd matrix = -jacobian_;
    matrix.diagonal().array() += 1.0 / (h_s * r.gamma);
    factors_.compute(matrix);
    factored_h_s_ = h_s;
  }
  y_trial_ = y_;
  error_.setZero();
  for (int i = 0; i < kStages; ++i) {
    if (!find_stage(i, h_s)) {
      error_.setConstant(std::numeric_limits<double>::infinity());
      return false;
    }
    y_trial_ += r.weight[i] * stage(i);
    error_ += r.error[i] * stage(i);
  }
  return calc_error() <= 1.0;
}

/// u_i of a step; false where rates are not finite.
bool RosenbrockIntegrator::find_stage(int i, double h_s) {
  const Rule& r = rule();
  const auto n = static_cast<Eigen::Index>(n_);
  Vector& u = stage(i);
  if (i == 0) {
    u = rate_;
  } else {
    argument_ = y_;
    for (int j = 0; j < i; ++j) argument_ += r.argument(i, j) * stage(j);
    if (!argument_.allFinite() || !evaluate(time_s_ + r.time[i] * h_s, argument_, u)) return false;
    for (int j = 0; j < i; ++j) u += r.coupling(i, j) / h_s * stage(j);
  }
  u.head(n) += h_s * r.drift[i] * drift_;
  u.head(n) = factors_.solve(u.head(n)).eval();
  u.tail(u.size() - n) *= h_s * r.gamma;
  return true;
}

/// Of states and of integrals the root mean square over what is tolerated; the larger of the two.
double RosenbrockIntegrator::calc_error() const {
  double states = 0.0, integrals = 0.0;
  for (std::size_t i = 0; i < total_; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const double weight = tolerance_[at] + (i < n_ ? relative_tolerance_ * std::abs(y_[at]) : 0.0);
    const double share = error_[at] / weight;
    (i < n_ ? states : integrals) += share * share;
  }
  return std::sqrt(std::max(states / static_cast<double>(std::max<std::size_t>(n_, 1)),
                            integrals / static_cast<double>(std::max<std::size_t>(total_ - n_, 1))));
}

void RosenbrockIntegrator::advance(double h_s) {
  std::swap(y_, y_before_);
  std::swap(y_, y_trial_);
  std::swap(rate_, rate_before_);
  before_s_ = time_s_;
  time_s_ += h_s;
  has_rate_ = false;
  ++jacobian_age_;
  ++statistics_.steps;
}

/// How the rates change with time alone.
void RosenbrockIntegrator::find_drift(double left_s) {
  const double by_s = std::min(0.1 * left_s, 0.01);
  const auto n = static_cast<Eigen::Index>(n_);
  evaluate(time_s_ + by_s, y_, rate_other_);
  drift_ = (rate_other_.head(n) - rate_.head(n)) / by_s;
}

/// The same after a step: what the Jacobian does not explain of the change of the rates.
void RosenbrockIntegrator::follow_drift() {
  const auto n = static_cast<Eigen::Index>(n_);
  drift_ = (rate_.head(n) - rate_before_.head(n) - jacobian_ * (y_ - y_before_).head(n)) / (time_s_ - before_s_);
}

void RosenbrockIntegrator::find_jacobian() {
  ++statistics_.jacobian_evaluations;
  jacobian_age_ = 0;
  jacobian_s_ = time_s_;
  factored_h_s_ = 0.0;
  differences_.fill(y_.data(), rate_.data(), jacobian_.data(), [this](const double* y, double* rates) {
    system_.evaluate(time_s_, y, rates, nullptr);
    ++statistics_.rate_evaluations;
  });
}

/// Rates at y_, under the inputs of the segment: at a knot there are those before it, and those after it.
void RosenbrockIntegrator::require_rates() {
  if (has_rate_) return;
  if (!evaluate(time_s_, y_, rate_)) fail("rates are not finite");
  has_rate_ = true;
}

void RosenbrockIntegrator::interpolate(double time_s, std::size_t first, std::size_t count, double* out) {
  if (time_s >= time_s_) {
    std::copy(y_.data() + first, y_.data() + first + count, out);
    return;
  }
  require_rates();
  const double h_s = time_s_ - before_s_;
  const double x = (time_s - before_s_) / h_s;
  const double x2 = x * x, x3 = x2 * x;
  for (std::size_t k = 0; k < count; ++k) {
    const auto i = static_cast<Eigen::Index>(first + k);
    out[k] = (2.0 * x3 - 3.0 * x2 + 1.0) * y_before_[i] + (3.0 * x2 - 2.0 * x3) * y_[i] +
             h_s * ((x3 - 2.0 * x2 + x) * rate_before_[i] + (x3 - x2) * rate_[i]);
  }
}

void RosenbrockIntegrator::interpolate_state(double time_s, double* state) { interpolate(time_s, 0, n_, state); }

void RosenbrockIntegrator::interpolate_integrals(double time_s, double* integrals) {
  interpolate(time_s, n_, total_ - n_, integrals);
}

double RosenbrockIntegrator::distance_to_stop(double time_s, const double* state) {
  const double sign = stop_->direction == StopCondition::Direction::kFalling ? 1.0 : -1.0;
  return sign * (system_.watch(stop_->watch, time_s, state) - stop_->threshold_SI);
}

/// Whether the condition is met within the last step. Then the step is taken anew, as long as it takes to meet it:
/// between the ends of a long step, energies would close less well than at its end.
bool RosenbrockIntegrator::stop_inside_step() {
  const double after = distance_to_stop(time_s_, y_.data());
  if (after > 0.0) return false;
  const double end_s = time_s_;
  std::swap(y_, y_before_);
  std::swap(rate_, rate_before_);
  time_s_ = before_s_;
  has_rate_ = true;
  const auto distance = [&](double time_s) {
    if (!try_step(time_s - before_s_) && !y_trial_.allFinite()) fail("rates are not finite");
    return distance_to_stop(time_s, y_trial_.data());
  };
  std::uintmax_t most = 100;
  const boost::math::tools::eps_tolerance<double> exact(45);
  const auto bracket = boost::math::tools::toms748_solve(distance, before_s_, end_s,
                                                         distance_to_stop(before_s_, y_.data()), after, exact, most);
  distance(bracket.second);
  advance(bracket.second - before_s_);
  time_s_ = bracket.second;
  return true;
}

}  // namespace rollrig::sim
