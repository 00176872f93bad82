/// The torque meter reads a share too much or too little, less at high torque, or more or less with the air.
#include <cmath>

#include "validation/generator/effect.h"
#include "validation/generator/recorder.h"

namespace rollrig::generator::torque_gain {

constexpr double kReference_N = 60.0;

void make_bent(Making& of) {
  const double gain = 0.01 * of.size;
  const double bend = of.draw("bend_at_60_N", uniform(0.0, 0.3));
  trace_rows(of, [=](RunRecord& record, std::size_t row) {
    const double share = std::abs(record.force[row]) / (record.lever * kReference_N);
    record.force[row] += gain * record.force[row] * (1.0 + bend) / (1.0 + bend * share);
  });
}

/// Scale whose error moves with the air by up to 1 % of it per K (assumed).
void make_with_air(Making& of) {
  const double gain = 0.01 * of.size;
  const double per_K = of.draw("share_per_K", uniform(-0.01, 0.01));
  trace_rows(of, [=](RunRecord& record, std::size_t row) {
    record.force[row] += gain * (1.0 + per_K * (record.ambient_degC[row] - 25.0)) * record.force[row];
  });
}

const EffectKind kind{
    "torque_gain",
    {"percent", "error of scale at a force of 60 N and air of 25 degC", 0.0, -20.0, 20.0, normal(-2.0, 2.0, -4.0, 4.0),
     false, 0.3},
    {{"bent", "gain of a bridge that bends, g (1 + q)/(1 + q F/60 N); also on a force at a roller", make_bent},
     {"with_air",
      "a scale that moves with the temperature of the air, g (1 + k (T - 25 degC)); also on a force at a roller",
      make_with_air}}};

}  // namespace rollrig::generator::torque_gain
