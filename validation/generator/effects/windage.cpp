/// Air that the turning tire and its wheel drag along and pump.
#include <algorithm>
#include <cmath>

#include "validation/generator/effect.h"

namespace blind {
namespace {

class Windage : public Effect {
 public:
  Windage(double force_N, Draws& draws) : force_N_(force_N) {
    pumped_share_ = draws.uniform(0.1, 0.9);
    shape = {{"pumped_share", pumped_share_}};
  }

  void act(const double*, Instant& now) const override {
    const double x = now.speed_m_s / kSpeed80_m_s;
    const double density = 298.15 / (now.ambient_degC + 273.15);
    const double rubbed = std::pow(density, 0.8) * std::pow(x, 1.8);
    now.rig_force_N += force_N_ * ((1.0 - pumped_share_) * rubbed + pumped_share_ * density * x * x * (0.8 + 0.2 * x));
  }

 private:
  double force_N_;
  double pumped_share_ = 0.0;
};

/// F (v/v80)^n.
class PowerOfSpeed : public Effect {
 public:
  PowerOfSpeed(double force_N, Draws& draws) : force_N_(force_N) {
    power_ = draws.uniform(1.8, 2.2);
    shape = {{"speed_power", power_}};
  }

  void act(const double*, Instant& now) const override {
    now.rig_force_N += force_N_ * std::pow(now.speed_m_s / kSpeed80_m_s, power_);
  }

 private:
  double force_N_;
  double power_ = 2.0;
};

}  // namespace

extern const EffectKind kind_windage;
const EffectKind kind_windage{
    "windage",
    "N",
    "force at 80 km/h, of one wheel",
    0.0,
    0.0,
    50.0,
    log_normal(0.3, 3.0, 0.15, 5.0),
    false,
    0.0,
    {{"disc_and_pump",
      "friction of a turning disc in turbulent air, v^(9/5), and air pumped by spokes and "
      "lugs, between v^2 and v^3, both with the density of the air; no heat",
      make_law<Windage>},
     {"power", "a power of the speed, 1.8 to 2.2, in air of one density; no heat", make_law<PowerOfSpeed>}},
    kRigGrounds,
    kRigGrounds};

}  // namespace blind
