#pragma once
/// Parts of which tire models are made: the source's law of the loss, and the rubber as one node or two.

#include "models/tire/rolling_resistance.h"
#include "models/tire/tire_model.h"

namespace rollrig::models {

/// The law of rolling_resistance.h at the temperature of the loss port.
struct CombinedLaw {
  template <class S>
  static S calc_loss_N(const Instant<S>& now) {
    using std::abs;
    return calc_rolling_resistance_N(now.context->tire, S(abs(now.motion.speed_m_s)), now.motion.load_N,
                                     now.pressure_Pa, now.loss.temperature_K);
  }
};

/// All of the rubber has one temperature.
/// Equation  C dT/dt = Q - ((1 - s) z + (1 - s_v) f v) (T - T_amb) - (s z + s_v f v) (T - T_surface) - H (T - T_gas),
///           C_gas dT_gas/dt = H (T - T_gas)
/// Symbols   T, T_gas temperatures of rubber and gas [K], Q heat that arises in the tire [W], C, C_gas heat capacities
///           [J/K], z conductance at rest [W/K], f per speed [W s/(m K)], s, s_v the road's shares of both, v speed
///           that carries heat off the tire [m/s], H between rubber and gas [W/K]
/// Validity  what moves the air by another law than v (effect convection_law) acts on the road's share of f v as well
/// Source    (3.8) to (3.13), (3.17); heat to the rim is left out (§3.3.2.1)
/// Checked   tests/models/corner_test.cpp
struct OneNode {
  template <class S>
  static S find_loss_temperature_K(const TireParameters<S>&, const ThermalNetwork<S>& network) {
    return network.temperature_K[index_of(Node::kLiner)];
  }

  template <class S>
  static void fill_network(const Instant<S>& now, ThermalNetwork<S>& network) {
    const std::size_t rubber = index_of(Node::kLiner);
    network.heat_capacity_J_per_K[rubber] = now.context->tire.thermal.heat_capacity_J_per_K;
    fill_cooling(now, Node::kLiner, network);
  }

  template <class S>
  static void add_heat(const TireParameters<S>&, HeatSource, const S& heat_W, ThermalNetwork<S>& network) {
    network.heat_W[index_of(Node::kLiner)] += heat_W;
  }

 protected:
  /// What every tire has: the gas behind the liner, and the node that faces air and road.
  template <class S>
  static void fill_cooling(const Instant<S>& now, Node outside, ThermalNetwork<S>& network) {
    const TireThermalParameters<S>& thermal = now.context->tire.thermal;
    const S& to_road = thermal.road_share_of_rest_conductance;
    const S by_speed_W_per_K = thermal.speed_conductance_W_s_per_m_K * now.boundary.air_speed_m_s;
    const S by_speed_to_road_W_per_K = thermal.road_share_of_speed_conductance * by_speed_W_per_K;
    network.heat_capacity_J_per_K[index_of(Node::kGas)] = thermal.gas_heat_capacity_J_per_K;
    network.road_W_per_K[index_of(outside)] = to_road * thermal.rest_conductance_W_per_K + by_speed_to_road_W_per_K;
    network.air_W_per_K[index_of(outside)] =
        (S(1.0) - to_road) * thermal.rest_conductance_W_per_K + (by_speed_W_per_K - by_speed_to_road_W_per_K);
    network.link(Node::kLiner, Node::kGas) = thermal.H_gas_W_per_K;
  }
};

/// Tread and carcass have temperatures of their own.
/// Equation  c C dT_t/dt = h Q + P - (z + f v)(T_t - T_amb) - G (T_t - T_c),
///           (1 - c) C dT_c/dt = (1 - h) Q + G (T_t - T_c) - H (T_c - T_gas); loss seen at T = m T_t + (1 - m) T_c
/// Symbols   T_t, T_c temperatures of tread and carcass, where the liner's sensor sits [K]; c, h, m shares of the tread
///           [1]; Q heat of rolling resistance, P friction of the contact [W]; G between both [W/K]; the rest as above
/// Validity  the road's shares of z and f act on T_t - T_surface
/// Checked   tests/models/two_node_test.cpp
struct TreadAndCarcass : OneNode {
  /// Places of its numbers, which stand before others of a model.
  enum Parameter { kCapacityShare, kHeatShare, kLossShare, kConductance, kCount };

  // Assumed: usual values of passenger-car tires, the tread with its belts. Masses of the parts are weighed or read
  // off a section; what arises where and flows between them is fitted at best.
  static std::vector<TireModelParameter> parameters() {
    return {
        {{"tread_share_of_heat_capacity", between(0.01, 0.99), "c, of the rubber's heat capacity that is the tread's"},
         0.45,
         0.1},
        {{"tread_share_of_heat", between(0.0, 1.0), "h, of the heat of rolling resistance that arises in the tread"},
         0.7,
         0.2},
        {{"tread_share_of_loss", between(0.0, 1.0), "m, weight of the tread in the temperature that the loss follows"},
         0.7,
         0.2},
        {{"conductance_W_per_K", positive(), "G, between tread and carcass"}, 60.0, 0.3}};
  }

  template <class S>
  static S find_loss_temperature_K(const TireParameters<S>& tire, const ThermalNetwork<S>& network) {
    const S& carcass_K = network.temperature_K[index_of(Node::kLiner)];
    return carcass_K + tire.own[kLossShare] * (network.temperature_K[index_of(Node::kTread)] - carcass_K);
  }

  template <class S>
  static void fill_network(const Instant<S>& now, ThermalNetwork<S>& network) {
    const TireParameters<S>& tire = now.context->tire;
    const S tread_J_per_K = tire.own[kCapacityShare] * tire.thermal.heat_capacity_J_per_K;
    network.heat_capacity_J_per_K[index_of(Node::kTread)] = tread_J_per_K;
    network.heat_capacity_J_per_K[index_of(Node::kLiner)] = tire.thermal.heat_capacity_J_per_K - tread_J_per_K;
    network.link(Node::kLiner, Node::kTread) = tire.own[kConductance];
    fill_cooling(now, Node::kTread, network);
  }

  template <class S>
  static void add_heat(const TireParameters<S>& tire, HeatSource source, const S& heat_W, ThermalNetwork<S>& network) {
    const S tread_W = source == HeatSource::kFriction ? heat_W : S(tire.own[kHeatShare] * heat_W);
    network.heat_W[index_of(Node::kTread)] += tread_W;
    network.heat_W[index_of(Node::kLiner)] += heat_W - tread_W;
  }
};

}  // namespace rollrig::models
