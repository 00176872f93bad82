/// Work of the slip under drive and brake force, by the brush model or a hyperbolic tangent.
#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

/// Force times slip, from the motor or brake, into the tread.
class SlipLoss : public Effect {
 public:
  using Effect::Effect;

  void act(const double*, Instant& now) const override {
    if (std::isinf(stiffness_N_)) return;
    const double force_N = std::abs(now.longitudinal_N);
    const double grip_N = friction_ * std::max(1.0, now.load_N);
    const double slip = find_slip(force_N, grip_N, stiffness_N_);
    now.rig_force_N += force_N * slip;
    now.tread_heat_W += force_N * slip * now.speed_m_s;
  }

 private:
  virtual double find_slip(double force_N, double grip_N, double stiffness_N) const = 0;

  double stiffness_N_ = 1e3 * size_;
  double friction_ = note("friction", draws_.uniform(0.7, 1.1));
};

class BrushSlip : public SlipLoss {
 public:
  using SlipLoss::SlipLoss;

 private:
  double find_slip(double force_N, double grip_N, double stiffness_N) const override {
    const double sticking = std::cbrt(std::max(0.0, 1.0 - force_N / grip_N));
    return 3.0 * grip_N / stiffness_N * (1.0 - sticking);
  }
};

/// F = grip tanh(C s/grip), turned round for the slip s.
class TanhSlip : public SlipLoss {
 public:
  using SlipLoss::SlipLoss;

 private:
  double find_slip(double force_N, double grip_N, double stiffness_N) const override {
    constexpr double kMostOfGrip = 0.99;
    return grip_N / stiffness_N * std::atanh(std::min(kMostOfGrip, force_N / grip_N));
  }
};

}  // namespace

const EffectKind kind_slip_loss{
    "slip_loss",
    {"kN", "force over slip where both are small", std::numeric_limits<double>::infinity(), 5.0,
     std::numeric_limits<double>::infinity(), log_normal(60.0, 250.0, 45.0, 330.0)},
    {{"brush", "brush model with parabolic pressure, F over slip bends down to the friction limit; heats the tread",
      make_law<BrushSlip>},
     {"tanh", "force as grip x tanh(C s/grip) of the slip; heats the tread", make_law<TanhSlip>}},
    kDynoGround,
    kDynoGround};

}  // namespace rollrig::generator
