/// The loss follows the temperature of a tire with four layers, where a constant coefficient is reckoned with.
#include <algorithm>
#include <cmath>

#include "validation/generator/effect.h"

namespace blind {
namespace {

class TireTemperature : public Effect {
 public:
  TireTemperature(double fall_per_K, Draws& draws) : fall_per_K_(fall_per_K) {
    reference_degC_ = draws.uniform(28.0, 42.0);
    power_ = draws.uniform(3.0, 8.0);
    shape = {{"reference_degC", reference_degC_}, {"power", power_}};
  }

  void act(const double*, Instant& now) const override {
    const double softer = std::max(0.2, 1.0 + fall_per_K_ * (now.rubber_degC - reference_degC_) / power_);
    now.loss_factor *= std::pow(softer, -power_);
  }

 private:
  double fall_per_K_;
  double reference_degC_ = 30.0;
  double power_ = 4.0;
};

/// Arrhenius' law with the fall of the size at the temperature where the coefficient holds.
class ArrheniusLoss : public Effect {
 public:
  ArrheniusLoss(double fall_per_K, Draws& draws) {
    const double reference_degC = draws.uniform(28.0, 42.0);
    shape = {{"reference_degC", reference_degC}};
    reference_K_ = reference_degC + kZero_K;
    activation_K_ = fall_per_K * reference_K_ * reference_K_;
  }

  void act(const double*, Instant& now) const override {
    now.loss_factor *= std::exp(activation_K_ * (1.0 / (now.rubber_degC + kZero_K) - 1.0 / reference_K_));
  }

 private:
  static constexpr double kZero_K = 273.15;

  double activation_K_ = 0.0;
  double reference_K_ = 300.0;
};

}  // namespace

extern const EffectKind kind_tire_temperature;
const EffectKind kind_tire_temperature{"tire_temperature",
                                       "1/K",
                                       "relative fall of the loss per K at the temperature where the coefficient holds",
                                       0.0,
                                       0.0,
                                       0.1,
                                       log_normal(0.008, 0.03, 0.006, 0.035),
                                       false,
                                       0.0,
                                       {{"power",
                                         "power of a linear function of the temperature instead of an exponential; "
                                         "heated by the loss, cooled by air and road with the speed",
                                         make_law<TireTemperature>},
                                        {"arrhenius",
                                         "Arrhenius' law exp(E/R (1/T - 1/T_0)) instead of an exponential; heated by "
                                         "the loss, cooled by air and road with the speed",
                                         make_law<ArrheniusLoss>}},
                                       kConstantGround,
                                       kConstantGround};

}  // namespace blind
