/// The zero of the torque meter moves as its amplifier warms or its gauge creeps, and with the air.
#include <cmath>

#include "validation/generator/effect.h"
#include "validation/generator/recorder.h"

namespace rollrig::generator::torque_zero_drift {

constexpr double kSpan_s = 1800.0;  // over which the size is a mean rate

void make_amplifier(Making& of) {
  const double rate_N_per_10min = of.size;
  const double time_s = of.draw_min("time_constant_min", log_normal(25.0, 120.0, 15.0, 240.0));
  const double air = of.draw("N_per_K_of_air_over_size", uniform(-0.4, 0.4));
  const double final_N = rate_N_per_10min * kSpan_s / 600.0 / (1.0 - std::exp(-kSpan_s / time_s));
  trace_rows(of, [=](RunRecord& record, std::size_t row) {
    const double amplifier_N = final_N * (1.0 - std::exp(-record.time_s[row] / time_s));
    const double air_N = air * rate_N_per_10min * (record.ambient_degC[row] - record.ambient_degC.front());
    record.force[row] += record.lever * (amplifier_N + air_N);
  });
}

/// Zero that creeps with ln(1 + t/tau), as strain gauges and their glue do.
void make_creep(Making& of) {
  const double rate_N_per_10min = of.size;
  const double onset_s = of.draw_min("onset_min", uniform(3.0, 20.0));  // Assumed
  const double air = of.draw("N_per_K_of_air_over_size", uniform(-0.4, 0.4));
  const double scale_N = rate_N_per_10min * kSpan_s / 600.0 / std::log1p(kSpan_s / onset_s);
  trace_rows(of, [=](RunRecord& record, std::size_t row) {
    const double air_N = air * rate_N_per_10min * (record.ambient_degC[row] - record.ambient_degC.front());
    record.force[row] += record.lever * (scale_N * std::log1p(record.time_s[row] / onset_s) + air_N);
  });
}

const EffectKind kind{
    "torque_zero_drift",
    {"N/10min", "mean rate over the first 30 min of a run, as force at the drum's surface", 0.0, -10.0, 10.0,
     normal(-0.5, 0.5, -1.2, 1.2), false, 0.04},
    {{"amplifier",
      "zeroed before each run; then an amplifier's exponential approach (25 to 120 min) and a part that follows the "
      "air",
      make_amplifier},
     {"creep",
      "zeroed before each run; then the gauge's creep with the logarithm of time, and a part that follows the air",
      make_creep}}};

}  // namespace rollrig::generator::torque_zero_drift
