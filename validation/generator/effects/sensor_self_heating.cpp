/// Outside of the catalog: the thermometer at the liner warms itself once it is switched on.
#include <cmath>

#include "validation/generator/effect.h"
#include "validation/generator/recorder.h"

namespace blind {
namespace {

class SensorSelfHeating : public Effect {
 public:
  SensorSelfHeating(double rise_dK, Draws& draws) : rise_dK_(rise_dK) {
    time_s_ = 60.0 * draws.uniform(3.0, 15.0);
    swept_ = draws.uniform(0.2, 0.6);
    shape = {{"time_constant_min", time_s_ / 60.0}, {"swept_share_at_80_km_h", swept_}};
  }

  void trace(RunRecord& record) const override {
    double rise = 0.0;
    for (std::size_t row = 0; row < record.time_s.size(); ++row) {
      const double x = record.speed_km_h[row] / 80.0;
      const double aim = 1.0 / (1.0 + swept_ / (1.0 - swept_) * std::sqrt(x));
      if (row > 0) rise += (aim - rise) * -std::expm1(-(record.time_s[row] - record.time_s[row - 1]) / time_s_);
      record.liner_degC[row] += rise_dK_ * rise;
    }
  }

 private:
  double rise_dK_;
  double time_s_ = 1.0;
  double swept_ = 0.0;
};

}  // namespace

extern const EffectKind kind_sensor_self_heating;
const EffectKind kind_sensor_self_heating{
    "sensor_self_heating",
    "K",
    "excess of the reading at standstill",
    0.0,
    0.0,
    50.0,
    log_normal(1.5, 6.0, 1.0, 9.0),
    false,
    0.0,
    {{"only", "first order from the start of each run, less in moving gas", make_law<SensorSelfHeating>}},
    kRigGrounds,
    kRigGrounds,
    true};

}  // namespace blind
