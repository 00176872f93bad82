/// Air cools the tire by another law of speed.
#include <cmath>

#include "blind/effect.h"

namespace blind {
namespace {

class ConvectionLaw : public Effect {
 public:
  ConvectionLaw(double exponent, Draws& draws) : exponent_(exponent) {
    with_fan_ = draws.happens(0.5);
    shape = {{"with_fan", with_fan_ ? 1.0 : 0.0}};
  }

  void act(const double*, Instant& now) const override {
    const double x = now.air_speed_m_s / kSpeed80_m_s;
    double effective = 0.0;
    if (with_fan_) {  // speeds of fan and roller add by their squares; the file's f holds at 80 km/h
      effective = std::sqrt(exponent_ * x * x + 1.0 - exponent_);
    } else {  // laminar and turbulent parts of the boundary layer
      effective = (2.0 * exponent_ - 1.0) * x + 2.0 * (1.0 - exponent_) * std::sqrt(x);
    }
    now.air_speed_m_s = kSpeed80_m_s * effective;
  }

 private:
  double exponent_;
  bool with_fan_ = false;
};

}  // namespace

extern const EffectKind kind_convection_law;
const EffectKind kind_convection_law{
    "convection_law",
    "1",
    "exponent of the speed-dependent cooling over speed at 80 km/h",
    1.0,
    0.5,
    1.0,
    normal(0.6, 1.0, 0.52, 0.96),
    false,
    0.0,
    "either a part with sqrt(v) beside one with v, or a fan whose air speed adds by squares; f holds at 80 km/h",
    [](double size, Draws& draws, const Specimen&) -> std::unique_ptr<Effect> {
      return std::make_unique<ConvectionLaw>(size, draws);
    },
    kEveryGround,
    kRigGrounds};

}  // namespace blind
