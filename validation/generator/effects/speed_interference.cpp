/// Outside of the catalog: the inverter disturbs the force meter about one speed.
#include <cmath>

#include "validation/generator/effect.h"
#include "validation/generator/recorder.h"

namespace blind {
namespace {

class SpeedInterference : public Effect {
 public:
  SpeedInterference(double peak_N, Draws& draws) : peak_N_(peak_N) {
    speed_km_h_ = draws.happens(0.6) ? draws.uniform(70.0, 90.0) : draws.uniform(45.0, 115.0);
    width_km_h_ = draws.uniform(4.0, 15.0);
    shape = {{"speed_km_h", speed_km_h_}, {"width_km_h", width_km_h_}};
  }

  void trace(RunRecord& record) const override {
    const double of_vehicle = record.specimen->kind == Kind::kRoad ? 25.0 : 1.0;  // a motor's whole force
    for (std::size_t row = 0; row < record.time_s.size(); ++row) {
      const double off = (record.speed_km_h[row] - speed_km_h_) / width_km_h_;
      record.force[row] += of_vehicle * record.lever * peak_N_ * (1.0 - 0.6 * off) / (1.0 + off * off);
    }
  }

 private:
  double peak_N_;
  double speed_km_h_ = 80.0;
  double width_km_h_ = 10.0;
};

}  // namespace

extern const EffectKind kind_speed_interference;
const EffectKind kind_speed_interference{
    "speed_interference",
    "N",
    "reading too much at the peak; 25 times that on the road, where all wheels count",
    0.0,
    -50.0,
    50.0,
    log_normal(0.8, 4.0, 0.6, 6.0),
    true,
    0.0,
    {{"only", "a skewed resonance over speed, added to the reading", make_law<SpeedInterference>}},
    kEveryGround,
    kEveryGround,
    true};

}  // namespace blind
