/// Heat goes from tire and gas to a rim of two parts, or of one.
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

class RimHeat : public Effect {
 public:
  using Effect::Effect;

  std::size_t state_count() const override { return 2; }

  void start(const RunStart& start, double* rim_degC) const override { rim_degC[0] = rim_degC[1] = start.initial_degC; }

  void act(const double* rim_degC, Instant& now) const override {
    now.gas_heat_W -= gas_share_ * tire_W_per_K_ * (now.gas_degC - rim_degC[0]);
    now.liner_heat_W -= (1.0 - gas_share_) * tire_W_per_K_ * (now.liner_degC - rim_degC[0]);
  }

  void rates(const double* rim_degC, const Instant& now, double* rates) const override {
    const double from_tire_W = gas_share_ * tire_W_per_K_ * (now.gas_degC - rim_degC[0]) +
                               (1.0 - gas_share_) * tire_W_per_K_ * (now.liner_degC - rim_degC[0]);
    const double air_W_per_K =
        air_W_per_K_ * (still_share_ + (1.0 - still_share_) * std::pow(now.speed_m_s / kSpeed80_m_s, power_));
    const double spokes_W = spokes_W_per_K_ * (rim_degC[0] - rim_degC[1]);
    const double well_W = 0.4 * air_W_per_K * (rim_degC[0] - now.ambient_degC);  // Assumed: the disc has more area
    const double disc_W = 0.6 * air_W_per_K * (rim_degC[1] - now.ambient_degC);
    rates[0] = (from_tire_W - spokes_W - well_W) / (well_share_ * capacity_J_per_K_);
    rates[1] = (spokes_W - disc_W) / ((1.0 - well_share_) * capacity_J_per_K_);
  }

 private:
  double tire_W_per_K_ = size_;
  double gas_share_ = note("gas_share", draws_.uniform(0.2, 0.7));
  double capacity_J_per_K_ = note("capacity_J_per_K", draws_.from(log_normal(5000.0, 9000.0, 4000.0, 11000.0)));
  double well_share_ = note("well_share", draws_.uniform(0.35, 0.6));
  double spokes_W_per_K_ = note("spokes_W_per_K", draws_.from(log_normal(8.0, 30.0, 5.0, 50.0)));
  double air_W_per_K_ = note("air_W_per_K_at_80_km_h", draws_.from(log_normal(6.0, 20.0, 4.0, 30.0)));
  double still_share_ = note("still_share", draws_.uniform(0.15, 0.4));
  double power_ = note("air_power", draws_.uniform(0.5, 0.8));
};

/// One node for the whole rim, cooled by s + (1 - s) v.
class OneNodeRim : public Effect {
 public:
  using Effect::Effect;

  std::size_t state_count() const override { return 1; }

  void start(const RunStart& start, double* rim_degC) const override { rim_degC[0] = start.initial_degC; }

  void act(const double* rim_degC, Instant& now) const override {
    now.gas_heat_W -= from_gas_W(rim_degC, now);
    now.liner_heat_W -= from_bead_W(rim_degC, now);
  }

  void rates(const double* rim_degC, const Instant& now, double* rates) const override {
    const double air_W_per_K = air_W_per_K_ * (still_share_ + (1.0 - still_share_) * now.speed_m_s / kSpeed80_m_s);
    const double taken_W = from_gas_W(rim_degC, now) + from_bead_W(rim_degC, now);
    rates[0] = (taken_W - air_W_per_K * (rim_degC[0] - now.ambient_degC)) / capacity_J_per_K_;
  }

 private:
  double from_gas_W(const double* rim_degC, const Instant& now) const {
    return gas_share_ * tire_W_per_K_ * (now.gas_degC - rim_degC[0]);
  }
  double from_bead_W(const double* rim_degC, const Instant& now) const {
    return (1.0 - gas_share_) * tire_W_per_K_ * (now.liner_degC - rim_degC[0]);
  }

  double tire_W_per_K_ = size_;
  double gas_share_ = note("gas_share", draws_.uniform(0.2, 0.7));
  double capacity_J_per_K_ = note("capacity_J_per_K", draws_.from(log_normal(5000.0, 9000.0, 4000.0, 11000.0)));
  double air_W_per_K_ = note("air_W_per_K_at_80_km_h", draws_.from(log_normal(6.0, 20.0, 4.0, 30.0)));
  double still_share_ = note("still_share", draws_.uniform(0.15, 0.5));
};

}  // namespace

const EffectKind kind_rim_heat{
    "rim_heat",
    {"W/K", "conductance from gas and bead to the rim", 0.0, 0.0, 50.0, log_normal(0.5, 4.0, 0.3, 6.5)},
    {{"well_and_disc",
      "rim of two parts: the well takes heat from gas and bead, spokes lead it to the disc, both lose to the air with "
      "a power of the speed",
      make_law<RimHeat>},
     {"one_node",
      "rim of one node that takes heat from gas and bead and loses to the air in a straight line of the speed",
      make_law<OneNodeRim>}}};

}  // namespace rollrig::generator
