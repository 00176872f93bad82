/// The sensor in the cavity reads off by a constant that goes with its temperature, or by a scale that bends.
#include <cmath>

#include "validation/generator/effect.h"
#include "validation/generator/recorder.h"

namespace blind {
namespace {

class PressureRecord : public Effect {
 public:
  PressureRecord(double offset_kPa, Draws& draws) : offset_kPa_(offset_kPa) {
    per_K_ = draws.uniform(-0.004, 0.004);
    shape = {{"share_per_K", per_K_}};
  }

  void trace(RunRecord& record) const override {
    for (std::size_t row = 0; row < record.time_s.size(); ++row) {
      record.pressure_kPa[row] += offset_kPa_ * (1.0 + per_K_ * (record.liner_degC[row] - 35.0));
    }
  }

 private:
  double offset_kPa_;
  double per_K_ = 0.0;
};

/// e x (1 + q (x - 1)), x the pressure over the reference pressure.
class PressureScale : public Effect {
 public:
  PressureScale(double offset_kPa, Draws& draws) : offset_kPa_(offset_kPa) {
    bend_ = draws.uniform(-0.8, -0.2);
    shape = {{"bend", bend_}};
  }

  void trace(RunRecord& record) const override {
    for (double& pressure_kPa : record.pressure_kPa) {
      const double x = pressure_kPa / record.specimen->reference_pressure_kPa;
      pressure_kPa += offset_kPa_ * x * (1.0 + bend_ * (x - 1.0));
    }
  }

 private:
  double offset_kPa_;
  double bend_ = 0.0;
};

}  // namespace

extern const EffectKind kind_pressure_record;
const EffectKind kind_pressure_record{
    "pressure_record",
    "kPa",
    "reading less true pressure at 35 degC and the reference pressure",
    0.0,
    -100.0,
    100.0,
    log_normal(2.0, 15.0, 1.3, 20.0),
    true,
    0.0,
    {{"warming", "an offset with a share that goes with the temperature", make_law<PressureRecord>},
     {"scale", "an error of a scale that bends, at the reference pressure", make_law<PressureScale>}},
    kRigGrounds,
    kRigGrounds};

}  // namespace blind
