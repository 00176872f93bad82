/// The sensor in the cavity reads off by a constant that goes with its temperature, or by a scale that bends.

#include "validation/generator/effect.h"
#include "validation/generator/recorder.h"

namespace rollrig::generator::pressure_record {

void make_warming(Making& of) {
  const double offset_kPa = of.size;
  const double per_K = of.draw("share_per_K", uniform(-0.004, 0.004));
  trace_rows(of, [=](RunRecord& record, std::size_t row) {
    record.pressure_kPa[row] += offset_kPa * (1.0 + per_K * (record.liner_degC[row] - 35.0));
  });
}

/// e x (1 + q (x - 1)), x the pressure over the reference pressure.
void make_scale(Making& of) {
  const double offset_kPa = of.size;
  const double bend = of.draw("bend", uniform(-0.8, -0.2));
  trace_rows(of, [=](RunRecord& record, std::size_t row) {
    const double x = record.pressure_kPa[row] / record.specimen->reference_pressure_kPa;
    record.pressure_kPa[row] += offset_kPa * x * (1.0 + bend * (x - 1.0));
  });
}

const EffectKind kind{"pressure_record",
                      {"kPa", "reading less true pressure at 35 degC and the reference pressure", 0.0, -100.0, 100.0,
                       log_normal(2.0, 15.0, 1.3, 20.0), true},
                      {{"warming", "an offset with a share that goes with the temperature", make_warming},
                       {"scale", "an error of a scale that bends, at the reference pressure", make_scale}}};

}  // namespace rollrig::generator::pressure_record
