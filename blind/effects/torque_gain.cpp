/// The torque meter reads a share too much or too little, less at high torque.
#include <cmath>

#include "blind/effect.h"
#include "blind/recorder.h"

namespace blind {
namespace {

constexpr double kReference_N = 60.0;

class TorqueGain : public Effect {
 public:
  TorqueGain(double percent, Draws& draws) : gain_(0.01 * percent) {
    bend_ = draws.uniform(0.0, 0.3);
    shape = {{"bend_at_60_N", bend_}};
  }

  void trace(RunRecord& record) const override {
    for (double& force : record.force) {
      const double share = std::abs(force) / (record.lever * kReference_N);
      force += gain_ * force * (1.0 + bend_) / (1.0 + bend_ * share);
    }
  }

 private:
  double gain_;
  double bend_ = 0.0;
};

}  // namespace

extern const EffectKind kind_torque_gain;
const EffectKind kind_torque_gain{"torque_gain",
                                  "percent",
                                  "error of scale at a force of 60 N",
                                  0.0,
                                  -20.0,
                                  20.0,
                                  normal(-2.0, 2.0, -4.0, 4.0),
                                  false,
                                  0.3,
                                  "gain of a bridge that bends, g (1 + q)/(1 + q F/60 N); also on a force at a roller",
                                  [](double size, Draws& draws, const Specimen&) -> std::unique_ptr<Effect> {
                                    return std::make_unique<TorqueGain>(size, draws);
                                  },
                                  kRigGrounds,
                                  kRigGrounds};

}  // namespace blind
