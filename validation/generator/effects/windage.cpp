/// Air that the turning tire and its wheel drag along and pump.
#include <cmath>

#include "sim/core/units.h"
#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

class Windage : public Effect {
 public:
  using Effect::Effect;

  void act(const double*, Instant& now) const override {
    const double x = now.speed_m_s / kSpeed80_m_s;
    const double density = 298.15 / (now.ambient_degC + kZeroCelsius_K);
    const double rubbed = std::pow(density, 0.8) * std::pow(x, 1.8);
    now.rig_force_N += force_N_ * ((1.0 - pumped_share_) * rubbed + pumped_share_ * density * x * x * (0.8 + 0.2 * x));
  }

 private:
  double force_N_ = size_;
  double pumped_share_ = note("pumped_share", draws_.uniform(0.1, 0.9));
};

/// F (v/v80)^n.
class PowerOfSpeed : public Effect {
 public:
  using Effect::Effect;

  void act(const double*, Instant& now) const override {
    now.rig_force_N += force_N_ * std::pow(now.speed_m_s / kSpeed80_m_s, power_);
  }

 private:
  double force_N_ = size_;
  double power_ = note("speed_power", draws_.uniform(1.8, 2.2));
};

}  // namespace

const EffectKind kind_windage{
    "windage",
    {"N", "force at 80 km/h, of one wheel", 0.0, 0.0, 50.0, log_normal(0.3, 3.0, 0.15, 5.0)},
    {{"disc_and_pump",
      "friction of a turning disc in turbulent air, v^(9/5), and air pumped by spokes and lugs, between v^2 and v^3, "
      "both with the density of the air; no heat",
      make_law<Windage>},
     {"power", "a power of the speed, 1.8 to 2.2, in air of one density; no heat", make_law<PowerOfSpeed>}}};

}  // namespace rollrig::generator
