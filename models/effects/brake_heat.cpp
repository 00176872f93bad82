/// Heat of the brakes reaches the tire through the rim.
#include "models/effect.h"

namespace rollrig::models::brake_heat {

struct BrakeHeat {
  enum Parameter { kShare, kTimeConstant, kDisc, kGasShare, kDiscShare };
  enum State { kInDisc, kInRim };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "brake_heat";
    info.summary = "A share of the friction brake's power reaches the tire, late, through the rim";
    info.equation =
        "P = w F_brake |v|; dD/dt = d P - D/tau_d, Q = (1 - d) P + D/tau_d, dE/dt = Q - E/tau; (1 - g) E/tau heats "
        "the liner's side, g E/tau the gas: D and E are the heat in disc and rim that is bound for the tire, tau = "
        "C_rim/(UA + UA_air). With a rim node linked to the tire (rim_heat), Q (1 + UA_air/UA) goes into that node "
        "instead, of which Q reaches tire and gas in the end";
    info.source =
        "Kolekar and Narasimhan (2024) §4.2.2, §4.4.1: brakes left out. No tire model has heat to the rim, so E counts "
        "what the brake adds to a rim that else exchanges nothing. Assumed: w, since most of a disc's heat goes "
        "straight to the air; a rim of 6 to 10 kg of light alloy, UA 0.5 to 4 W/K and UA_air 4 to 30 W/K (0.5 m2 in "
        "moving air), hence tau 3 to 30 min; tau_d, a disc of 3 to 6 kJ/K that loses 10 to 40 W/K to rim and air; g, "
        "the rim's well faces the gas, its beads the liner's side of the rubber; 1 - d, what pads and hot air give to "
        "the rim at once";
    info.parameters = {
        {"share_percent", between(0.0, 100.0), {2.0, 15.0, Prior::Scale::kLog}, "w, of the brake's power", 0.0},
        {"time_constant_min", between(0.5, 600.0), {3.0, 30.0, Prior::Scale::kLog}, "tau, of the rim"},
        {"disc_min", between(0.2, 60.0), {1.5, 6.0, Prior::Scale::kLog}, "tau_d, of the disc"},
        {"gas_share", between(0.0, 1.0), {0.1, 0.5}, "g, of the heat, that goes into the gas"},
        {"disc_share", between(0.0, 1.0), {0.3, 1.0}, "d, of the heat, that goes through the disc"}};
    info.states = {{"disc_heat_kJ", 1e4, "D, heat in the disc on its way to the tire"},
                   {"rim_heat_kJ", 1e4, "E, heat in the rim on its way to the tire"}};
    info.acts_on = &is_of_vehicle;
    info.faint_on = &is_on_road;  // a few K move the loss by less than a thousandth of what accelerating takes
    info.visible_in = {quantities::kMachineForce, quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"rim_heat"};
    info.splitting_tests = {"the same cycle with and without friction brakes", "rim thermocouple"};
    return info;
  }

  /// Brake power of which the tire gets all in the end.
  template <class S>
  static S calc_bound_for_tire_W(const EffectView<S>& self, const Instant<S>& now) {
    using std::abs;
    return self.parameter(kShare) * now.acting.brake_force_N * abs(now.motion.speed_m_s);
  }

  /// Q, of that, what comes to the rim now.
  template <class S>
  static S calc_into_rim_W(const EffectView<S>& self, const Instant<S>& now) {
    const S at_once = S(1.0) - self.parameter(kDiscShare);
    return at_once * calc_bound_for_tire_W(self, now) + self.state(kInDisc) / self.parameter(kDisc);
  }

  /// Conductance between the rim and the tire, gas included; 0 without a rim.
  template <class S>
  static S calc_rim_link_W_per_K(const ThermalPort<S>& port) {
    const std::size_t rim = index_of(Node::kRim);
    if (!port.active[rim]) return zero<S>();
    return port.link_W_per_K[index_of(Node::kLiner)][rim] + port.link_W_per_K[index_of(Node::kGas)][rim];
  }

  template <class S>
  static void thermal(const EffectView<S>& self, const Instant<S>& now, ThermalPort<S>& port) {
    const std::size_t rim = index_of(Node::kRim);
    const S into_rim_W = calc_into_rim_W(self, now);
    const S arriving_W = self.state(kInRim) / self.parameter(kTimeConstant);
    port.heat_W[index_of(Node::kLiner)] += (S(1.0) - self.parameter(kGasShare)) * arriving_W;
    port.heat_W[index_of(Node::kGas)] += self.parameter(kGasShare) * arriving_W;
    port.under_way_J += self.state(kInDisc) + self.state(kInRim);
    port.under_way_W += calc_bound_for_tire_W(self, now) - arriving_W;
    const S link_W_per_K = calc_rim_link_W_per_K(port);
    if (value_of(link_W_per_K) > 0.0) {
      port.heat_W[rim] += into_rim_W * (S(1.0) + port.air_W_per_K[rim] / link_W_per_K);
      port.under_way_W -= into_rim_W;
    }
  }

  template <class S>
  static void rates(const EffectView<S>& self, const Instant<S>& now, S* rates) {
    const S into_rim_W = calc_into_rim_W(self, now);
    rates[kInDisc] = calc_bound_for_tire_W(self, now) - into_rim_W;  // d P - D/tau_d
    rates[kInRim] = -self.state(kInRim) / self.parameter(kTimeConstant);
    const bool has_linked_rim = value_of(calc_rim_link_W_per_K(now.thermal)) > 0.0;
    if (!has_linked_rim) rates[kInRim] += into_rim_W;
  }
};

const Effect& effect() { return make_effect<BrakeHeat>(); }

}  // namespace rollrig::models::brake_heat
