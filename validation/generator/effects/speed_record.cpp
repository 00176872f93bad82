/// The speed is recorded by a wheel of another radius, which grows as it turns, or with an offset.
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

class SpeedRecord : public Effect {
 public:
  using Effect::Effect;

  double true_speed_m_s(double recorded_m_s) const override {
    return recorded_m_s * (1.0 + error_ * (1.0 - growing_ + growing_ * recorded_m_s / kSpeed80_m_s));
  }

 private:
  double error_ = 0.01 * size_;
  double growing_ = note("growing_share", draws_.uniform(0.0, 0.3));
};

/// v (1 + e (1 - o)) + e o v80 tanh(v/v_k): the part o of the error is a fixed speed.
class SpeedOffset : public Effect {
 public:
  using Effect::Effect;

  double true_speed_m_s(double recorded_m_s) const override {
    constexpr double kPace_m_s = 2.0;  // Assumed: from which on pulses are counted
    const double there = std::tanh(recorded_m_s / kPace_m_s);
    return recorded_m_s + error_ * ((1.0 - offset_share_) * recorded_m_s + offset_share_ * kSpeed80_m_s * there);
  }

 private:
  double error_ = 0.01 * size_;
  double offset_share_ = note("offset_share", draws_.uniform(0.1, 0.4));
};

}  // namespace

const EffectKind kind_speed_record{
    "speed_record",
    {"percent", "true over recorded speed at 80 km/h, less one", 0.0, -30.0, 30.0, log_normal(1.0, 10.0, 0.7, 12.0),
     true},
    {{"growing", "a scale with a part that grows with speed", make_law<SpeedRecord>},
     {"offset", "a scale beside a fixed speed, which is there from walking pace on", make_law<SpeedOffset>}},
    kEveryGround,
    kEveryGround};

}  // namespace rollrig::generator
