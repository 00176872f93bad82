/// The sensor in the cavity reads off by a constant and by a part that goes with its temperature.
#include <cmath>

#include "blind/effect.h"
#include "blind/recorder.h"

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

}  // namespace

extern const EffectKind kind_pressure_record;
const EffectKind kind_pressure_record{"pressure_record",
                                      "kPa",
                                      "reading less true pressure at 35 degC",
                                      0.0,
                                      -100.0,
                                      100.0,
                                      log_normal(2.0, 15.0, 1.3, 20.0),
                                      true,
                                      0.0,
                                      "an offset with a share that goes with the temperature",
                                      [](double size, Draws& draws, const Specimen&) -> std::unique_ptr<Effect> {
                                        return std::make_unique<PressureRecord>(size, draws);
                                      },
                                      kRigGrounds,
                                      kRigGrounds};

}  // namespace blind
