/// Rubber that has rested loses more: two parts of its structure break down and build up at their own pace.
#include <algorithm>
#include <array>
#include <cmath>

#include "blind/effect.h"

namespace blind {
namespace {

class RubberMemory : public Effect {
 public:
  RubberMemory(double excess_percent, Draws& draws) : excess_(0.01 * excess_percent) {
    const double decay_min = draws.from(log_normal(3.0, 20.0, 2.0, 30.0));
    const double apart = draws.uniform(1.2, 2.0);
    const double recovery_min = draws.from(log_normal(8.0, 60.0, 5.0, 120.0));
    weight_ = draws.uniform(0.35, 0.65);
    decay_s_ = {60.0 * decay_min / apart, 60.0 * decay_min * apart};
    recovery_s_ = {60.0 * recovery_min / apart, 60.0 * recovery_min * apart};
    shape = {{"decay_min", decay_min},
             {"recovery_min", recovery_min},
             {"time_constants_apart", apart},
             {"weight_of_fast", weight_}};
  }

  std::size_t state_count() const override { return 2; }

  void start(const RunStart& start, double* rested) const override {
    for (std::size_t i = 0; i < 2; ++i) {
      // Not soaked: worked in before the rest.
      rested[i] =
          start.rest_before_min.has_value() ? -std::expm1(-60.0 * *start.rest_before_min / recovery_s_[i]) : 1.0;
    }
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

}  // namespace

extern const EffectKind kind_rubber_memory;
const EffectKind kind_rubber_memory{
    "rubber_memory",
    "percent",
    "higher loss after long rest",
    0.0,
    0.0,
    100.0,
    log_normal(1.0, 8.0, 0.6, 12.0),
    false,
    0.0,
    "two parts that break down under load and build up at rest or in skim, each with its own time constants: a "
    "stretched decay; work saturates with the square of the load",
    [](double size, Draws& draws, const Specimen&) -> std::unique_ptr<Effect> {
      return std::make_unique<RubberMemory>(size, draws);
    }};

}  // namespace blind
