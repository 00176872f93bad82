/// The speed is recorded by a wheel of another radius, which grows as it turns.
#include <cmath>

#include "blind/effect.h"

namespace blind {
namespace {

class SpeedRecord : public Effect {
 public:
  SpeedRecord(double percent, Draws& draws) : error_(0.01 * percent) {
    growing_ = draws.uniform(0.0, 0.3);
    shape = {{"growing_share", growing_}};
  }

  double true_speed_m_s(double recorded_m_s) const override {
    return recorded_m_s * (1.0 + error_ * (1.0 - growing_ + growing_ * recorded_m_s / kSpeed80_m_s));
  }

 private:
  double error_;
  double growing_ = 0.0;
};

}  // namespace

extern const EffectKind kind_speed_record;
const EffectKind kind_speed_record{"speed_record",
                                   "percent",
                                   "true over recorded speed at 80 km/h, less one",
                                   0.0,
                                   -30.0,
                                   30.0,
                                   log_normal(1.0, 10.0, 0.7, 12.0),
                                   true,
                                   0.0,
                                   "a scale with a part that grows with speed",
                                   [](double size, Draws& draws, const Specimen&) -> std::unique_ptr<Effect> {
                                     return std::make_unique<SpeedRecord>(size, draws);
                                   },
                                   kEveryGround,
                                   kEveryGround};

}  // namespace blind
