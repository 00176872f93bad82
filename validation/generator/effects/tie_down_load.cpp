/// Straps press the wheels onto the rollers: they creep and are tightened by the pull, or they relax.
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

class TieDownLoad : public Effect {
 public:
  using Effect::Effect;

  void enter(const double*, Instant& now) const override {
    const double slack = creep_ * std::log10(1.0 + now.time_s / 60.0);
    const double pull_N = pull_ * load_N_ / 200.0 * std::abs(now.longitudinal_N);
    now.load_N += load_N_ * (1.0 - slack) + pull_N;
  }

 private:
  double load_N_ = size_;
  double creep_ = note("creep_a_decade", draws_.uniform(0.0, 0.08));
  double pull_ = note("N_per_N_of_pull_at_200_N", draws_.uniform(0.0, 0.08));
};

/// Load L (1 - r (1 - exp(-t/tau))) from tying down at the start of a run on.
class RelaxingStraps : public Effect {
 public:
  using Effect::Effect;

  void enter(const double*, Instant& now) const override {
    now.load_N += load_N_ * (1.0 + relaxing_ * std::expm1(-now.time_s / time_s_));
  }

 private:
  double load_N_ = size_;
  double relaxing_ = note("relaxing_share", draws_.uniform(0.0, 0.25));
  double time_s_ = note_min("time_constant_min", 60.0 * draws_.uniform(5.0, 30.0));
};

}  // namespace

const EffectKind kind_tie_down_load{
    "tie_down_load",
    {"N", "further load of one wheel, just tied down", 0.0, -500.0, 3000.0, log_normal(50.0, 400.0, 30.0, 600.0)},
    {{"creeping", "falls with the logarithm of time as straps creep, rises with the pull of the wheel",
      make_law<TieDownLoad>},
     {"relaxing", "straps of a spring and a damper relax to a lower load over minutes, whatever the wheel does",
      make_law<RelaxingStraps>}},
    kDynoGround,
    kDynoGround};

}  // namespace rollrig::generator
