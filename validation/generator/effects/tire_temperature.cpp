/// The loss follows the temperature of a tire with four layers, where a constant coefficient is reckoned with.
#include <algorithm>
#include <cmath>

#include "sim/core/units.h"
#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

class TireTemperature : public Effect {
 public:
  using Effect::Effect;

  void act(const double*, Instant& now) const override {
    const double softer = std::max(0.2, 1.0 + fall_per_K_ * (now.rubber_degC - reference_degC_) / power_);
    now.loss_factor *= std::pow(softer, -power_);
  }

 private:
  double fall_per_K_ = size_;
  double reference_degC_ = note("reference_degC", draws_.uniform(28.0, 42.0));
  double power_ = note("power", draws_.uniform(3.0, 8.0));
};

/// Arrhenius' law with the fall of the size at the temperature where the coefficient holds.
class ArrheniusLoss : public Effect {
 public:
  using Effect::Effect;

  void act(const double*, Instant& now) const override {
    now.loss_factor *= std::exp(activation_K_ * (1.0 / (now.rubber_degC + kZeroCelsius_K) - 1.0 / reference_K_));
  }

 private:
  double reference_K_ = note("reference_degC", draws_.uniform(28.0, 42.0)) + kZeroCelsius_K;
  double activation_K_ = size_ * reference_K_ * reference_K_;
};

}  // namespace

const EffectKind kind_tire_temperature{
    "tire_temperature",
    {"1/K", "relative fall of the loss per K at the temperature where the coefficient holds", 0.0, 0.0, 0.1,
     log_normal(0.008, 0.03, 0.006, 0.035)},
    {{"power",
      "power of a linear function of the temperature instead of an exponential; heated by the loss, cooled by air and "
      "road with the speed",
      make_law<TireTemperature>},
     {"arrhenius",
      "Arrhenius' law exp(E/R (1/T - 1/T_0)) instead of an exponential; heated by the loss, cooled by air and road "
      "with the speed",
      make_law<ArrheniusLoss>}},
    kConstantGround,
    kConstantGround};

}  // namespace rollrig::generator
