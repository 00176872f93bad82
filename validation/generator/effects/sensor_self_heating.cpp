/// Outside of the catalog: the thermometer at the liner warms itself once it is switched on.
#include <cmath>

#include "validation/generator/effect.h"
#include "validation/generator/recorder.h"

namespace rollrig::generator::sensor_self_heating {

void make_sensor_self_heating(Making& of) {
  const double rise_dK = of.size;
  const double time_s = of.draw_min("time_constant_min", uniform(3.0, 15.0));
  const double swept = of.draw("swept_share_at_80_km_h", uniform(0.2, 0.6));
  of.effect.trace = [=](RunRecord& record) {
    double rise = 0.0;
    for (std::size_t row = 0; row < record.time_s.size(); ++row) {
      const double x = record.speed_km_h[row] / 80.0;
      const double aim = 1.0 / (1.0 + swept / (1.0 - swept) * std::sqrt(x));
      if (row > 0) rise += (aim - rise) * -std::expm1(-(record.time_s[row] - record.time_s[row - 1]) / time_s);
      record.liner_degC[row] += rise_dK * rise;
    }
  };
}

const EffectKind kind{
    "sensor_self_heating",
    {"K", "excess of the reading at standstill", 0.0, 0.0, 50.0, log_normal(1.5, 6.0, 1.0, 9.0)},
    {{"only", "first order from the start of each run, less in moving gas", make_sensor_self_heating}},
    on_rigs,
    on_rigs,
    true};

}  // namespace rollrig::generator::sensor_self_heating
