/// Straps press the wheels onto the rollers: they creep and are tightened by the pull, or they relax.
#include <cmath>

#include "validation/generator/effect.h"

namespace blind {
namespace {

class TieDownLoad : public Effect {
 public:
  TieDownLoad(double load_N, Draws& draws) : load_N_(load_N) {
    creep_ = draws.uniform(0.0, 0.08);
    pull_ = draws.uniform(0.0, 0.08);
    shape = {{"creep_a_decade", creep_}, {"N_per_N_of_pull_at_200_N", pull_}};
  }

  void enter(const double*, Instant& now) const override {
    const double slack = creep_ * std::log10(1.0 + now.time_s / 60.0);
    const double pull_N = pull_ * load_N_ / 200.0 * std::abs(now.longitudinal_N);
    now.load_N += load_N_ * (1.0 - slack) + pull_N;
  }

 private:
  double load_N_;
  double creep_ = 0.0;
  double pull_ = 0.0;
};

/// Load L (1 - r (1 - exp(-t/tau))) from tying down at the start of a run on.
class RelaxingStraps : public Effect {
 public:
  RelaxingStraps(double load_N, Draws& draws) : load_N_(load_N) {
    relaxing_ = draws.uniform(0.0, 0.25);
    time_s_ = 60.0 * draws.uniform(5.0, 30.0);
    shape = {{"relaxing_share", relaxing_}, {"time_constant_min", time_s_ / 60.0}};
  }

  void enter(const double*, Instant& now) const override {
    now.load_N += load_N_ * (1.0 + relaxing_ * std::expm1(-now.time_s / time_s_));
  }

 private:
  double load_N_;
  double relaxing_ = 0.0;
  double time_s_ = 1.0;
};

}  // namespace

extern const EffectKind kind_tie_down_load;
const EffectKind kind_tie_down_load{
    "tie_down_load",
    "N",
    "further load of one wheel, just tied down",
    0.0,
    -500.0,
    3000.0,
    log_normal(50.0, 400.0, 30.0, 600.0),
    false,
    0.0,
    {{"creeping", "falls with the logarithm of time as straps creep, rises with the pull of the wheel",
      make_law<TieDownLoad>},
     {"relaxing", "straps of a spring and a damper relax to a lower load over minutes, whatever the wheel does",
      make_law<RelaxingStraps>}},
    kDynoGround,
    kDynoGround};

}  // namespace blind
