/// The pressure sensor of the cavity reads too much or too little.
#include "models/effect.h"
#include "models/reference_conditions.h"

namespace rollrig::models::pressure_record {

struct PressureRecord {
  enum Parameter { kOffset, kDrift, kScaleShare };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "pressure_record";
    info.summary =
        "The sensor of the cavity's pressure reads off by a constant or a share, and by a little more as it warms; the "
        "pressure itself, set by another gauge, is as it should be, so that loss and temperature know nothing of it";
    info.equation = "p <- p + o (1 - g + g p/p_ref) + d (T - 25 degC)";
    info.source =
        "cold_pressure_kPa is read on the setting gauge, which stays right: what is off is the reading of the "
        "cavity's sensor. Assumed: constant, 2 to 15 kPa; either sign, the same in every run; d, the zero's shift "
        "with temperature, as of strain-gauge sensors in a tire: 0.02 % of 400 kPa a kelvin; T of the liner; g, of "
        "zero and scale one may be off as well as the other; p_ref the tire's reference pressure";
    info.parameters = {
        {"offset_kPa",
         between(-200.0, 200.0),
         {2.0, 15.0, Prior::Scale::kLog, true},
         "o, reading less true pressure at 25 degC and the reference pressure",
         0.0},
        {"drift_kPa_per_dK", between(-2.0, 2.0), {-0.08, 0.08}, "d, of the zero with temperature"},
        {"scale_share", between(-1.0, 2.0), {0.0, 1.0}, "g, of the offset, that goes with the pressure"}};
    info.acts_on = &is_indoors;
    info.visible_in = {quantities::kCavityPressure};
    info.clean_in = {quantities::kMachineForce, quantities::kLinerTemperature};
    info.splitting_tests = {"sensor and setting gauge read at one time, on the cold tire"};
    return info;
  }

  template <class S>
  static void trace(const EffectView<S>& self, TracePort<S>& port) {
    std::vector<S>* pressure_Pa = port.find(quantities::kCavityPressure);
    if (pressure_Pa == nullptr) return;
    const S reference_Pa = port.context->tire.rolling_resistance.reference_pressure_Pa;
    const S of_pressure = self.parameter(kOffset) * self.parameter(kScaleShare) / reference_Pa;
    const S constant_Pa = self.parameter(kOffset) * (S(1.0) - self.parameter(kScaleShare));
    const S reference_K = get_reference_temperature_K<S>();
    const std::vector<S>* liner_K = port.find(quantities::kLinerTemperature);
    for (std::size_t row = 0; row < pressure_Pa->size(); ++row) {
      (*pressure_Pa)[row] += constant_Pa + of_pressure * (*pressure_Pa)[row];
      if (liner_K != nullptr) (*pressure_Pa)[row] += self.parameter(kDrift) * ((*liner_K)[row] - reference_K);
    }
  }
};

const Effect& effect() { return make_effect<PressureRecord>(); }

}  // namespace rollrig::models::pressure_record
