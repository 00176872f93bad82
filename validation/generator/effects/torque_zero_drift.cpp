/// The zero of the torque meter moves as its amplifier warms or its gauge creeps, and with the air.
#include <cmath>

#include "validation/generator/effect.h"
#include "validation/generator/recorder.h"

namespace blind {
namespace {

constexpr double kSpan_s = 1800.0;  // over which the size is a mean rate

class TorqueZeroDrift : public Effect {
 public:
  TorqueZeroDrift(double rate_N_per_10min, Draws& draws) : rate_N_per_10min_(rate_N_per_10min) {
    time_s_ = 60.0 * draws.from(log_normal(25.0, 120.0, 15.0, 240.0));
    air_ = draws.uniform(-0.4, 0.4);
    shape = {{"time_constant_min", time_s_ / 60.0}, {"N_per_K_of_air_over_size", air_}};
  }

  void trace(RunRecord& record) const override {
    const double final_N = rate_N_per_10min_ * kSpan_s / 600.0 / (1.0 - std::exp(-kSpan_s / time_s_));
    for (std::size_t row = 0; row < record.time_s.size(); ++row) {
      const double amplifier_N = final_N * (1.0 - std::exp(-record.time_s[row] / time_s_));
      const double air_N = air_ * rate_N_per_10min_ * (record.ambient_degC[row] - record.ambient_degC.front());
      record.force[row] += record.lever * (amplifier_N + air_N);
    }
  }

 private:
  double rate_N_per_10min_;
  double time_s_ = 0.0;
  double air_ = 0.0;
};

/// Zero that creeps with ln(1 + t/tau), as strain gauges and their glue do.
class GaugeCreep : public Effect {
 public:
  GaugeCreep(double rate_N_per_10min, Draws& draws) : rate_N_per_10min_(rate_N_per_10min) {
    onset_s_ = 60.0 * draws.uniform(3.0, 20.0);  // Assumed
    air_ = draws.uniform(-0.4, 0.4);
    shape = {{"onset_min", onset_s_ / 60.0}, {"N_per_K_of_air_over_size", air_}};
  }

  void trace(RunRecord& record) const override {
    const double scale_N = rate_N_per_10min_ * kSpan_s / 600.0 / std::log1p(kSpan_s / onset_s_);
    for (std::size_t row = 0; row < record.time_s.size(); ++row) {
      const double air_N = air_ * rate_N_per_10min_ * (record.ambient_degC[row] - record.ambient_degC.front());
      record.force[row] += record.lever * (scale_N * std::log1p(record.time_s[row] / onset_s_) + air_N);
    }
  }

 private:
  double rate_N_per_10min_;
  double onset_s_ = 1.0;
  double air_ = 0.0;
};

}  // namespace

extern const EffectKind kind_torque_zero_drift;
const EffectKind kind_torque_zero_drift{
    "torque_zero_drift",
    "N/10min",
    "mean rate over the first 30 min of a run, as force at the drum's surface",
    0.0,
    -10.0,
    10.0,
    normal(-0.5, 0.5, -1.2, 1.2),
    false,
    0.04,
    {{"amplifier",
      "zeroed before each run; then an amplifier's exponential approach (25 to 120 min) and a part that follows the "
      "air",
      make_law<TorqueZeroDrift>},
     {"creep",
      "zeroed before each run; then the gauge's creep with the logarithm of time, and a part that follows the air",
      make_law<GaugeCreep>}}};

}  // namespace blind
