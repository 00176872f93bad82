/// Loss over load as a mixture of two powers.
#include <algorithm>
#include <cmath>

#include "blind/effect.h"

namespace blind {
namespace {

class LoadExponent : public Effect {
 public:
  LoadExponent(double exponent, Draws& draws) : excess_(exponent - 1.0) {
    spread_ = draws.uniform(0.2, 0.8);
    shape = {{"spread_over_excess", spread_}};
  }

  void act(const double*, Instant& now) const override {
    const double load = std::max(1.0, now.load_N) / now.specimen->reference_load_N;
    const double apart = spread_ * excess_;
    now.loss_factor *= 0.5 * (std::pow(load, excess_ + apart) + std::pow(load, excess_ - apart));
  }

 private:
  double excess_;
  double spread_ = 0.0;
};

}  // namespace

extern const EffectKind kind_load_exponent;
const EffectKind kind_load_exponent{
    "load_exponent",
    "1",
    "exponent of the loss over load at the reference load",
    1.0,
    0.3,
    2.0,
    normal(0.85, 1.15, 0.7, 1.3),
    false,
    0.02,
    "mean of two powers of the load, b + d and b - d, so that the exponent moves with load and is b at the reference",
    [](double size, Draws& draws, const Specimen&) -> std::unique_ptr<Effect> {
      return std::make_unique<LoadExponent>(size, draws);
    }};

}  // namespace blind
