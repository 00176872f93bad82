/// Outside of the catalog: the axle is held at a height, so that a tire that grows with speed presses harder.
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

class TireGrowth : public Effect {
 public:
  using Effect::Effect;

  void enter(const double*, Instant& now) const override {
    // As a share of the load that is set: a tire in skim grows into the drum by the same height.
    const double x = now.speed_m_s / kSpeed120_m_s;
    now.load_N += growth_ * now.specimen->reference_load_N * std::pow(x, power_);
  }

 private:
  static constexpr double kSpeed120_m_s = 120.0 / 3.6;

  double growth_ = 0.01 * size_;
  double power_ = note("power", draws_.uniform(1.8, 2.3));
};

}  // namespace

const EffectKind kind_tire_growth{
    "tire_growth",
    {"percent", "further load at 120 km/h, of the reference load", 0.0, 0.0, 50.0, log_normal(2.0, 8.0, 1.5, 12.0)},
    {{"only", "load rises with about the square of the speed by the same amount at every load", make_law<TireGrowth>}},
    kRigGrounds,
    kRigGrounds,
    true};

}  // namespace rollrig::generator
