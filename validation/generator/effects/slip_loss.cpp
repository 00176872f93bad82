/// Work of the slip under drive and brake force, by the brush model or a hyperbolic tangent.
#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/generator/effect.h"

namespace rollrig::generator::slip_loss {

/// Force times slip, from the motor or brake, into the tread.
template <class Slip>
void add_slip(Making& of, const Slip& find_slip) {
  const double stiffness_N = 1e3 * of.size;
  const double friction = of.draw("friction", uniform(0.7, 1.1));
  of.effect.act = [=](const double*, Instant& now) {
    if (std::isinf(stiffness_N)) return;
    const double force_N = std::abs(now.longitudinal_N);
    const double grip_N = friction * std::max(1.0, now.load_N);
    const double slip = find_slip(force_N, grip_N, stiffness_N);
    now.rig_force_N += force_N * slip;
    now.tread_heat_W += force_N * slip * now.speed_m_s;
  };
}

void make_brush(Making& of) {
  add_slip(of, [](double force_N, double grip_N, double stiffness_N) {
    const double sticking = std::cbrt(std::max(0.0, 1.0 - force_N / grip_N));
    return 3.0 * grip_N / stiffness_N * (1.0 - sticking);
  });
}

/// F = grip tanh(C s/grip), turned round for the slip s.
void make_tanh(Making& of) {
  add_slip(of, [](double force_N, double grip_N, double stiffness_N) {
    constexpr double kMostOfGrip = 0.99;
    return grip_N / stiffness_N * std::atanh(std::min(kMostOfGrip, force_N / grip_N));
  });
}

const EffectKind kind{
    "slip_loss",
    {"kN", "force over slip where both are small", std::numeric_limits<double>::infinity(), 5.0,
     std::numeric_limits<double>::infinity(), log_normal(60.0, 250.0, 45.0, 330.0)},
    {{"brush", "brush model with parabolic pressure, F over slip bends down to the friction limit; heats the tread",
      make_brush},
     {"tanh", "force as grip x tanh(C s/grip) of the slip; heats the tread", make_tanh}},
    on_rollers,
    on_rollers};

}  // namespace rollrig::generator::slip_loss
