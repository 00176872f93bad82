/// Outside of the catalog: the traction force is reckoned from electric power that heats or cools the cabin as well.
#include <algorithm>
#include <cmath>

#include "validation/generator/effect.h"
#include "validation/generator/recorder.h"

namespace rollrig::generator::cabin_power {

/// P/v too much, P high until the cabin has its temperature, and in proportion to how far the air is from 20 degC.
/// Assumed: the share that holds the temperature, the time that reaches it, a least need of a fifth.
void make_cabin_power(Making& of) {
  constexpr double kComfort_degC = 20.0;
  constexpr double kFar_dK = 15.0;
  constexpr double kSlowest_m_s = 3.0;  // below it the column of the force is empty
  const double power_W = of.size;
  const double holds = of.draw("share_that_holds", uniform(0.25, 0.6));
  const double time_s = of.draw_min("time_constant_min", uniform(4.0, 12.0));
  trace_rows(of, [=](RunRecord& record, std::size_t row) {
    const double apart = std::abs(record.ambient_degC[row] - kComfort_degC) / kFar_dK;
    const double need = std::clamp(apart, 0.2, 1.5) * (holds + (1.0 - holds) * std::exp(-record.time_s[row] / time_s));
    record.force[row] += record.lever * power_W * need / std::max(kSlowest_m_s, record.speed_km_h[row] / 3.6);
  });
}

const EffectKind kind{
    "cabin_power",
    {"W", "power at the start of a trip with air 15 K from 20 degC", 0.0, 0.0, 20000.0,
     log_normal(1000.0, 4500.0, 800.0, 6000.0)},
    {{"only", "a power over the speed, more in cold and hot air, falling over the first minutes of each trip",
      make_cabin_power}},
    on_roads,
    on_roads,
    true,
    OutsideList::kSecond};

}  // namespace rollrig::generator::cabin_power
