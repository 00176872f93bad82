/// Between machines: the surface is rougher or smoother than that on which the tire's numbers were found.
#include <algorithm>
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::surface_roughness {

void make_level(Making& of) {
  const double change = 0.01 * of.size;
  of.effect.act = [=](const double*, Instant& now) { now.loss_factor *= 1.0 + change; };
}

/// More of it where the tread is pressed into the surface: by a power of the load, and it fades as the rubber warms.
void make_indented(Making& of) {
  const double change = 0.01 * of.size;
  const double load_power = of.draw("load_power", uniform(-0.15, 0.15));
  const double per_K = of.draw("share_per_K", uniform(0.0, 0.004));
  of.effect.act = [=](const double*, Instant& now) {
    const double load = std::max(1.0, now.load_N) / now.specimen->reference_load_N;
    now.loss_factor *= 1.0 + change * std::pow(load, load_power) * (1.0 - per_K * (now.rubber_degC - 40.0));
  };
}

const EffectKind kind{
    "surface_roughness",
    {"percent", "loss on this surface over that of the tire's numbers at the reference load, less one", 0.0, -50.0,
     50.0, log_normal(1.5, 6.0, 1.0, 9.0), true},
    {{"level", "the same share at every speed, load and temperature", make_level},
     {"indented", "by a power of the load, and less in warm rubber", make_indented}},
    on_carriages,
    on_carriages,
    true,
    OutsideList::kBetweenMachines};

}  // namespace rollrig::generator::surface_roughness
