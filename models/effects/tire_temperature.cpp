/// The loss follows the tire's temperature, where the baseline has one constant coefficient.
#include "models/effect.h"
#include "models/reference_conditions.h"

namespace rollrig::models::tire_temperature {

struct TireTemperature {
  enum Parameter { kFall, kWarmUp, kRise, kReferenceShift };
  enum State { kTemperature };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "tire_temperature";
    info.summary =
        "The tire's loss falls as the tire warms: more after a cold start, in cold air and at low speed than one "
        "constant coefficient says";
    info.equation =
        "F_rr <- F_rr e, e = exp(-B (T - T_r)), T_r = 25 degC + D + d; tau dT/dt = D q - g (T - T_amb), q = L v "
        "Fz/(v_r Fz_ref), L factor of all effects on the loss, e among them; g = (v_0 + v)/(v_0 + v_r); v_r = 80 "
        "km/h, v_0 = z/f";
    info.source =
        "Kolekar and Narasimhan (2024) (3.4), (3.8) to (3.14), with the heat balance in units of that at 80 km/h, 25 "
        "degC and the reference load, where the coefficient of ISO 28580 holds. Assumed: B, half to twice that of "
        "Figure 3.13; tau and D of tires from small to large; d, since a coefficient off a label may be of another "
        "tire's test; z/f of the tire's file or its class. Right after another run the tire begins D above its start";
    info.parameters = {
        {"fall_per_K",
         between(-0.1, 0.2),
         {0.008, 0.03, Prior::Scale::kLog},
         "B, relative fall of the loss with tire temperature",
         0.0},
        {"warm_up_min", between(0.5, 600.0), {5.0, 30.0, Prior::Scale::kLog}, "tau, of the warm-up at 80 km/h"},
        {"rise_dK",
         between(1.0, 150.0),
         {15.0, 40.0, Prior::Scale::kLog},
         "D, over the air in steady driving at 80 km/h with the loss of 25 degC"},
        {"reference_shift_dK",
         between(-60.0, 60.0),
         {-8.0, 8.0},
         "d, at which the coefficient holds, over that of 25 degC"}};
    info.states = {{"tire_temperature_degC", 10.0, "T, that the loss follows"}};
    info.only_against = kConstantModel;
    info.visible_in = {quantities::kMachineForce, quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"driveline_warming", "wind_and_grade", "rubber_memory"};
    info.splitting_tests = {"the same drive from cold in cold and in warm air", "warm tires on a cold vehicle",
                            "20 min at 120 km/h, then at once 80 km/h"};
    return info;
  }

  template <class S>
  static S calc_reference_K(const EffectView<S>& self) {
    return get_reference_temperature_K<S>() + self.parameter(kRise) +
           self.parameter(kReferenceShift);  // ISO 28580: 25 degC
  }

  template <class S>
  static void initial(const EffectView<S>& self, const InitialPort<S>& port, S* states) {
    states[kTemperature] = port.tire_temperature_K;
    if (port.started_warm) states[kTemperature] += self.parameter(kRise);
  }

  template <class S>
  static void loss(const EffectView<S>& self, const Instant<S>&, LossPort<S>& port) {
    using std::exp;
    port.factor *= exp(-self.parameter(kFall) * (self.state(kTemperature) - calc_reference_K(self)));
  }

  template <class S>
  static void rates(const EffectView<S>& self, const Instant<S>& now, S* rates) {
    using std::abs;
    const TireParameters<S>& tire = now.context->tire;
    const S reference_m_s = get_reference_speed_m_s<S>();
    const S standing_m_s = tire.thermal.rest_conductance_W_per_K / tire.thermal.speed_conductance_W_s_per_m_K;
    const S speed_m_s = abs(now.motion.speed_m_s);
    const S heat = now.loss.factor * (speed_m_s / reference_m_s) *
                   (positive_part(now.motion.load_N) / tire.rolling_resistance.reference_load_N);
    const S cooling = (standing_m_s + speed_m_s) / (standing_m_s + reference_m_s);
    const S over_air_K = self.state(kTemperature) - now.acting.ambient_K;
    rates[kTemperature] = (self.parameter(kRise) * heat - cooling * over_air_K) / self.parameter(kWarmUp);
  }
};

const Effect& effect() { return make_effect<TireTemperature>(); }

}  // namespace rollrig::models::tire_temperature
