/// Oil and bearings of the vehicle run easier as they warm.
#include "models/effect.h"
#include "models/reference_conditions.h"

namespace rollrig::models::driveline_warming {

struct DrivelineWarming {
  enum Parameter { kForce, kTimeConstant, kFall, kAmbientShare, kDryShare };
  enum State { kRise };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "driveline_warming";
    info.summary = "Cold oil and bearings of the vehicle cost a force that falls as they warm; force of one wheel";
    info.equation =
        "F_par <- F_par + F_c (g + (1 - g) exp(-k (w + a (T_amb - T_0)/D))), tau dw/dt = (v/v_ref) exp(k (1 - w)) - w; "
        "w rise of the oil, relative to that in steady driving at v_ref = 80 km/h, T_0 = 25 degC, D = 30 K";
    info.source =
        "viscosity of oil falls exponentially with temperature (Reynolds). Assumed: 3 to 25 N, 15 to 60 min; k; "
        "heating by the friction itself, whose exponent levels off at 3 there; D; a, between 0 (warmed to a "
        "temperature that the air does not matter to) and 1; g, of seals and gears, up to a quarter. Not soaked: warm "
        "before the rest";
    info.parameters = {
        {"force_N", between(-100.0, 200.0), {3.0, 25.0, Prior::Scale::kLog}, "F_c, of one wheel, cold at 25 degC", 0.0},
        {"time_constant_min", between(0.5, 600.0), {15.0, 60.0, Prior::Scale::kLog}, "tau, of the oil's warm-up"},
        {"fall", between(0.0, 10.0), {0.7, 2.5, Prior::Scale::kLog}, "k, exponent of the fall by w = 1"},
        {"ambient_share", between(-1.0, 3.0), {0.0, 0.2}, "a, of the air's temperature that the oil takes on"},
        {"dry_share", between(-0.5, 0.9), {0.0, 0.2}, "g, of the cold force, that does not feel the oil"}};
    info.states = {{"oil_rise", 1.0, "w, rise of the oil's temperature over ambient, relative"}};
    info.acts_on = &is_of_vehicle;
    info.visible_in = {quantities::kMachineForce};
    info.clean_in = {quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"bearing_warmup"};
    info.splitting_tests = {"rollers alone, warm, then the cold vehicle on them",
                            "vehicle with warm oil on cold tires"};
    return info;
  }

  template <class S>
  static void initial(const EffectView<S>& self, const InitialPort<S>& port, S* states) {
    states[kRise] = calc_rise_at_start(port, S(1.0), self.parameter(kTimeConstant));
  }

  template <class S>
  static void parasitic(const EffectView<S>& self, const Instant<S>& now, ParasiticPort<S>& port) {
    using std::exp;
    const S warmer_dK = now.recorded.ambient_K - get_reference_temperature_K<S>();
    const S usual_dK = quantity<S>(30.0, dimension::kTemperature);
    const S relative = self.state(kRise) + self.parameter(kAmbientShare) * warmer_dK / usual_dK;
    const S& dry = self.parameter(kDryShare);
    port.extra_force_N += self.parameter(kForce) * (dry + (S(1.0) - dry) * exp(-self.parameter(kFall) * relative));
  }

  template <class S>
  static void rates(const EffectView<S>& self, const Instant<S>& now, S* rates) {
    using std::abs;
    using std::exp;
    using std::tanh;
    constexpr double kMost = 3.0;
    const S speed_ratio = abs(now.motion.speed_m_s) / get_reference_speed_m_s<S>();
    const S thicker = kMost * tanh(self.parameter(kFall) * (S(1.0) - self.state(kRise)) / kMost);
    const S friction_ratio = exp(thicker);  // to that at w = 1
    rates[kRise] = (speed_ratio * friction_ratio - self.state(kRise)) / self.parameter(kTimeConstant);
  }
};

const Effect& effect() { return make_effect<DrivelineWarming>(); }

}  // namespace rollrig::models::driveline_warming
