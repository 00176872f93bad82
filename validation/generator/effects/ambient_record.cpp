/// Between machines: the air at the tire is warmer or colder than its thermometer says.
#include "validation/generator/effect.h"

namespace rollrig::generator::ambient_record {

void make_offset(Making& of) {
  const double error_dK = of.size;
  of.effect.enter = [=](const double*, Instant& now) { now.ambient_degC += error_dK; };
}

/// A thermometer in a corner that the drum's wind reaches more or less.
void make_with_wind(Making& of) {
  const double error_dK = of.size;
  const double share = of.draw("speed_share", uniform(-0.3, 0.3));
  of.effect.enter = [=](const double*, Instant& now) {
    now.ambient_degC += error_dK * (1.0 - share + share * now.speed_m_s / kSpeed80_m_s);
  };
}

const EffectKind kind{
    "ambient_record",
    {"K", "true over recorded air temperature at 80 km/h", 0.0, -30.0, 30.0, log_normal(0.8, 4.0, 0.5, 6.0), true},
    {{"offset", "the same error at all times", make_offset},
     {"with_wind", "an error of which a share goes with the speed", make_with_wind}},
    on_carriages,
    on_carriages,
    true,
    OutsideList::kBetweenMachines};

}  // namespace rollrig::generator::ambient_record
