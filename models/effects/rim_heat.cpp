/// The rim takes heat from tire and gas, and gives it to the air.
#include "models/effect.h"

namespace rollrig::models::rim_heat {

struct RimHeat {
  enum Parameter { kConductance, kGasShare, kCapacity, kAirRatio };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "rim_heat";
    info.summary = "Tire and gas give heat to the rim, which stores it and gives it to the air, faster with speed";
    info.equation =
        "C_rim dT_rim/dt = (1 - g) U (T - T_rim) + g U (T_gas - T_rim) - r a (T_rim - T_amb); a: what the tire has to "
        "the air at that speed, (1 - road share) z + f v";
    info.source =
        "Kolekar and Narasimhan (2024) §3.3.2.1 leaves the rim out. Assumed: U of two bead seats and of gas at the "
        "well; 6 to 10 kg of light alloy; g about a half (bead seats, well of the rim), r: 4 to 30 W/K of 0.5 m2 in "
        "moving air, with the part that goes with speed as large as the tire's; the rim starts at the tire's "
        "temperature";
    info.parameters = {{"conductance_W_per_K",
                        between(0.0, 100.0),
                        {0.5, 4.0, Prior::Scale::kLog},
                        "U, from rubber and gas to the rim in all",
                        0.0},
                       {"gas_share", between(0.0, 1.0), {0.25, 0.75}, "g, of U that is from the gas"},
                       {"heat_capacity_kJ_per_K", between(0.5, 100.0), {5.0, 9.0}, "C_rim"},
                       {"air_ratio",
                        between(0.0, 20.0),
                        {0.15, 0.8, Prior::Scale::kLog},
                        "r, conductance of the rim to the air, relative to the tire's; of f v, all counts"}};
    info.nodes[index_of(Node::kRim)] = true;
    info.faint_on = &is_on_road;  // some K cooler costs a few parts in a thousand of what accelerating takes
    info.visible_in = {quantities::kMachineForce, quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"cell_air_warming", "rubber_memory", "gas_heat_transfer"};
    info.splitting_tests = {"rim thermocouple", "soak with temperature and pressure logged",
                            "load off and on at constant liner temperature"};
    return info;
  }

  /// Without conductance the rim goes its own way, unfelt, so that derivatives by it are right there. The rim touches
  /// no road: of the tire's f v the road's share counts as well.
  template <class S>
  static void thermal(const EffectView<S>& self, const Instant<S>& now, ThermalPort<S>& port) {
    const TireThermalParameters<S>& tire = now.context->tire.thermal;
    const S by_speed_to_road_W_per_K =
        tire.road_share_of_speed_conductance * tire.speed_conductance_W_s_per_m_K * now.boundary.air_speed_m_s;
    const std::size_t rim = index_of(Node::kRim);
    const S& all_W_per_K = self.parameter(kConductance);
    const S& gas_share = self.parameter(kGasShare);
    port.heat_capacity_J_per_K[rim] += self.parameter(kCapacity);
    port.air_W_per_K[rim] += self.parameter(kAirRatio) * (port.calc_tire_air_W_per_K() + by_speed_to_road_W_per_K);
    port.link(Node::kLiner, Node::kRim) += (S(1.0) - gas_share) * all_W_per_K;
    port.link(Node::kGas, Node::kRim) += gas_share * all_W_per_K;
  }
};

const Effect& effect() { return make_effect<RimHeat>(); }

}  // namespace rollrig::models::rim_heat
