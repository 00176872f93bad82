/// The cavity of the tire becomes smaller under load and larger with speed.
#include "models/effect.h"

namespace rollrig::models::cavity_volume {

struct CavityVolume {
  enum Parameter { kContraction, kLoadPower, kGrowth, kSetting };
  enum State { kFelt };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "cavity_volume";
    info.summary =
        "The deflection at the contact makes the cavity smaller, the centrifugal force makes it larger: the pressure "
        "steps with load and speed";
    info.equation =
        "V/V_0 = w = 1 - e ((Fz/Fz_ref)^m - l - q (v/v_1)^2), v_1 = 120 km/h; a change of volume warms or cools the "
        "gas by dT/T = -(kappa - 1) dw, which goes into the rubber: p ~ T_gas (1 - (kappa - 1) (w - w_f))/w, dw_f/dt "
        "= (w - w_f) H/C_gas";
    info.source =
        "Assumed: e up to 1 %, as the contact presses in some 0.4 l of 40 l; m about 1, q up to 1, the square "
        "(centrifugal force), l from 0 (pressure set on the lifted wheel) to 1 (on the loaded one). Heat of "
        "compression: ideal gas, kappa = 1.4; what it heats the rubber by is nothing beside the rubber's own loss. "
        "The run starts in equilibrium under its first load, at rest";
    info.parameters = {
        {"contraction_percent",
         between(-5.0, 10.0),
         {0.1, 1.0, Prior::Scale::kLog},
         "e, of the volume, from no load to the reference load",
         0.0},
        {"load_power", between(0.3, 3.0), {0.8, 1.5}, "m, of the load"},
        {"growth_ratio", between(-2.0, 5.0), {0.1, 0.9}, "q, growth at 120 km/h relative to e"},
        {"setting_ratio", between(-2.0, 3.0), {0.0, 1.0}, "l, contraction at which the pressure was set, of e"}};
    info.states = {{"felt_volume", 0.01, "w_f - 1, volume over that at filling that the gas has come to terms with"}};
    info.faint_on = &is_on_road;                      // one load, no pressure channel
    info.visible_in = {quantities::kCavityPressure};  // the loss follows by half a percent at most
    info.splitting_tests = {"load off and on at constant liner temperature, pressure logged",
                            "pressure at standstill at several loads"};
    return info;
  }

  /// w - 1.
  template <class S>
  static S calc_change(const EffectView<S>& self, const Context<S>& context, const S& load_N, const S& speed_m_s) {
    using std::pow;
    const S load_ratio = load_N / context.tire.rolling_resistance.reference_load_N;
    const S speed_ratio = speed_m_s / quantity<S>(120.0 / 3.6, dimension::kSpeed);
    const S pressed = value_of(load_ratio) > 0.0 ? S(pow(load_ratio, self.parameter(kLoadPower))) : S(0.0);
    const S contraction = pressed - self.parameter(kSetting) - self.parameter(kGrowth) * speed_ratio * speed_ratio;
    return -self.parameter(kContraction) * contraction;
  }

  template <class S>
  static void initial(const EffectView<S>& self, const InitialPort<S>& port, S* states) {
    states[kFelt] = calc_change(self, *port.context, port.load_N, quantity<S>(0.0, dimension::kSpeed));
  }

  template <class S>
  static void gas(const EffectView<S>& self, const Instant<S>& now, GasPort<S>& port) {
    constexpr double kKappaLessOne = 0.4;  // of a gas of two atoms
    const S change = calc_change(self, *now.context, now.motion.load_N, now.motion.speed_m_s);
    const S warmer = kKappaLessOne * (self.state(kFelt) - change);
    port.volume_ratio *= (S(1.0) + change) / (S(1.0) + warmer);
  }

  template <class S>
  static void rates(const EffectView<S>& self, const Instant<S>& now, S* rates) {
    const std::size_t gas = index_of(Node::kGas);
    const S change = calc_change(self, *now.context, now.motion.load_N, now.motion.speed_m_s);
    rates[kFelt] = (change - self.state(kFelt)) * now.thermal.link_W_per_K[index_of(Node::kLiner)][gas] /
                   now.thermal.heat_capacity_J_per_K[gas];
  }
};

const Effect& effect() { return make_effect<CavityVolume>(); }

}  // namespace rollrig::models::cavity_volume
