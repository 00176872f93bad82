/// Outside of the catalog: the inverter disturbs the force meter about one speed.

#include "validation/generator/effect.h"
#include "validation/generator/machine.h"

namespace rollrig::generator::speed_interference {

void make_speed_interference(Making& of) {
  const double peak_N = of.size;
  const double speed_km_h = of.draw("speed_km_h", of.draws.happens(0.6) ? uniform(70.0, 90.0) : uniform(45.0, 115.0));
  const double width_km_h = of.draw("width_km_h", uniform(4.0, 15.0));
  const double of_vehicle = of.specimen.machine->has_vehicle() ? 25.0 : 1.0;  // a motor's whole force
  trace_rows(of, [=](RunRecord& record, std::size_t row) {
    const double off = (record.speed_km_h[row] - speed_km_h) / width_km_h;
    record.force[row] += of_vehicle * record.lever * peak_N * (1.0 - 0.6 * off) / (1.0 + off * off);
  });
}

const EffectKind kind{"speed_interference",
                      {"N", "reading too much at the peak; 25 times that on the road, where all wheels count", 0.0,
                       -50.0, 50.0, log_normal(0.8, 4.0, 0.6, 6.0), true},
                      {{"only", "a skewed resonance over speed, added to the reading", make_speed_interference}},
                      everywhere,
                      everywhere,
                      true};

}  // namespace rollrig::generator::speed_interference
