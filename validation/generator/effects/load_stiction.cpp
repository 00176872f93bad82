/// Outside of the catalog: the load cylinder sticks short of where it is sent.
#include <algorithm>
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

class LoadStiction : public Effect {
 public:
  using Effect::Effect;

  std::size_t state_count() const override { return 1; }

  void start(const RunStart& start, double* piston_N) const override { piston_N[0] = start.first_load_N - band_N_; }

  void enter(const double* piston_N, Instant& now) const override {
    now.load_N += std::clamp(piston_N[0] - now.target_load_N, -band_N_, band_N_);
  }

  void rates(const double* piston_N, const Instant& now, double* rates) const override {
    const double apart_N = now.target_load_N - piston_N[0];
    const double beyond_N = std::max(0.0, std::abs(apart_N) - band_N_);
    rates[0] = std::copysign(beyond_N, apart_N) / follows_s_;
  }

 private:
  double band_N_ = size_;
  double follows_s_ = note("follows_s", draws_.uniform(0.5, 2.0));
};

}  // namespace

const EffectKind kind_load_stiction{
    "load_stiction",
    {"N", "half of the width of the hysteresis", 0.0, 0.0, 1000.0, log_normal(50.0, 160.0, 40.0, 180.0)},
    {{"only", "play: the load stays short by the size after a rise and above by it after a fall",
      make_law<LoadStiction>}},
    kDrumGround,
    kDrumGround,
    true};

}  // namespace rollrig::generator
