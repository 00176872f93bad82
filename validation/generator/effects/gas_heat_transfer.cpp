/// Heat goes between tire and gas at another rate, which speed stirs or the density carries.
#include <algorithm>
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::gas_heat_transfer {

void make_stirred(Making& of) {
  const double excess = of.size - 1.0;
  const double stirred = of.draw("stirred_share", uniform(0.2, 0.7));
  of.note("W_per_K_at_80_km_h", of.size * of.specimen.truth(Base::kH));
  of.effect.act = [=](const double*, Instant& now) {
    const double stirring = 1.0 - stirred + stirred * std::pow(now.speed_m_s / kSpeed80_m_s, 0.8);
    now.gas_link_factor *= std::max(0.05, 1.0 + excess * stirring);
  };
}

/// What differs goes with (p/p_ref)^0.8, absolute: convection of a denser gas.
void make_density(Making& of) {
  const double excess = of.size - 1.0;
  of.note("W_per_K_at_reference_pressure", of.size * of.specimen.truth(Base::kH));
  of.effect.act = [=](const double*, Instant& now) {
    constexpr double kAir_kPa = 101.325;
    const double dense = (now.pressure_kPa + kAir_kPa) / (now.specimen->reference_pressure_kPa + kAir_kPa);
    now.gas_link_factor *= std::max(0.05, 1.0 + excess * std::pow(dense, 0.8));
  };
}

const EffectKind kind{
    "gas_heat_transfer",
    {"1", "coefficient at 80 km/h and the reference pressure over the one that is otherwise true", 1.0, 0.05, 10.0,
     log_normal(0.3, 2.0, 0.2, 3.0), false, 0.3},
    {{"stirred", "what differs has a part at rest and one with v^0.8", make_stirred},
     {"density", "what differs goes with the gas's density to the power 0.8, whatever the speed", make_density}}};

}  // namespace rollrig::generator::gas_heat_transfer
