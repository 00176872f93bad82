/// Pads that keep rubbing after braking, until the disc has pushed them back or has cooled.

#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

class BrakeDrag : public Effect {
 public:
  explicit BrakeDrag(const Making& of) : Effect(of), force_N_(of.size) {
    push_back_m_ = 1e3 * of.draws.from(log_normal(0.4, 4.0, 0.3, 6.0));
    set_s_ = of.draws.uniform(2.0, 6.0);
    half_N_ = of.draws.from(log_normal(50.0, 300.0, 30.0, 400.0));
    shape = {{"push_back_km", 1e-3 * push_back_m_}, {"set_time_s", set_s_}, {"half_force_N", half_N_}};
  }

  std::size_t state_count() const override { return 1; }

  void act(const double* rubbing, Instant& now) const override { now.rig_force_N += force_N_ * rubbing[0]; }

  void rates(const double* rubbing, const Instant& now, double* rates) const override {
    const double squared = now.brake_N * now.brake_N;
    const double pressed = squared / (squared + half_N_ * half_N_);
    rates[0] = (1.0 - rubbing[0]) * pressed / set_s_ - rubbing[0] * now.speed_m_s / push_back_m_;
  }

 private:
  double force_N_;
  double push_back_m_ = 1.0;
  double set_s_ = 1.0;
  double half_N_ = 1.0;
};

/// A disc that swells by the energy of brakings and shrinks as it cools: r' = (1 - r) P/E - r/tau.
class HotDisc : public Effect {
 public:
  using Effect::Effect;

  std::size_t state_count() const override { return 1; }

  void act(const double* rubbing, Instant& now) const override { now.rig_force_N += force_N_ * rubbing[0]; }

  void rates(const double* rubbing, const Instant& now, double* rates) const override {
    rates[0] = (1.0 - rubbing[0]) * now.brake_N * now.speed_m_s / full_J_ - rubbing[0] / cooling_s_;
  }

 private:
  double force_N_ = size_;
  // Assumed: a braking from 50 km/h is 30 to 70 kJ a wheel
  double full_J_ = note("full_J", draws_.from(log_normal(4e3, 15e3, 3e3, 20e3)));
  double cooling_s_ = note("cooling_s", draws_.from(log_normal(40.0, 300.0, 30.0, 450.0)));
};

}  // namespace

const EffectKind kind_brake_drag{
    "brake_drag",
    {"N", "drag of one wheel right after strong braking", 0.0, 0.0, 100.0, log_normal(2.0, 12.0, 1.2, 18.0)},
    {{"worn_off", "set by brakings with the square of their force, worn off over distance instead of time",
      make_law<BrakeDrag>},
     {"hot_disc", "pads rub as long as the disc is hot: set by the energy of brakings, gone with time",
      make_law<HotDisc>}},
    kVehicleGrounds,
    kVehicleGrounds};

}  // namespace rollrig::generator
