/// Heat goes from tire and gas to a rim of two parts, or of one.
#include <cmath>

#include "validation/generator/effect.h"

namespace blind {
namespace {

class RimHeat : public Effect {
 public:
  RimHeat(double tire_W_per_K, Draws& draws) : tire_W_per_K_(tire_W_per_K) {
    gas_share_ = draws.uniform(0.2, 0.7);
    capacity_J_per_K_ = draws.from(log_normal(5000.0, 9000.0, 4000.0, 11000.0));
    well_share_ = draws.uniform(0.35, 0.6);
    spokes_W_per_K_ = draws.from(log_normal(8.0, 30.0, 5.0, 50.0));
    air_W_per_K_ = draws.from(log_normal(6.0, 20.0, 4.0, 30.0));
    still_share_ = draws.uniform(0.15, 0.4);
    power_ = draws.uniform(0.5, 0.8);
    shape = {{"gas_share", gas_share_},
             {"capacity_J_per_K", capacity_J_per_K_},
             {"well_share", well_share_},
             {"spokes_W_per_K", spokes_W_per_K_},
             {"air_W_per_K_at_80_km_h", air_W_per_K_},
             {"still_share", still_share_},
             {"air_power", power_}};
  }

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
  double tire_W_per_K_;
  double gas_share_ = 0.0;
  double capacity_J_per_K_ = 1.0;
  double well_share_ = 0.5;
  double spokes_W_per_K_ = 0.0;
  double air_W_per_K_ = 0.0;
  double still_share_ = 0.0;
  double power_ = 0.0;
};

/// One node for the whole rim, cooled by s + (1 - s) v.
class OneNodeRim : public Effect {
 public:
  OneNodeRim(double tire_W_per_K, Draws& draws) : tire_W_per_K_(tire_W_per_K) {
    gas_share_ = draws.uniform(0.2, 0.7);
    capacity_J_per_K_ = draws.from(log_normal(5000.0, 9000.0, 4000.0, 11000.0));
    air_W_per_K_ = draws.from(log_normal(6.0, 20.0, 4.0, 30.0));
    still_share_ = draws.uniform(0.15, 0.5);
    shape = {{"gas_share", gas_share_},
             {"capacity_J_per_K", capacity_J_per_K_},
             {"air_W_per_K_at_80_km_h", air_W_per_K_},
             {"still_share", still_share_}};
  }

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

  double tire_W_per_K_;
  double gas_share_ = 0.0;
  double capacity_J_per_K_ = 1.0;
  double air_W_per_K_ = 0.0;
  double still_share_ = 0.0;
};

}  // namespace

extern const EffectKind kind_rim_heat;
const EffectKind kind_rim_heat{
    "rim_heat",
    "W/K",
    "conductance from gas and bead to the rim",
    0.0,
    0.0,
    50.0,
    log_normal(0.5, 4.0, 0.3, 6.5),
    false,
    0.0,
    {{"well_and_disc",
      "rim of two parts: the well takes heat from gas and bead, spokes lead it to the disc, both lose to the air with "
      "a "
      "power of the speed",
      make_law<RimHeat>},
     {"one_node",
      "rim of one node that takes heat from gas and bead and loses to the air in a straight line of the speed",
      make_law<OneNodeRim>}}};

}  // namespace blind
