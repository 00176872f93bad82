/// The air of the cell warms by what tire and rig give off, with walls that follow late.
#include <cmath>

#include "blind/effect.h"

namespace blind {
namespace {

class CellAirWarming : public Effect {
 public:
  CellAirWarming(double rise_dK, Draws& draws, const Specimen& specimen)
      : rise_dK_(rise_dK), reference_W_(warm_heating_W(specimen)) {
    air_s_ = 60.0 * draws.from(log_normal(12.0, 40.0, 8.0, 60.0));
    walls_s_ = air_s_ * draws.uniform(2.5, 5.0);
    walls_share_ = draws.uniform(0.2, 0.6);
    shape = {{"air_min", air_s_ / 60.0}, {"walls_min", walls_s_ / 60.0}, {"walls_share", walls_share_}};
  }

  std::size_t state_count() const override { return 2; }

  void start(const RunStart& start, double* state) const override {
    if (!start.rest_before_min.has_value()) return;
    state[0] = std::exp(-60.0 * *start.rest_before_min / air_s_);
    state[1] = std::exp(-60.0 * *start.rest_before_min / walls_s_);
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
  double rise_dK_;
  double reference_W_;
  double air_s_ = 1.0;
  double walls_s_ = 1.0;
  double walls_share_ = 0.0;
};

}  // namespace

extern const EffectKind kind_cell_air_warming;
const EffectKind kind_cell_air_warming{
    "cell_air_warming",
    "K",
    "rise after long running at 80 km/h and the reference load",
    0.0,
    -20.0,
    20.0,
    log_normal(1.0, 6.0, 0.7, 8.0),
    false,
    0.0,
    "air and walls, each of first order, driven by the heat of the tire; rests cool them; the record shows neither",
    [](double size, Draws& draws, const Specimen& specimen) -> std::unique_ptr<Effect> {
      return std::make_unique<CellAirWarming>(size, draws, specimen);
    },
    kRigGrounds,
    kRigGrounds};

}  // namespace blind
