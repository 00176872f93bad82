/// Outside of the catalog: torque ripple once a turn of drum or roller, sampled once a second without a filter.
#include <cmath>

#include "validation/generator/effect.h"
#include "validation/generator/recorder.h"

namespace rollrig::generator::ripple_aliasing {

void make_ripple_aliasing(Making& of) {
  const double amplitude_N = of.size;
  const double phase = of.draws.uniform(0.0, 6.2831853);
  const double second = of.draw("second_order_share", uniform(0.2, 0.7));
  of.effect.trace = [=](RunRecord& record) {
    double angle = phase;
    const double radius_m = 0.5 * record.specimen->drum_diameter_m;
    for (std::size_t row = 0; row < record.time_s.size(); ++row) {
      if (row > 0) angle += (record.speed_km_h[row - 1] + record.speed_km_h[row]) / 7.2 / radius_m;
      record.force[row] += record.lever * amplitude_N * (std::sin(angle) + second * std::sin(2.0 * angle));
    }
  };
}

const EffectKind kind{"ripple_aliasing",
                      {"N", "amplitude of the first order", 0.0, 0.0, 50.0, log_normal(1.0, 5.0, 0.8, 7.0)},
                      {{"only", "sines of the angle of drum or roller at the rows, so that constant speeds beat slowly",
                        make_ripple_aliasing}},
                      on_rigs,
                      on_rigs,
                      true};

}  // namespace rollrig::generator::ripple_aliasing
