/// Outside of the catalog: torque ripple once a turn of drum or roller, sampled once a second without a filter.
#include <cmath>

#include "validation/generator/effect.h"
#include "validation/generator/recorder.h"

namespace rollrig::generator {
namespace {

class RippleAliasing : public Effect {
 public:
  using Effect::Effect;

  void trace(RunRecord& record) const override {
    double angle = phase_;
    const double radius_m = 0.5 * record.specimen->drum_diameter_m;
    for (std::size_t row = 0; row < record.time_s.size(); ++row) {
      if (row > 0) angle += (record.speed_km_h[row - 1] + record.speed_km_h[row]) / 7.2 / radius_m;
      record.force[row] += record.lever * amplitude_N_ * (std::sin(angle) + second_ * std::sin(2.0 * angle));
    }
  }

 private:
  double amplitude_N_ = size_;
  double phase_ = draws_.uniform(0.0, 6.2831853);
  double second_ = note("second_order_share", draws_.uniform(0.2, 0.7));
};

}  // namespace

const EffectKind kind_ripple_aliasing{
    "ripple_aliasing",
    {"N", "amplitude of the first order", 0.0, 0.0, 50.0, log_normal(1.0, 5.0, 0.8, 7.0)},
    {{"only", "sines of the angle of drum or roller at the rows, so that constant speeds beat slowly",
      make_law<RippleAliasing>}},
    kRigGrounds,
    kRigGrounds,
    true};

}  // namespace rollrig::generator
