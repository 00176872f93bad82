/// The torque meter reads a share too much or too little, less at high torque, or more or less with the air.
#include <cmath>

#include "validation/generator/effect.h"
#include "validation/generator/recorder.h"

namespace rollrig::generator {
namespace {

constexpr double kReference_N = 60.0;

class TorqueGain : public Effect {
 public:
  using Effect::Effect;

  void trace(RunRecord& record) const override {
    for (double& force : record.force) {
      const double share = std::abs(force) / (record.lever * kReference_N);
      force += gain_ * force * (1.0 + bend_) / (1.0 + bend_ * share);
    }
  }

 private:
  double gain_ = 0.01 * size_;
  double bend_ = note("bend_at_60_N", draws_.uniform(0.0, 0.3));
};

/// Scale whose error moves with the air by up to 1 % of it per K (assumed).
class GainWithAir : public Effect {
 public:
  using Effect::Effect;

  void trace(RunRecord& record) const override {
    for (std::size_t row = 0; row < record.force.size(); ++row) {
      record.force[row] += gain_ * (1.0 + per_K_ * (record.ambient_degC[row] - 25.0)) * record.force[row];
    }
  }

 private:
  double gain_ = 0.01 * size_;
  double per_K_ = note("share_per_K", draws_.uniform(-0.01, 0.01));
};

}  // namespace

const EffectKind kind_torque_gain{
    "torque_gain",
    {"percent", "error of scale at a force of 60 N and air of 25 degC", 0.0, -20.0, 20.0, normal(-2.0, 2.0, -4.0, 4.0),
     false, 0.3},
    {{"bent", "gain of a bridge that bends, g (1 + q)/(1 + q F/60 N); also on a force at a roller",
      make_law<TorqueGain>},
     {"with_air",
      "a scale that moves with the temperature of the air, g (1 + k (T - 25 degC)); also on a force at a roller",
      make_law<GainWithAir>}}};

}  // namespace rollrig::generator
