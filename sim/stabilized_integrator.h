#pragma once
/// Long steps where nothing changes fast any more, however fast the fastest state would answer.

#include <cmath>
#include <utility>
#include <vector>

#include "sim/fixed_grid_integrator.h"

namespace rollrig::sim {

/// Coefficients of the Runge-Kutta-Chebyshev rule of order 2 with so many stages, at least 2.
///
/// Equation  Y_1 = y + mt_1 h f(y);
///           Y_j = (1 - m_j - n_j) y + m_j Y_{j-1} + n_j Y_{j-2} + mt_j h f(Y_{j-1}) + g_j h f(y), j = 2 .. s;
///           m_j = 2 w_0 b_j/b_{j-1}, n_j = -b_j/b_{j-2}, mt_j = 2 w_1 b_j/b_{j-1}, g_j = -(1 - b_{j-1} T_{j-1}) mt_j;
///           b_j = T''_j/T'_j^2 for j > 1, b_0 = b_1 = b_2, mt_1 = b_1 w_1, w_0 = 1 + (2/13)/s^2, w_1 = T'_s/T''_s;
///           T_j and its derivatives at w_0
/// Symbols   T_j Chebyshev polynomial of degree j; f the rates, Y_j at the time t + c_j h
/// Validity  real, not positive eigenvalues down to -0.653 (s^2 - 1)/h: heat flows between nodes
/// Source    Sommeijer, Shampine and Verwer, J. Comput. Appl. Math. 88 (1998) 315, section 2
struct ChebyshevRule {
  struct Stage {
    double before = 0.0;       // m_j
    double before_last = 0.0;  // n_j
    double rate = 0.0;         // mt_j
    double first_rate = 0.0;   // g_j
    double time = 0.0;         // c_j, of the step
  };
  std::vector<Stage> stages;  // from j = 1 on

  explicit ChebyshevRule(int stage_count) {
    const double w0 = 1.0 + 2.0 / 13.0 / (stage_count * stage_count);
    std::vector<double> t{1.0, w0}, slope{0.0, 1.0}, bend{0.0, 0.0};
    for (std::size_t j = 2; j <= static_cast<std::size_t>(stage_count); ++j) {
      t.push_back(2.0 * w0 * t[j - 1] - t[j - 2]);
      slope.push_back(2.0 * t[j - 1] + 2.0 * w0 * slope[j - 1] - slope[j - 2]);
      bend.push_back(4.0 * slope[j - 1] + 2.0 * w0 * bend[j - 1] - bend[j - 2]);
    }
    const double w1 = slope.back() / bend.back();
    const auto b = [&](std::size_t j) {
      const std::size_t of = std::max<std::size_t>(j, 2);
      return bend[of] / (slope[of] * slope[of]);
    };
    stages.push_back({0.0, 0.0, b(1) * w1, 0.0, b(1) * w1});
    for (std::size_t j = 2; j < t.size(); ++j) {
      Stage stage{2.0 * w0 * b(j) / b(j - 1), -b(j) / b(j - 2), 2.0 * w1 * b(j) / b(j - 1)};
      stage.first_rate = -(1.0 - b(j - 1) * t[j - 1]) * stage.rate;
      const double before_last = j > 2 ? stages[j - 3].time : 0.0;
      stage.time = stage.before * stages[j - 2].time + stage.before_last * before_last + stage.rate + stage.first_rate;
      stages.push_back(stage);
    }
  }
};

/// Steps of up to `longest_classical_s` by the classical rule (fixed_grid_integrator.h); longer ones by the rule of
/// Runge, Kutta and Chebyshev, with stages enough that what is stable in that time stays stable. If it is 10 s, a step
/// of 60 s has 6 stages, where the classical rule takes 24 evaluations. After a step of up to 2 s, interpolation uses
/// the rates of the last stage instead of those at the end. This saves an evaluation in each segment of one step, such
/// as a row of a drive cycle.
///
/// Validity  as ChebyshevRule; longer steps where what changes within less than a few of them has died away
/// Accuracy  of the classical rule order 4, at the ends of steps and between, and order 3 in the rate of an integral
///           between; of longer steps order 2
/// Checked   tests/sim/stabilized_integrator_test.cpp
template <class S>
class StabilizedIntegrator : public FixedGridIntegrator<S> {
 public:
  explicit StabilizedIntegrator(OdeSystem<S>& system, double longest_classical_s = kLongestClassical_s)
      : FixedGridIntegrator<S>(system), longest_classical_s_(longest_classical_s) {}

  static constexpr double kLongestShort_s = 2.0;  // Assumed: above the second from row to row of a drive cycle
  static constexpr double kLongestClassical_s = 10.0;

  /// Stages of a step. Assumed: no eigenvalue beyond that which the classical rule bears in its longest step, -0.278/s
  /// of 10 s.
  static int count_stages(double step_s, double longest_classical_s = kLongestClassical_s) {
    constexpr double kBorneByClassical = 2.78;
    constexpr double kBorne = 0.653;  // of s^2 - 1
    const double stages = std::sqrt(1.0 + kBorneByClassical * step_s / longest_classical_s / kBorne);
    return std::max(2, static_cast<int>(std::ceil(stages)));
  }

 private:
  using Base = FixedGridIntegrator<S>;
  using Base::before_s_, Base::k4_, Base::rate_, Base::rate_before_, Base::y_, Base::y_before_;
  using typename Base::Vector;

  void begin() override {
    Base::begin();
    has_rate_at_end_ = true;
  }

  void advance_to(double target_s) override {
    constexpr double kRounding = 1.0 + 1e-9;
    const double h_s = target_s - before_s_;
    if (!has_rate_at_end_) this->evaluate(before_s_, y_before_, rate_before_);
    has_rate_at_end_ = h_s > kLongestShort_s * kRounding || this->is_watched();
    if (h_s > longest_classical_s_ * kRounding) return advance_far(target_s);
    if (has_rate_at_end_) return Base::advance_to(target_s);
    this->step_classically(target_s);
    std::swap(rate_, k4_);
  }

  void advance_far(double target_s) {
    const double h_s = target_s - before_s_;
    const ChebyshevRule& rule = find_rule(count_stages(h_s, longest_classical_s_));
    // Of the stages what they add to y, so that little is lost to rounding: of the one before, and of that before it.
    Vector before(this->total_, zero<S>());
    Vector before_last = before;
    Vector& rate = rate_;
    rate = rate_before_;
    for (std::size_t j = 0; j < rule.stages.size(); ++j) {
      const ChebyshevRule::Stage& stage = rule.stages[j];
      if (j > 0) this->evaluate(before_s_ + rule.stages[j - 1].time * h_s, y_, rate);
      for (std::size_t i = 0; i < this->total_; ++i) {
        const S added = stage.before * before[i] + stage.before_last * before_last[i] +
                        h_s * (stage.rate * rate[i] + stage.first_rate * rate_before_[i]);
        before_last[i] = before[i];
        before[i] = added;
        y_[i] = y_before_[i] + added;
      }
    }
    this->evaluate(target_s, y_, rate_);
    this->time_s_ = target_s;
  }

  const ChebyshevRule& find_rule(int stages) {
    while (rules_.size() <= static_cast<std::size_t>(stages)) {
      rules_.emplace_back(std::max(2, static_cast<int>(rules_.size())));
    }
    return rules_[static_cast<std::size_t>(stages)];
  }

  double longest_classical_s_;
  bool has_rate_at_end_ = true;       // whether rate_ is that of y_, not of a stage
  std::vector<ChebyshevRule> rules_;  // by stages
};

}  // namespace rollrig::sim
