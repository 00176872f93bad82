/// The sensor in the cavity reads off by a constant that goes with its temperature, or by a scale that bends.

#include "validation/generator/effect.h"
#include "validation/generator/recorder.h"

namespace rollrig::generator {
namespace {

class PressureRecord : public Effect {
 public:
  using Effect::Effect;

  void trace(RunRecord& record) const override {
    for (std::size_t row = 0; row < record.time_s.size(); ++row) {
      record.pressure_kPa[row] += offset_kPa_ * (1.0 + per_K_ * (record.liner_degC[row] - 35.0));
    }
  }

 private:
  double offset_kPa_ = size_;
  double per_K_ = note("share_per_K", draws_.uniform(-0.004, 0.004));
};

/// e x (1 + q (x - 1)), x the pressure over the reference pressure.
class PressureScale : public Effect {
 public:
  using Effect::Effect;

  void trace(RunRecord& record) const override {
    for (double& pressure_kPa : record.pressure_kPa) {
      const double x = pressure_kPa / record.specimen->reference_pressure_kPa;
      pressure_kPa += offset_kPa_ * x * (1.0 + bend_ * (x - 1.0));
    }
  }

 private:
  double offset_kPa_ = size_;
  double bend_ = note("bend", draws_.uniform(-0.8, -0.2));
};

}  // namespace

const EffectKind kind_pressure_record{
    "pressure_record",
    {"kPa", "reading less true pressure at 35 degC and the reference pressure", 0.0, -100.0, 100.0,
     log_normal(2.0, 15.0, 1.3, 20.0), true},
    {{"warming", "an offset with a share that goes with the temperature", make_law<PressureRecord>},
     {"scale", "an error of a scale that bends, at the reference pressure", make_law<PressureScale>}}};

}  // namespace rollrig::generator
