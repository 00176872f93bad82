/// Loss over pressure by a + b p + c/p instead of a power.
#include "blind/effect.h"

namespace blind {
namespace {

class PressureExponent : public Effect {
 public:
  PressureExponent(double exponent, Draws& draws, const Specimen& specimen)
      : excess_(exponent - specimen.pressure_exponent) {
    line_ = draws.uniform(0.0, 0.6);
    shape = {{"share_of_the_line", line_}};
  }

  void act(const double*, Instant& now) const override {
    const double p = now.pressure_kPa / now.specimen->reference_pressure_kPa;
    now.loss_factor *= 1.0 + excess_ * (line_ * (1.0 - p) + (1.0 - line_) * (1.0 / p - 1.0));
  }

 private:
  double excess_;
  double line_ = 0.0;
};

}  // namespace

extern const EffectKind kind_pressure_exponent;
const EffectKind kind_pressure_exponent{
    "pressure_exponent",
    "1",
    "exponent of the loss over pressure at the reference pressure",
    0.4,
    0.0,
    2.0,
    normal(0.25, 0.55, 0.1, 0.7),
    false,
    0.02,
    "what goes beyond the nominal exponent is a + b p + c/p, with the slope of the exponent at the reference pressure",
    [](double size, Draws& draws, const Specimen& specimen) -> std::unique_ptr<Effect> {
      return std::make_unique<PressureExponent>(size, draws, specimen);
    }};

}  // namespace blind
