/// The surface warms under the tire: skin and body, or one body that is cooled faster with speed.
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

class SurfaceWarming : public Effect {
 public:
  using Effect::Effect;

  std::size_t state_count() const override { return 2; }

  void start(const RunStart& start, double* state) const override {
    state[0] = start.left_after_rest(skin_s_);
    state[1] = start.left_after_rest(body_s_);
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
  double rise_dK_ = size_;
  double reference_W_ = warm_heating_W(specimen_);
  double skin_s_ = note_min("skin_min", 60.0 * draws_.uniform(2.0, 7.0));
  double body_s_ = note_min("body_min", 60.0 * draws_.from(log_normal(12.0, 45.0, 9.0, 60.0)));
  double skin_share_ = note("skin_share", draws_.uniform(0.1, 0.4));
};

/// One body, theta' = (q - (s + (1 - s) x^0.8) theta)/tau, x = v/(80 km/h).
class CooledBody : public Effect {
 public:
  using Effect::Effect;

  std::size_t state_count() const override { return 1; }

  void start(const RunStart& start, double* rise) const override {
    rise[0] = start.left_after_rest(time_s_, still_share_);
  }

  void act(const double* rise, Instant& now) const override { now.surface_rise_dK += rise_dK_ * rise[0]; }

  void rates(const double* rise, const Instant& now, double* rates) const override {
    const double heat = now.rolling_N * now.speed_m_s / reference_W_;
    const double cooling = still_share_ + (1.0 - still_share_) * std::pow(now.speed_m_s / kSpeed80_m_s, 0.8);
    rates[0] = (heat - cooling * rise[0]) / time_s_;
  }

 private:
  double rise_dK_ = size_;
  double reference_W_ = warm_heating_W(specimen_);
  double time_s_ = note_min("time_constant_min", 60.0 * draws_.from(log_normal(10.0, 40.0, 8.0, 55.0)));
  double still_share_ = note("still_share", draws_.uniform(0.2, 0.7));
};

}  // namespace

const EffectKind kind_surface_warming{
    "surface_warming",
    {"K", "rise after long running at 80 km/h and the reference load", 0.0, -30.0, 60.0,
     log_normal(2.0, 15.0, 1.3, 20.0)},
    {{"skin_and_body", "skin and body, each of first order, driven by the heat of the tire instead of speed and load",
      make_law<SurfaceWarming>},
     {"cooled_body", "one body, driven by the heat of the tire, that the air cools faster with speed",
      make_law<CooledBody>}}};

}  // namespace rollrig::generator
