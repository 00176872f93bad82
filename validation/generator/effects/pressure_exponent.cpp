/// Loss over pressure by a + b p + c/p, or by a power of the tire's stiffness, instead of a power of the pressure.
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

class PressureExponent : public Effect {
 public:
  using Effect::Effect;

  void act(const double*, Instant& now) const override {
    const double p = now.pressure_kPa / now.specimen->reference_pressure_kPa;
    now.loss_factor *= 1.0 + excess_ * (line_ * (1.0 - p) + (1.0 - line_) * (1.0 / p - 1.0));
  }

 private:
  double excess_ = size_ - specimen_.pressure_exponent;
  double line_ = note("share_of_the_line", draws_.uniform(0.0, 0.6));
};

/// Loss with a power of s + (1 - s) p/p_ref, the tire's vertical stiffness over that at the reference pressure.
class StiffnessOfPressure : public Effect {
 public:
  using Effect::Effect;

  void act(const double*, Instant& now) const override {
    const double p = now.pressure_kPa / now.specimen->reference_pressure_kPa;
    now.loss_factor *= std::pow(carcass_ + (1.0 - carcass_) * p, -power_);
  }

 private:
  double carcass_ =
      note("carcass_share", draws_.uniform(0.1, 0.4));  // Assumed: share of the stiffness without pressure
  double power_ = (size_ - specimen_.pressure_exponent) / (1.0 - carcass_);
};

}  // namespace

const EffectKind kind_pressure_exponent{
    "pressure_exponent",
    {"1", "exponent of the loss over pressure at the reference pressure", 0.4, 0.0, 2.0, normal(0.25, 0.55, 0.1, 0.7),
     false, 0.02},
    {{"regression",
      "what goes beyond the nominal exponent is a + b p + c/p, with the slope of the exponent at the reference "
      "pressure",
      make_law<PressureExponent>},
     {"stiffness",
      "a power of the tire's vertical stiffness, a carcass share beside one in proportion to the pressure, with the "
      "slope of the exponent at the reference pressure",
      make_law<StiffnessOfPressure>}}};

}  // namespace rollrig::generator
