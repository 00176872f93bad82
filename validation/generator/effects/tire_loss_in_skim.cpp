/// A loss of the tire that is there as soon as it touches, and hardly more at full load.
#include <algorithm>
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

class TireLossInSkim : public Effect {
 public:
  using Effect::Effect;

  void act(const double*, Instant& now) const override {
    const double stiffness = 1.0 / (1.0 + fall_per_K_ * std::max(-20.0, now.rubber_degC - 25.0));
    now.heating_force_N += force_N_ * stiffness * saturation(std::max(0.0, now.load_N)) / in_skim_;
  }

 private:
  double saturation(double load_N) const { return load_N / (load_N + half_N_); }

  double force_N_ = size_;
  double half_N_ = note("half_load_N", draws_.from(log_normal(15.0, 60.0, 8.0, 100.0)));
  double fall_per_K_ = note("fall_per_K_at_25_degC", draws_.from(log_normal(0.008, 0.03, 0.004, 0.045)));
  double in_skim_ = saturation(specimen_.skim_load_N);
};

/// F (Fz/F_skim)^m exp(-b (T - 25 degC)), which fades within some newtons of no load.
class PowerInSkim : public Effect {
 public:
  using Effect::Effect;

  void act(const double*, Instant& now) const override {
    const double load_N = std::max(1e-3, now.load_N);
    const double touching = -std::expm1(-load_N / kTouch_N);
    now.heating_force_N +=
        force_N_ * touching * std::pow(load_N / skim_N_, power_) * std::exp(-fall_per_K_ * (now.rubber_degC - 25.0));
  }

 private:
  static constexpr double kTouch_N = 15.0;  // Assumed: below it the contact is lost

  double force_N_ = size_;
  double power_ = note("load_power", draws_.uniform(-0.15, 0.15));
  double fall_per_K_ = note("fall_per_K", draws_.from(log_normal(0.008, 0.03, 0.004, 0.045)));
  double skim_N_ = specimen_.skim_load_N;
};

}  // namespace

const EffectKind kind_tire_loss_in_skim{
    "tire_loss_in_skim",
    {"N", "further loss of the tire at the skim load and 25 degC", 0.0, 0.0, 50.0, log_normal(0.3, 3.0, 0.15, 5.0)},
    {{"hyperbola",
      "Fz/(Fz + F_half) over its value in skim, so that it saturates with load; falls as 1/(1 + b (T - 25 degC)); "
      "heats the rubber",
      make_law<TireLossInSkim>},
     {"power",
      "a power of the load over that in skim, gone without load; falls exponentially from 25 degC on; heats the rubber",
      make_law<PowerInSkim>}},
    kDrumGround,
    kDrumGround};

}  // namespace rollrig::generator
