/// Air cools the tire by another law of speed.
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::convection_law {

/// Laminar and turbulent parts of the boundary layer.
void make_boundary_layers(Making& of) {
  const double exponent = of.size;
  of.effect.act = [=](const double*, Instant& now) {
    const double x = now.air_speed_m_s / kSpeed80_m_s;
    now.air_speed_m_s = kSpeed80_m_s * ((2.0 * exponent - 1.0) * x + 2.0 * (1.0 - exponent) * std::sqrt(x));
  };
}

/// Speeds of fan and roller add by their squares; the file's f holds at 80 km/h.
void make_fan(Making& of) {
  const double exponent = of.size;
  of.effect.act = [=](const double*, Instant& now) {
    const double x = now.air_speed_m_s / kSpeed80_m_s;
    now.air_speed_m_s = kSpeed80_m_s * std::sqrt(exponent * x * x + 1.0 - exponent);
  };
}

const EffectKind kind{
    "convection_law",
    {"1", "exponent of the speed-dependent cooling over speed at 80 km/h", 1.0, 0.5, 1.0, normal(0.6, 1.0, 0.52, 0.96)},
    {{"boundary_layers", "a part with sqrt(v) beside one with v; f holds at 80 km/h", make_boundary_layers},
     {"fan", "a fan whose air speed adds by squares; f holds at 80 km/h", make_fan}},
    everywhere,
    on_rigs};

}  // namespace rollrig::generator::convection_law
