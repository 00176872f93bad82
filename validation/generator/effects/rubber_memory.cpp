/// Rubber that has rested loses more: its structure breaks down and builds up, in two parts or by a second order.
#include <algorithm>
#include <array>
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

class RubberMemory : public Effect {
 public:
  explicit RubberMemory(const Making& of) : Effect(of), excess_(0.01 * of.size) {
    const double decay_min = of.draws.from(log_normal(3.0, 20.0, 2.0, 30.0));
    const double apart = of.draws.uniform(1.2, 2.0);
    const double recovery_min = of.draws.from(log_normal(8.0, 60.0, 5.0, 120.0));
    weight_ = of.draws.uniform(0.35, 0.65);
    decay_s_ = {60.0 * decay_min / apart, 60.0 * decay_min * apart};
    recovery_s_ = {60.0 * recovery_min / apart, 60.0 * recovery_min * apart};
    shape = {{"decay_min", decay_min},
             {"recovery_min", recovery_min},
             {"time_constants_apart", apart},
             {"weight_of_fast", weight_}};
  }

  std::size_t state_count() const override { return 2; }

  void start(const RunStart& start, double* rested) const override {
    // Not soaked: worked in before the rest.
    for (std::size_t i = 0; i < 2; ++i) rested[i] = start.recovered_in_rest(recovery_s_[i]);
  }

  void act(const double* rested, Instant& now) const override {
    now.loss_factor *= 1.0 + excess_ * (weight_ * rested[0] + (1.0 - weight_) * rested[1]);
  }

  void rates(const double* rested, const Instant& now, double* rates) const override {
    const double load = std::max(0.0, now.load_N) / now.specimen->reference_load_N;
    const double work = load * load / (load * load + 0.02) * now.speed_m_s / (now.speed_m_s + 1.0);
    for (std::size_t i = 0; i < 2; ++i) {
      rates[i] = (1.0 - rested[i]) * (1.0 - work) / recovery_s_[i] - rested[i] * work / decay_s_[i];
    }
  }

 private:
  double excess_;
  double weight_ = 0.5;
  std::array<double, 2> decay_s_{};
  std::array<double, 2> recovery_s_{};
};

/// Structure that breaks down in pairs of bonds, ds/dt = -s^2 w/tau, as Kraus has it for filled rubber.
class SecondOrderMemory : public Effect {
 public:
  using Effect::Effect;

  std::size_t state_count() const override { return 1; }

  void start(const RunStart& start, double* rested) const override { rested[0] = start.recovered_in_rest(recovery_s_); }

  void act(const double* rested, Instant& now) const override { now.loss_factor *= 1.0 + excess_ * rested[0]; }

  void rates(const double* rested, const Instant& now, double* rates) const override {
    const double load = std::max(0.0, now.load_N) / now.specimen->reference_load_N;
    const double strained = load / (load + 0.15);  // Assumed: half worked at 15 % of the reference load
    const double work = strained * now.speed_m_s / (now.speed_m_s + 1.0);
    rates[0] = (1.0 - rested[0]) * (1.0 - work) / recovery_s_ - rested[0] * std::abs(rested[0]) * work / decay_s_;
  }

 private:
  static constexpr double kHalf = 0.69314718;  // ln 2

  double excess_ = 0.01 * size_;
  // Half is gone when it is of a first-order decay.
  double decay_s_ = kHalf * 60.0 * note("decay_min", draws_.from(log_normal(3.0, 20.0, 2.0, 30.0)));
  double recovery_s_ = 60.0 * note("recovery_min", draws_.from(log_normal(8.0, 60.0, 5.0, 120.0)));
};

}  // namespace

const EffectKind kind_rubber_memory{
    "rubber_memory",
    {"percent", "higher loss after long rest", 0.0, 0.0, 100.0, log_normal(1.0, 8.0, 0.6, 12.0)},
    {{"two_parts",
      "two parts that break down under load and build up at rest or in skim, each with its own time constants: a "
      "stretched decay; work saturates with the square of the load",
      make_law<RubberMemory>},
     {"second_order",
      "one structure that breaks down by a law of second order, 1/(1 + t/tau), while it is worked, and builds up at "
      "rest or in skim by one of first order",
      make_law<SecondOrderMemory>}}};

}  // namespace rollrig::generator
