/// The surface warms under the tire: a skin at once, the body of drum or roller late.
#include <cmath>

#include "blind/effect.h"

namespace blind {
namespace {

class SurfaceWarming : public Effect {
 public:
  SurfaceWarming(double rise_dK, Draws& draws, const Specimen& specimen)
      : rise_dK_(rise_dK), reference_W_(warm_heating_W(specimen)) {
    skin_s_ = 60.0 * draws.uniform(2.0, 7.0);
    body_s_ = 60.0 * draws.from(log_normal(12.0, 45.0, 9.0, 60.0));
    skin_share_ = draws.uniform(0.1, 0.4);
    shape = {{"skin_min", skin_s_ / 60.0}, {"body_min", body_s_ / 60.0}, {"skin_share", skin_share_}};
  }

  std::size_t state_count() const override { return 2; }

  void start(const RunStart& start, double* state) const override {
    if (!start.rest_before_min.has_value()) return;
    state[0] = std::exp(-60.0 * *start.rest_before_min / skin_s_);
    state[1] = std::exp(-60.0 * *start.rest_before_min / body_s_);
  }

  void act(const double* state, Instant& now) const override {
    now.surface_rise_dK += rise_dK_ * (skin_share_ * state[0] + (1.0 - skin_share_) * state[1]);
  }

  void rates(const double* state, const Instant& now, double* rates) const override {
    const double heat = now.rolling_N * now.speed_m_s / reference_W_;
    rates[0] = (heat - state[0]) / skin_s_;
    rates[1] = (heat - state[1]) / body_s_;
  }

 private:
  double rise_dK_;
  double reference_W_;
  double skin_s_ = 1.0;
  double body_s_ = 1.0;
  double skin_share_ = 0.0;
};

}  // namespace

extern const EffectKind kind_surface_warming;
const EffectKind kind_surface_warming{
    "surface_warming",
    "K",
    "rise after long running at 80 km/h and the reference load",
    0.0,
    -30.0,
    60.0,
    log_normal(2.0, 15.0, 1.3, 20.0),
    false,
    0.0,
    "skin and body, each of first order, driven by the heat of the tire instead of speed and load",
    [](double size, Draws& draws, const Specimen& specimen) -> std::unique_ptr<Effect> {
      return std::make_unique<SurfaceWarming>(size, draws, specimen);
    },
    kRigGrounds,
    kRigGrounds};

}  // namespace blind
