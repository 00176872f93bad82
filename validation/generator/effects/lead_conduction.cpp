/// Outside of the catalog: the lead of the thermometer at the liner conducts heat to the rim that it is clamped to.
#include <cmath>

#include "validation/generator/effect.h"
#include "validation/generator/recorder.h"

namespace rollrig::generator::lead_conduction {

/// Reading T + k (T_rim - T), the conduction error of a probe with a lead at another temperature (ASTM MNL 12, "Manual
/// on the Use of Thermocouples in Temperature Measurement"). Assumed: how far and how fast the rim follows the tire.
void make_lead_conduction(Making& of) {
  const double conducted = 0.01 * of.size;
  const double follows = of.draw("rim_follows_share", uniform(0.15, 0.45));
  const double time_s = of.draw_min("rim_time_constant_min", uniform(10.0, 30.0));
  of.effect.trace = [=](RunRecord& record) {
    double rim_degC = 0.0;
    for (std::size_t row = 0; row < record.time_s.size(); ++row) {
      const double air_degC = record.ambient_degC[row];
      const double liner_degC = record.liner_degC[row];
      const double aim_degC = air_degC + follows * (liner_degC - air_degC);
      if (row == 0) {
        rim_degC = aim_degC;
      } else {
        rim_degC += (aim_degC - rim_degC) * -std::expm1(-(record.time_s[row] - record.time_s[row - 1]) / time_s);
      }
      record.liner_degC[row] += conducted * (rim_degC - liner_degC);
    }
  };
}

const EffectKind kind{
    "lead_conduction",
    {"percent", "of the difference between rim and liner, by which the reading is off", 0.0, 0.0, 80.0,
     log_normal(3.0, 14.0, 2.0, 20.0)},
    {{"only", "the reading lies between liner and rim; the rim follows a share of the rise of the liner, first order",
      make_lead_conduction}},
    on_rigs,
    on_rigs,
    true,
    OutsideList::kSecond};

}  // namespace rollrig::generator::lead_conduction
