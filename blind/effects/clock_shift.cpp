/// The logger of temperature and pressure has a clock of its own.
#include "blind/effect.h"
#include "blind/recorder.h"

namespace blind {
namespace {

class ClockShift : public Effect {
 public:
  ClockShift(double late_s, Draws& draws) : late_s_(late_s) {
    const double per_million = draws.uniform(-60.0, 60.0);
    shape = {{"rate_per_million", per_million}};
    rate_ = late_s == 0.0 ? 0.0 : 1e-6 * per_million;
  }

  void trace(RunRecord& record) const override {
    for (std::size_t row = 0; row < record.time_s.size(); ++row) {
      const double shift_s = -late_s_ + rate_ * record.time_s[row];
      record.liner_degC[row] = record.sample(record.liner, row, shift_s);
      record.pressure_kPa[row] = record.sample(record.pressure, row, shift_s);
    }
  }

 private:
  double late_s_;
  double rate_ = 0.0;
};

}  // namespace

extern const EffectKind kind_clock_shift;
const EffectKind kind_clock_shift{
    "clock_shift",
    "s",
    "delay of temperature and pressure in the record against torque",
    0.0,
    -25.0,
    25.0,
    log_normal(0.5, 10.0, 0.2, 20.0),
    true,
    0.0,
    "the logger of temperature and pressure starts late or early, and its clock runs up to 60 millionths fast or slow",
    [](double size, Draws& draws, const Specimen&) -> std::unique_ptr<Effect> {
      return std::make_unique<ClockShift>(size, draws);
    }};

}  // namespace blind
