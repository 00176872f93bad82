/// The speed is recorded by a wheel of another radius, which grows as it turns, or with an offset.
#include <cmath>

#include "validation/generator/effect.h"

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

/// v (1 + e (1 - o)) + e o v80 tanh(v/v_k): the part o of the error is a fixed speed.
class SpeedOffset : public Effect {
 public:
  SpeedOffset(double percent, Draws& draws) : error_(0.01 * percent) {
    offset_share_ = draws.uniform(0.1, 0.4);
    shape = {{"offset_share", offset_share_}};
  }

  double true_speed_m_s(double recorded_m_s) const override {
    constexpr double kPace_m_s = 2.0;  // Assumed: from which on pulses are counted
    const double there = std::tanh(recorded_m_s / kPace_m_s);
    return recorded_m_s + error_ * ((1.0 - offset_share_) * recorded_m_s + offset_share_ * kSpeed80_m_s * there);
  }

 private:
  double error_;
  double offset_share_ = 0.0;
};

}  // namespace

extern const EffectKind kind_speed_record;
const EffectKind kind_speed_record{
    "speed_record",
    "percent",
    "true over recorded speed at 80 km/h, less one",
    0.0,
    -30.0,
    30.0,
    log_normal(1.0, 10.0, 0.7, 12.0),
    true,
    0.0,
    {{"growing", "a scale with a part that grows with speed", make_law<SpeedRecord>},
     {"offset", "a scale beside a fixed speed, which is there from walking pace on", make_law<SpeedOffset>}},
    kEveryGround,
    kEveryGround};

}  // namespace blind
