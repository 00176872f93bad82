/// The bearings of the rig run easier as they warm.
#include "models/effect.h"
#include "models/reference_conditions.h"

namespace rollrig::models::bearing_warmup {

struct BearingWarmup {
  enum Parameter { kFall, kTimeConstant, kRise, kReference, kQuadraticShare };
  enum State { kBearingRise };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "bearing_warmup";
    info.summary =
        "The rig's bearings warm as it runs, and their part of the parasitic loss, or all of it, falls with their "
        "temperature";
    info.equation =
        "F_par <- c0 + c1 v + c2 v^2 - (1 - u)(c0 + c1 v + h c2 v^2), u = exp(-b (T_amb + theta - T_0 - r D)); tau "
        "d(theta)/dt = D x f exp(b (D - theta)) - (1 - a + a x) theta, theta = T_b - T_amb, x = v/v_ref, v_ref = 80 "
        "km/h, f = (c0 + c1 v)/(c0 + c1 v_ref), T_0 = 25 degC, a = 0.4";
    info.source =
        "Kolekar and Narasimhan (2024) §4.1.7, §5.2. Assumed: b 0.005 to 0.04 /K and 10 to 60 min, where h = 1; D; "
        "heating by the bearings' own friction power; h, of the quadratic term, from 0 (air drag, which does not feel "
        "the grease) to 1; a, of the cooling, by air that the drum moves; the exponent of the heating levels off at 3; "
        "r = 1: parasitic coefficients taken on a warm rig. Not soaked: warm before the rest";
    info.parameters = {
        {"fall_per_K",
         between(-0.2, 0.2),
         {0.005, 0.04, Prior::Scale::kLog},
         "b, relative fall with bearing temperature",
         0.0},
        {"time_constant_min", between(0.5, 600.0), {10.0, 60.0, Prior::Scale::kLog}, "tau, of the bearings' warm-up"},
        {"rise_dK",
         between(0.1, 100.0),
         {8.0, 25.0, Prior::Scale::kLog},
         "D, rise over ambient in steady running at 80 km/h"},
        {"reference_share",
         between(-1.0, 2.0),
         {0.5, 1.5},
         "r: c0, c1, c2 hold at the rise r D over T_0; 1 = on a warm rig, 0 = cold"},
        {"quadratic_share", between(-0.5, 2.0), {0.2, 1.0}, "h, of the quadratic term, that falls as well"}};
    info.states = {{"bearing_rise_dK", 10.0, "theta, bearing temperature over ambient"}};
    info.acts_on = &is_indoors;
    info.visible_in = {quantities::kMachineForce};
    info.clean_in = {quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"torque_zero_drift", "tire_loss_in_skim"};
    info.splitting_tests = {"drum alone for 30 min, then a cold tire on the hot drum",
                            "torque at standstill before and after"};
    return info;
  }

  template <class S>
  static void initial(const EffectView<S>& self, const InitialPort<S>& port, S* states) {
    states[kBearingRise] = calc_rise_at_start(port, self.parameter(kRise), self.parameter(kTimeConstant));
  }

  template <class S>
  static void parasitic(const EffectView<S>& self, const Instant<S>& now, ParasiticPort<S>& port) {
    using std::abs;
    using std::exp;
    const S reference_K = get_reference_temperature_K<S>();
    const S over_reference_dK = now.recorded.ambient_K - reference_K + self.state(kBearingRise) -
                                self.parameter(kReference) * self.parameter(kRise);
    const ParasiticParameters<S>& loss = now.context->parasitic;
    const S all_N = calc_parasitic_N(loss, S(abs(now.motion.speed_m_s)));
    if (value_of(all_N) <= 0.0) return;
    const S air_N = all_N - calc_bearing_N(loss, S(abs(now.motion.speed_m_s)));
    const S share = S(1.0) - (S(1.0) - self.parameter(kQuadraticShare)) * air_N / all_N;
    const S fallen = S(1.0) - exp(-self.parameter(kFall) * over_reference_dK);
    port.factor *= positive_part(S(S(1.0) - fallen * share));
  }

  template <class S>
  static void rates(const EffectView<S>& self, const Instant<S>& now, S* rates) {
    using std::abs;
    using std::exp;
    using std::tanh;
    constexpr double kForced = 0.4;
    constexpr double kMost = 3.0;
    const S speed_ratio = abs(now.motion.speed_m_s) / get_reference_speed_m_s<S>();
    const S& steady_dK = self.parameter(kRise);
    const S& rise_dK = self.state(kBearingRise);
    const S thinner = kMost * tanh(self.parameter(kFall) * (steady_dK - rise_dK) / kMost);
    const S heating_dK = steady_dK * speed_ratio * calc_friction_ratio(now) * exp(thinner);
    const S cooling_dK = (S(1.0 - kForced) + kForced * speed_ratio) * rise_dK;
    rates[kBearingRise] = (heating_dK - cooling_dK) / self.parameter(kTimeConstant);
  }

 private:
  template <class S>
  static S calc_bearing_N(const ParasiticParameters<S>& loss, const S& speed_m_s) {
    return loss.c0_N + loss.c1_N_s_per_m * speed_m_s;
  }

  /// Friction of the bearings over that at 80 km/h.
  template <class S>
  static S calc_friction_ratio(const Instant<S>& now) {
    using std::abs;
    const S at_reference_N = calc_bearing_N(now.context->parasitic, get_reference_speed_m_s<S>());
    if (value_of(at_reference_N) <= 0.0) return S(1.0);
    return calc_bearing_N(now.context->parasitic, S(abs(now.motion.speed_m_s))) / at_reference_N;
  }
};

const Effect& effect() { return make_effect<BearingWarmup>(); }

}  // namespace rollrig::models::bearing_warmup
