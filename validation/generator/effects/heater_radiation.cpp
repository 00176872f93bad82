/// Outside of the catalog: a radiant heater in the cell that a thermostat switches.
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

class HeaterRadiation : public Effect {
 public:
  using Effect::Effect;

  std::size_t state_count() const override { return 1; }
  void start(const RunStart& start, double* run) const override { run[0] = static_cast<double>(start.index); }

  void act(const double* run, Instant& now) const override {
    const double turns = now.time_s / period_s_ + phase_ + 0.37 * run[0];
    const double part = turns - std::floor(turns);
    // On and off within some ten seconds.
    const double on =
        0.5 * (std::tanh(40.0 * part) - std::tanh(40.0 * (part - duty_)) + std::tanh(40.0 * (part - 1.0)) + 1.0);
    now.tread_heat_W += power_W_ * on;
  }

 private:
  double power_W_ = size_;
  double period_s_ = note("period_s", draws_.uniform(700.0, 2500.0));
  double duty_ = note("duty", draws_.uniform(0.35, 0.65));
  double phase_ = draws_.uniform();
};

}  // namespace

const EffectKind kind_heater_radiation{
    "heater_radiation",
    {"W", "heat into the tread while on", 0.0, 0.0, 2000.0, log_normal(40.0, 200.0, 30.0, 300.0)},
    {{"only", "on and off by turns of a drawn period, whatever the tire does", make_law<HeaterRadiation>}},
    kRigGrounds,
    kRigGrounds,
    true};

}  // namespace rollrig::generator
