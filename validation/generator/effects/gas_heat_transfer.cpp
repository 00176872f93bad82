/// Heat goes between tire and gas at another rate, which speed stirs or the density carries.
#include <algorithm>
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

class GasHeatTransfer : public Effect {
 public:
  explicit GasHeatTransfer(const Making& of) : Effect(of), excess_(of.size - 1.0) {
    stirred_ = of.draws.uniform(0.2, 0.7);
    shape = {{"stirred_share", stirred_}, {"W_per_K_at_80_km_h", of.size * of.specimen.truth(Base::kH)}};
  }

  void act(const double*, Instant& now) const override {
    const double stirring = 1.0 - stirred_ + stirred_ * std::pow(now.speed_m_s / kSpeed80_m_s, 0.8);
    now.gas_link_factor *= std::max(0.05, 1.0 + excess_ * stirring);
  }

 private:
  double excess_;
  double stirred_ = 0.0;
};

/// What differs goes with (p/p_ref)^0.8, absolute: convection of a denser gas.
class GasDensity : public Effect {
 public:
  explicit GasDensity(const Making& of) : Effect(of), excess_(of.size - 1.0) {
    shape = {{"W_per_K_at_reference_pressure", of.size * of.specimen.truth(Base::kH)}};
  }

  void act(const double*, Instant& now) const override {
    constexpr double kAir_kPa = 101.325;
    const double dense = (now.pressure_kPa + kAir_kPa) / (now.specimen->reference_pressure_kPa + kAir_kPa);
    now.gas_link_factor *= std::max(0.05, 1.0 + excess_ * std::pow(dense, 0.8));
  }

 private:
  double excess_;
};

}  // namespace

const EffectKind kind_gas_heat_transfer{
    "gas_heat_transfer",
    {"1", "coefficient at 80 km/h and the reference pressure over the one that is otherwise true", 1.0, 0.05, 10.0,
     log_normal(0.3, 2.0, 0.2, 3.0), false, 0.3},
    {{"stirred", "what differs has a part at rest and one with v^0.8", make_law<GasHeatTransfer>},
     {"density", "what differs goes with the gas's density to the power 0.8, whatever the speed",
      make_law<GasDensity>}}};

}  // namespace rollrig::generator
