/// The logger of temperature and pressure has a clock of its own, left alone or set anew time and again.
#include <cmath>

#include "validation/generator/effect.h"
#include "validation/generator/recorder.h"

namespace rollrig::generator::clock_shift {

void shift_row(RunRecord& record, std::size_t row, double shift_s) {
  record.liner_degC[row] = record.sample(record.liner, row, shift_s);
  record.pressure_kPa[row] = record.sample(record.pressure, row, shift_s);
}

void make_rate(Making& of) {
  const double late_s = of.size;
  const double rate = late_s == 0.0 ? 0.0 : 1e-6 * of.draw("rate_per_million", uniform(-60.0, 60.0));
  trace_rows(of,
             [=](RunRecord& record, std::size_t row) { shift_row(record, row, -late_s + rate * record.time_s[row]); });
}

/// A clock that drifts and is set anew each some minutes: d (1 + a saw(t)), saw from -1 to 1.
void make_set_anew(Making& of) {
  const double late_s = of.size;
  const double swing = of.draw("swing_over_size", uniform(0.04, 0.14));
  const double period_s = of.draw_min("set_each_min", uniform(4.0, 20.0));
  const double phase = of.draws.uniform();
  trace_rows(of, [=](RunRecord& record, std::size_t row) {
    const double turns = record.time_s[row] / period_s + phase;
    const double saw = 2.0 * (turns - std::floor(turns)) - 1.0;
    shift_row(record, row, -late_s * (1.0 + swing * saw));
  });
}

const EffectKind kind{
    "clock_shift",
    {"s", "delay of temperature and pressure in the record against torque", 0.0, -25.0, 25.0,
     log_normal(0.5, 10.0, 0.2, 20.0), true},
    {{"rate",
      "the logger of temperature and pressure starts late or early, and its clock runs up to 60 millionths fast or "
      "slow",
      make_rate},
     {"set_anew",
      "the logger's clock runs fast or slow and is set anew time and again: the shift is a saw-tooth about the size",
      make_set_anew}}};

}  // namespace rollrig::generator::clock_shift
