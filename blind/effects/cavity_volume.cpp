/// The cavity shrinks under load and grows with speed, and works on its gas.
#include <algorithm>
#include <cmath>

#include "blind/effect.h"

namespace blind {
namespace {

class CavityVolume : public Effect {
 public:
  CavityVolume(double percent, Draws& draws) : shrink_(0.01 * percent) {
    load_power_ = draws.uniform(0.9, 1.5);
    growth_ = draws.uniform(0.1, 0.5);
    shape = {{"load_power", load_power_}, {"growth_at_80_km_h_over_size", growth_}};
  }

  std::size_t state_count() const override { return 1; }

  void start(const RunStart& start, double* state) const override {
    state[0] = -shrink_ * std::pow(std::max(0.0, start.first_load_N) / kReference_N, load_power_);
  }

  void enter(const double* state, Instant& now) const override {
    now.volume_factor *= 1.0 + state[0];
    now.volume_rate_per_s += (aim(now) - state[0]) / kFollows_s;
  }

  void rates(const double* state, const Instant& now, double* rates) const override {
    rates[0] = (aim(now) - state[0]) / kFollows_s;
  }

 private:
  static constexpr double kReference_N = 5400.0;
  static constexpr double kFollows_s = 0.5;  // Assumed: about as the load settles

  double aim(const Instant& now) const {
    const double load = std::max(0.0, now.load_N) / kReference_N;
    const double x = now.speed_m_s / kSpeed80_m_s;
    return shrink_ * (growth_ * x * x - std::pow(load, load_power_));
  }

  double shrink_;
  double load_power_ = 1.0;
  double growth_ = 0.0;
};

}  // namespace

extern const EffectKind kind_cavity_volume;
const EffectKind kind_cavity_volume{"cavity_volume",
                                    "percent",
                                    "smaller volume at 5.4 kN than without load",
                                    0.0,
                                    0.0,
                                    10.0,
                                    log_normal(0.15, 1.0, 0.1, 1.4),
                                    false,
                                    0.0,
                                    "a power of the load, and growth with v^2; the change does work on the gas, which "
                                    "warms or cools by it and comes back as heat flows; filled without load",
                                    [](double size, Draws& draws, const Specimen&) -> std::unique_ptr<Effect> {
                                      return std::make_unique<CavityVolume>(size, draws);
                                    },
                                    kRigGrounds,
                                    kRigGrounds};

}  // namespace blind
