/// The speed is recorded by a wheel of another radius, which grows as it turns, or with an offset.
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::speed_record {

void make_growing(Making& of) {
  const double error = 0.01 * of.size;
  const double growing = of.draw("growing_share", uniform(0.0, 0.3));
  of.effect.true_speed_m_s = [=](double recorded_m_s) {
    return recorded_m_s * (1.0 + error * (1.0 - growing + growing * recorded_m_s / kSpeed80_m_s));
  };
}

/// v (1 + e (1 - o)) + e o v80 tanh(v/v_k): the part o of the error is a fixed speed.
void make_offset(Making& of) {
  const double error = 0.01 * of.size;
  const double offset_share = of.draw("offset_share", uniform(0.1, 0.4));
  of.effect.true_speed_m_s = [=](double recorded_m_s) {
    constexpr double kPace_m_s = 2.0;  // Assumed: from which on pulses are counted
    const double there = std::tanh(recorded_m_s / kPace_m_s);
    return recorded_m_s + error * ((1.0 - offset_share) * recorded_m_s + offset_share * kSpeed80_m_s * there);
  };
}

const EffectKind kind{"speed_record",
                      {"percent", "true over recorded speed at 80 km/h, less one", 0.0, -30.0, 30.0,
                       log_normal(1.0, 10.0, 0.7, 12.0), true},
                      {{"growing", "a scale with a part that grows with speed", make_growing},
                       {"offset", "a scale beside a fixed speed, which is there from walking pace on", make_offset}},
                      everywhere,
                      everywhere};

}  // namespace rollrig::generator::speed_record
