/// Heat of the brakes reaches the tire through the rim.
#include "models/effect.h"

namespace rollrig::models {
namespace {

struct BrakeHeat {
  enum Parameter { kShare, kTimeConstant };
  enum State { kOnItsWay };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "brake_heat";
    info.summary = "A share of the friction brake's power reaches the tire, late, through the rim";
    info.equation =
        "dE/dt = w F_brake |v| - E/tau, E/tau heats the rubber: E is the heat in the rim that is bound for the "
        "tire, tau = C_rim/(UA + UA_air). With a rim node linked to the tire (rim_heat), w F_brake |v| (1 + "
        "UA_air/UA) goes into that node instead, of which w F_brake |v| reaches rubber and gas in the end";
    info.source =
        "source §4.2.2, §4.4.1: brakes left out; 2 to 15 % reaches the tire, rim 5 to 9 kJ/K, UA 0.5 to 4 W/K: "
        "effects.md. The baseline has no heat to the rim, so E counts what the brake adds to a rim that else "
        "exchanges nothing. Assumed: UA_air 4 to 30 W/K (0.5 m2 in moving air), hence tau 3 to 30 min";
    info.parameters = {
        {"share_percent", between(0.0, 100.0), {2.0, 15.0, Prior::Scale::kLog}, "w, of the brake's power", 0.0},
        {"time_constant_min", between(0.5, 600.0), {3.0, 30.0, Prior::Scale::kLog}, "tau, of the rim"}};
    info.states = {{"rim_heat_kJ", 1e4, "E, heat in the rim on its way to the tire"}};
    info.acts_on = {RigKind::kDyno, RigKind::kFlat};
    info.faint_on = {RigKind::kFlat};  // a few K move the loss by less than a thousandth of what accelerating takes
    info.visible_in = {"loss_force_N", "traction_force_N", "liner_temperature_degC", "cavity_pressure_kPa"};
    info.confused_with = {"rim_heat"};
    info.splitting_tests = {"the same cycle with and without friction brakes", "rim thermocouple"};
    return info;
  }

  /// Heat into the rim of which the tire gets all (own delay), or a part (rim node).
  template <class S>
  static S calc_bound_for_tire_W(const EffectView<S>& self, const Instant<S>& now) {
    using std::abs;
    return self.parameter(kShare) * now.acting.brake_force_N * abs(now.motion.speed_m_s);
  }

  /// Conductance between the rim and the tire, gas included; 0 without a rim.
  template <class S>
  static S calc_rim_link_W_per_K(const ThermalPort<S>& port) {
    const std::size_t rim = index_of(Node::kRim);
    if (!port.active[rim]) return zero<S>();
    return port.link_W_per_K[index_of(Node::kRubber)][rim] + port.link_W_per_K[index_of(Node::kGas)][rim];
  }

  template <class S>
  static void thermal(const EffectView<S>& self, const Instant<S>& now, ThermalPort<S>& port) {
    const std::size_t rim = index_of(Node::kRim);
    const S bound_W = calc_bound_for_tire_W(self, now);
    const S arriving_W = self.state(kOnItsWay) / self.parameter(kTimeConstant);
    port.heat_W[index_of(Node::kRubber)] += arriving_W;
    port.under_way_J += self.state(kOnItsWay);
    port.under_way_W -= arriving_W;
    const S link_W_per_K = calc_rim_link_W_per_K(port);
    if (value_of(link_W_per_K) > 0.0) {
      port.heat_W[rim] += bound_W * (S(1.0) + port.air_W_per_K[rim] / link_W_per_K);
    } else {
      port.under_way_W += bound_W;
    }
  }

  template <class S>
  static void rates(const EffectView<S>& self, const Instant<S>& now, S* rates) {
    rates[kOnItsWay] = -self.state(kOnItsWay) / self.parameter(kTimeConstant);
    const bool has_linked_rim = value_of(calc_rim_link_W_per_K(now.thermal)) > 0.0;
    if (!has_linked_rim) rates[kOnItsWay] += calc_bound_for_tire_W(self, now);
  }
};

}  // namespace

const Effect& effect_brake_heat() {
  static const Effect effect = make_effect<BrakeHeat>();
  return effect;
}

}  // namespace rollrig::models
