/// The air of the cell warms by what tire and rig give off: with walls that follow late, or with a draught.
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

class CellAirWarming : public Effect {
 public:
  using Effect::Effect;

  std::size_t state_count() const override { return 2; }

  void start(const RunStart& start, double* state) const override {
    state[0] = start.left_after_rest(air_s_);
    state[1] = start.left_after_rest(walls_s_);
  }

  void enter(const double* state, Instant& now) const override {
    now.ambient_degC += rise_dK_ * ((1.0 - walls_share_) * state[0] + walls_share_ * state[1]);
  }

  void rates(const double* state, const Instant& now, double* rates) const override {
    const double heat = now.rolling_N * now.speed_m_s / reference_W_;
    rates[0] = (heat - state[0]) / air_s_;
    rates[1] = (heat - state[1]) / walls_s_;
  }

 private:
  double rise_dK_ = size_;
  double reference_W_ = warm_heating_W(specimen_);
  double air_s_ = note_min("air_min", 60.0 * draws_.from(log_normal(12.0, 40.0, 8.0, 60.0)));
  double walls_s_ = note_min("walls_min", air_s_* draws_.uniform(2.5, 5.0));
  double walls_share_ = note("walls_share", draws_.uniform(0.2, 0.6));
};

/// A cell that its own draught cools, in proportion to the root of the rise: theta' = (q - theta^(3/2))/tau.
class VentilatedCell : public Effect {
 public:
  using Effect::Effect;

  std::size_t state_count() const override { return 1; }

  void start(const RunStart& start, double* rise) const override {
    if (!start.rest_before_min.has_value()) return;
    // theta' = -theta^(3/2)/tau from 1 on.
    rise[0] = std::pow(1.0 + 0.5 * 60.0 * *start.rest_before_min / time_s_, -2.0);
  }

  void enter(const double* rise, Instant& now) const override { now.ambient_degC += rise_dK_ * rise[0]; }

  void rates(const double* rise, const Instant& now, double* rates) const override {
    const double heat = now.rolling_N * now.speed_m_s / reference_W_;
    rates[0] = (heat - rise[0] * std::sqrt(std::abs(rise[0]))) / time_s_;
  }

 private:
  double rise_dK_ = size_;
  double reference_W_ = warm_heating_W(specimen_);
  // So that air_min is the time constant about the steady rise.
  double time_s_ = 1.5 * 60.0 * note("air_min", draws_.from(log_normal(20.0, 80.0, 12.0, 120.0)));
};

}  // namespace

const EffectKind kind_cell_air_warming{
    "cell_air_warming",
    {"K", "rise after long running at 80 km/h and the reference load", 0.0, -20.0, 20.0,
     log_normal(1.0, 6.0, 0.7, 8.0)},
    {{"air_and_walls",
      "air and walls, each of first order, driven by the heat of the tire; rests cool them; the record shows neither",
      make_law<CellAirWarming>},
     {"ventilated",
      "one volume of air by the heat of the tire, with draught in proportion to the root of the rise: steady rise with "
      "heat^(2/3); rests cool it",
      make_law<VentilatedCell>}}};

}  // namespace rollrig::generator
