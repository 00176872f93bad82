/// The logger of temperature and pressure has a clock of its own, left alone or set anew time and again.
#include <cmath>

#include "validation/generator/effect.h"
#include "validation/generator/recorder.h"

namespace rollrig::generator {
namespace {

class ClockShift : public Effect {
 public:
  using Effect::Effect;

  void trace(RunRecord& record) const override {
    for (std::size_t row = 0; row < record.time_s.size(); ++row) {
      const double shift_s = -late_s_ + rate_ * record.time_s[row];
      record.liner_degC[row] = record.sample(record.liner, row, shift_s);
      record.pressure_kPa[row] = record.sample(record.pressure, row, shift_s);
    }
  }

 private:
  double late_s_ = size_;
  double rate_ = size_ == 0.0 ? 0.0 : 1e-6 * note("rate_per_million", draws_.uniform(-60.0, 60.0));
};

/// A clock that drifts and is set anew each some minutes: d (1 + a saw(t)), saw from -1 to 1.
class SetAnewClock : public Effect {
 public:
  using Effect::Effect;

  void trace(RunRecord& record) const override {
    for (std::size_t row = 0; row < record.time_s.size(); ++row) {
      const double turns = record.time_s[row] / period_s_ + phase_;
      const double saw = 2.0 * (turns - std::floor(turns)) - 1.0;
      const double shift_s = -late_s_ * (1.0 + swing_ * saw);
      record.liner_degC[row] = record.sample(record.liner, row, shift_s);
      record.pressure_kPa[row] = record.sample(record.pressure, row, shift_s);
    }
  }

 private:
  double late_s_ = size_;
  double swing_ = note("swing_over_size", draws_.uniform(0.04, 0.14));
  double period_s_ = note_min("set_each_min", 60.0 * draws_.uniform(4.0, 20.0));
  double phase_ = draws_.uniform();
};

}  // namespace

const EffectKind kind_clock_shift{
    "clock_shift",
    {"s", "delay of temperature and pressure in the record against torque", 0.0, -25.0, 25.0,
     log_normal(0.5, 10.0, 0.2, 20.0), true},
    {{"rate",
      "the logger of temperature and pressure starts late or early, and its clock runs up to 60 millionths fast or "
      "slow",
      make_law<ClockShift>},
     {"set_anew",
      "the logger's clock runs fast or slow and is set anew time and again: the shift is a saw-tooth about the size",
      make_law<SetAnewClock>}}};

}  // namespace rollrig::generator
