/// The air at the tire warms, which the thermometer of the test cell does not see.
#include "models/effect.h"
#include "models/reference_conditions.h"

namespace rollrig::models::cell_air_warming {

struct CellAirWarming {
  enum Parameter { kRise, kTimeConstant, kPower, kTireShare };
  enum State { kAirRise };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "cell_air_warming";
    info.summary =
        "While the rig turns, the air at the tire slowly becomes warmer than the recorded ambient, and with it a "
        "surface whose temperature is not recorded";
    info.equation =
        "T_amb <- T_amb + theta, tau d(theta)/dt = D (v/v_ref)^n (1 - s + s Fz/Fz_ref) - theta; v_ref = 80 km/h; at "
        "rest to 0";
    info.source =
        "Assumed: 1 to 6 K, slowly; first order, tau 20 to 120 min, n from 0 (whatever the speed, while it turns) to "
        "1, s from 0 (motor and drum warm the air) to 1 (the loaded tire does); in the cell of a drum or dynamometer, "
        "not on a road. Not soaked: warm before the rest";
    info.parameters = {
        {"rise_dK",
         between(-30.0, 60.0),
         {1.0, 6.0, Prior::Scale::kLog},
         "D, in steady rolling at 80 km/h and the reference load",
         0.0},
        {"time_constant_min", between(0.5, 1200.0), {20.0, 120.0, Prior::Scale::kLog}, "tau, of the air's warm-up"},
        {"power", between(0.0, 3.0), {0.0, 1.0}, "n, of the speed"},
        {"tire_share", between(-1.0, 2.0), {0.2, 0.9}, "s, of the heat, given off by the loaded tire"}};
    info.states = {{"air_rise_dK", 10.0, "theta, air at the tire over the recorded ambient"}};
    info.acts_on = &is_indoors;
    info.visible_in = {quantities::kMachineForce, quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"rim_heat", "slow_leak", "surface_warming"};
    info.splitting_tests = {"air temperature read beside the tire", "soak with temperature and pressure logged",
                            "setting gauge before and after, at one temperature"};
    return info;
  }

  template <class S>
  static void initial(const EffectView<S>& self, const InitialPort<S>& port, S* states) {
    states[kAirRise] = calc_rise_at_start(port, self.parameter(kRise), self.parameter(kTimeConstant));
  }

  template <class S>
  static void input(const EffectView<S>& self, const Instant<S>&, InputPort<S>& port) {
    port.ambient_K += self.state(kAirRise);
  }

  template <class S>
  static void rates(const EffectView<S>& self, const Instant<S>& now, S* rates) {
    using std::abs;
    using std::pow;
    const S reference_m_s = get_reference_speed_m_s<S>();
    const S speed_ratio = abs(now.motion.speed_m_s) / reference_m_s;
    const S& reference_N = now.context->tire.rolling_resistance.reference_load_N;
    const S given_off = S(1.0) + self.parameter(kTireShare) * (positive_part(now.motion.load_N) / reference_N - S(1.0));
    const bool turns = value_of(speed_ratio) > 0.0;
    const S aim_dK = turns ? S(self.parameter(kRise) * pow(speed_ratio, self.parameter(kPower)) * given_off)
                           : S(0.0 * self.parameter(kRise));
    rates[kAirRise] = (aim_dK - self.state(kAirRise)) / self.parameter(kTimeConstant);
  }
};

const Effect& effect() { return make_effect<CellAirWarming>(); }

}  // namespace rollrig::models::cell_air_warming
