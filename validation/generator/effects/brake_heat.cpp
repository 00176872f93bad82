/// Heat of the brakes goes to bead and gas: through a disc that the air cools and a rim, or as a share, late.
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

class BrakeHeat : public Effect {
 public:
  using Effect::Effect;

  std::size_t state_count() const override { return 2; }

  void act(const double* state, Instant& now) const override {
    const double to_tire_W = state[1] / rim_s_;
    now.liner_heat_W += (1.0 - gas_share_) * to_tire_W;
    now.gas_heat_W += gas_share_ * to_tire_W;
  }

  void rates(const double* state, const Instant& now, double* rates) const override {
    const double led_W = lead_W_per_K_ * state[0];
    rates[0] = (now.brake_N * now.speed_m_s - led_W - air_W_per_K(now.speed_m_s) * state[0]) / disc_J_per_K_;
    rates[1] = passed_ * led_W - state[1] / rim_s_;
  }

 private:
  static constexpr double kTown_m_s = 40.0 / 3.6;
  static double air_W_per_K(double speed_m_s) { return 4.0 + 14.0 * std::pow(speed_m_s / kSpeed80_m_s, 0.7); }

  double disc_J_per_K_ = note("disc_J_per_K", draws_.uniform(3000.0, 6000.0));
  double lead_W_per_K_ = note("disc_to_rim_W_per_K", draws_.uniform(6.0, 14.0));
  double rim_s_ = 60.0 * note("rim_min", draws_.from(log_normal(3.0, 30.0, 2.5, 30.0)));
  double gas_share_ = note("gas_share", draws_.uniform(0.1, 0.5));
  double passed_ = 0.01 * size_ * (lead_W_per_K_ + air_W_per_K(kTown_m_s)) / lead_W_per_K_;
};

/// A share of the brake's power, delayed by the rim alone.
class ShareOfBrake : public Effect {
 public:
  using Effect::Effect;

  std::size_t state_count() const override { return 1; }

  void act(const double* bound_J, Instant& now) const override {
    const double to_tire_W = bound_J[0] / delay_s_;
    now.liner_heat_W += (1.0 - gas_share_) * to_tire_W;
    now.gas_heat_W += gas_share_ * to_tire_W;
  }

  void rates(const double* bound_J, const Instant& now, double* rates) const override {
    rates[0] = share_ * now.brake_N * now.speed_m_s - bound_J[0] / delay_s_;
  }

 private:
  double share_ = 0.01 * size_;
  double delay_s_ = 60.0 * note("delay_min", draws_.from(log_normal(3.0, 30.0, 2.5, 30.0)));
  double gas_share_ = note("gas_share", draws_.uniform(0.1, 0.5));
};

}  // namespace

const EffectKind kind_brake_heat{
    "brake_heat",
    {"percent", "share of the brake power that reaches the tire in town, where the disc is cooled at 40 km/h", 0.0, 0.0,
     100.0, log_normal(2.0, 15.0, 1.5, 20.0)},
    {{"disc_and_rim",
      "excess heat in a disc that loses to the air faster with speed, led to a rim and from there to bead and gas",
      make_law<BrakeHeat>},
     {"share", "a fixed share of the brake's power, late by one first-order delay, whatever the speed",
      make_law<ShareOfBrake>}},
    kVehicleGrounds,
    kDynoGround};

}  // namespace rollrig::generator
