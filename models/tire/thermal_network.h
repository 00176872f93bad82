#pragma once
/// Lumped thermal network of tire, gas and what effects add: nodes, heat into them, conductances.

#include <array>
#include <cstddef>

#include "sim/core/scalar.h"

namespace rollrig::models {

/// Nodes by what they are, so that effects and sensors find them in every tire. Each tire has the gas and the liner's
/// side of the rubber (all of it in a model with one node), which the sensor reads and which faces gas and rim. Tread
/// and rim exist where the tire's model has them or an effect asks for them. The further ones are for models alone.
enum class Node : std::size_t { kLiner, kGas, kTread, kRim, kFurther1, kFurther2 };
constexpr std::size_t kNodeCount = 6;

/// Kinds of heat that arise in a tire; its model says in which nodes.
enum class HeatSource { kHysteresis, kFriction };

constexpr std::size_t index_of(Node node) { return static_cast<std::size_t>(node); }

/// Which nodes a tire has.
using NodeSet = std::array<bool, kNodeCount>;

template <class S>
struct ThermalNetwork {
  template <class T>
  using PerNode = std::array<T, kNodeCount>;

  NodeSet active{true, true};
  PerNode<S> temperature_K{};
  PerNode<S> heat_capacity_J_per_K{};
  PerNode<S> heat_W{};                 // generated in the node or brought into it
  PerNode<S> air_W_per_K{};            // conductance to the ambient air
  PerNode<S> road_W_per_K{};           // conductance to the surface
  PerNode<PerNode<S>> link_W_per_K{};  // between nodes, for a < b
  S under_way_J{};                     // heat generated that an effect's own state still holds back from a node
  S under_way_W{};                     // its rate of change

  S& link(Node a, Node b) {
    const std::size_t i = index_of(a);
    const std::size_t j = index_of(b);
    return i < j ? link_W_per_K[i][j] : link_W_per_K[j][i];
  }

  /// What all of the tire, without gas and rim, gives to the ambient air.
  S calc_tire_air_W_per_K() const {
    S sum = air_W_per_K[index_of(Node::kLiner)];
    for (const Node node : {Node::kTread, Node::kFurther1, Node::kFurther2}) {
      if (active[index_of(node)]) sum += air_W_per_K[index_of(node)];
    }
    return sum;
  }
};

/// What the network does at one instant.
template <class S>
struct HeatFlows {
  std::array<S, kNodeCount> temperature_rate_K_s{};
  S heat_in_W{};  // generated: into all nodes, and what is put under way
  S to_air_W{};
  S to_road_W{};
};

/// Heat balance of every node.
/// Equation  C_i dT_i/dt = Q_i - a_i (T_i - T_amb) - r_i (T_i - T_surface) - sum_j G_ij (T_i - T_j)
/// Symbols   C heat capacity [J/K], Q heat generated [W], a, r conductance to air and road [W/K],
///           G conductance between nodes [W/K], T temperatures [K]
/// Energy    sum C_i dT_i/dt + dE/dt = heat_in - to_air - to_road, exactly; E heat under way [J]
/// Source    (3.12), (3.13), (3.19)
/// Checked   tests/models/thermal_network_test.cpp
template <class S>
HeatFlows<S> calc_heat_flows(const ThermalNetwork<S>& network, const S& ambient_K, const S& surface_K) {
  HeatFlows<S> flows;
  flows.heat_in_W = network.under_way_W;
  std::array<S, kNodeCount>& net_W = flows.temperature_rate_K_s;
  for (std::size_t i = 0; i < kNodeCount; ++i) {
    if (!network.active[i]) continue;
    const S air_W = network.air_W_per_K[i] * (network.temperature_K[i] - ambient_K);
    const S road_W = network.road_W_per_K[i] * (network.temperature_K[i] - surface_K);
    flows.heat_in_W += network.heat_W[i];
    flows.to_air_W += air_W;
    flows.to_road_W += road_W;
    net_W[i] += network.heat_W[i] - air_W - road_W;
    for (std::size_t j = i + 1; j < kNodeCount; ++j) {
      if (!network.active[j]) continue;
      const S through_W = network.link_W_per_K[i][j] * (network.temperature_K[i] - network.temperature_K[j]);
      net_W[i] -= through_W;
      net_W[j] += through_W;
    }
    net_W[i] = net_W[i] / network.heat_capacity_J_per_K[i];  // all that flows into it is in
  }
  return flows;
}

}  // namespace rollrig::models
