/// Outside of the catalog: the inverter disturbs the force meter about one speed.

#include "validation/generator/effect.h"
#include "validation/generator/machine.h"

namespace rollrig::generator {
namespace {

class SpeedInterference : public Effect {
 public:
  using Effect::Effect;

  void trace(RunRecord& record) const override {
    const double of_vehicle = record.specimen->machine->has_vehicle() ? 25.0 : 1.0;  // a motor's whole force
    for (std::size_t row = 0; row < record.time_s.size(); ++row) {
      const double off = (record.speed_km_h[row] - speed_km_h_) / width_km_h_;
      record.force[row] += of_vehicle * record.lever * peak_N_ * (1.0 - 0.6 * off) / (1.0 + off * off);
    }
  }

 private:
  double peak_N_ = size_;
  double speed_km_h_ =
      note("speed_km_h", draws_.happens(0.6) ? draws_.uniform(70.0, 90.0) : draws_.uniform(45.0, 115.0));
  double width_km_h_ = note("width_km_h", draws_.uniform(4.0, 15.0));
};

}  // namespace

const EffectKind kind_speed_interference{
    "speed_interference",
    {"N", "reading too much at the peak; 25 times that on the road, where all wheels count", 0.0, -50.0, 50.0,
     log_normal(0.8, 4.0, 0.6, 6.0), true},
    {{"only", "a skewed resonance over speed, added to the reading", make_law<SpeedInterference>}},
    kEveryGround,
    kEveryGround,
    true};

}  // namespace rollrig::generator
