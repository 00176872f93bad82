/// Outside of the catalog: a radiant heater in the cell that a thermostat switches.
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::heater_radiation {

void make_heater_radiation(Making& of) {
  const double power_W = of.size;
  const double period_s = of.draw("period_s", uniform(700.0, 2500.0));
  const double duty = of.draw("duty", uniform(0.35, 0.65));
  const double phase = of.draws.uniform();
  of.effect.state_count = 1;
  of.effect.start = [](const RunStart& start, double* run) { run[0] = static_cast<double>(start.index); };
  of.effect.act = [=](const double* run, Instant& now) {
    const double turns = now.time_s / period_s + phase + 0.37 * run[0];
    const double part = turns - std::floor(turns);
    // On and off within some ten seconds.
    const double on =
        0.5 * (std::tanh(40.0 * part) - std::tanh(40.0 * (part - duty)) + std::tanh(40.0 * (part - 1.0)) + 1.0);
    now.tread_heat_W += power_W * on;
  };
}

const EffectKind kind{
    "heater_radiation",
    {"W", "heat into the tread while on", 0.0, 0.0, 2000.0, log_normal(40.0, 200.0, 30.0, 300.0)},
    {{"only", "on and off by turns of a drawn period, whatever the tire does", make_heater_radiation}},
    on_rigs,
    on_rigs,
    true};

}  // namespace rollrig::generator::heater_radiation
