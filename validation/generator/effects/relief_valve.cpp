/// Outside of the catalog: a relief valve at the pressure hose vents what a warm tire has above its setting.
#include <algorithm>

#include "sim/core/units.h"
#include "validation/generator/effect.h"

namespace rollrig::generator::relief_valve {

/// Flow in proportion to the pressure above the setting (a valve with a linear spring); n falls as p does at constant
/// temperature. What is vented does not come back as the tire cools. Assumed: the setting above the cold pressure.
void make_relief_valve(Making& of) {
  constexpr double kExcess_kPa = 10.0;
  const double per_s = of.size / 3600.0;
  const double above_cold_kPa = of.draw("opens_above_cold_kPa", uniform(3.0, 12.0));
  of.effect.state_count = 1;
  of.effect.start = [=](const RunStart& start, double* setting_kPa) {
    setting_kPa[0] = start.cold_pressure_kPa + above_cold_kPa;
  };
  of.effect.act = [=](const double* setting_kPa, Instant& now) {
    const double excess = std::max(0.0, now.pressure_kPa - setting_kPa[0]) / kExcess_kPa;
    now.leak_mol_s += per_s * excess * now.gas_mol / (now.pressure_kPa + 1e-3 * kStandardAtmosphere_Pa);
  };
}

const EffectKind kind{
    "relief_valve",
    {"kPa/h", "fall of the pressure at 10 kPa above the setting", 0.0, 0.0, 200.0, log_normal(0.5, 4.0, 0.3, 6.0)},
    {{"only", "tight up to some kPa above the cold pressure of the run, above it a flow in proportion to the excess",
      make_relief_valve}},
    on_carriages,
    on_carriages,
    true,
    OutsideList::kSecond};

}  // namespace rollrig::generator::relief_valve
