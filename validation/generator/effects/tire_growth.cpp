/// Outside of the catalog: the axle is held at a height, so that a tire that grows with speed presses harder.
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::tire_growth {

void make_tire_growth(Making& of) {
  const double growth = 0.01 * of.size;
  const double power = of.draw("power", uniform(1.8, 2.3));
  of.effect.enter = [=](const double*, Instant& now) {
    // As a share of the load that is set: a tire in skim grows into the drum by the same height.
    constexpr double kSpeed120_m_s = 120.0 / 3.6;
    now.load_N += growth * now.specimen->reference_load_N * std::pow(now.speed_m_s / kSpeed120_m_s, power);
  };
}

const EffectKind kind{
    "tire_growth",
    {"percent", "further load at 120 km/h, of the reference load", 0.0, 0.0, 50.0, log_normal(2.0, 8.0, 1.5, 12.0)},
    {{"only", "load rises with about the square of the speed by the same amount at every load", make_tire_growth}},
    on_rigs,
    on_rigs,
    true};

}  // namespace rollrig::generator::tire_growth
