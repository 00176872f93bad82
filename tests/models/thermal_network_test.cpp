#include "models/tire/thermal_network.h"

#include <catch2/catch.hpp>

using namespace rollrig;
using models::Node;
using Network = models::ThermalNetwork<double>;

namespace {
Network four_nodes() {
  Network network;
  network.active = {true, true, true, true};
  network.temperature_K = {310.0, 305.0, 320.0, 300.0};
  network.heat_capacity_J_per_K = {18000.0, 95.0, 9000.0, 7000.0};
  network.heat_W = {500.0, 0.0, 200.0, 30.0};
  network.air_W_per_K = {10.0, 0.0, 20.0, 3.0};
  network.road_W_per_K = {5.0, 0.0, 2.0, 0.0};
  network.link(Node::kLiner, Node::kGas) = 4.0;
  network.link(Node::kTread, Node::kLiner) = 60.0;
  network.link(Node::kGas, Node::kRim) = 2.0;
  return network;
}
}  // namespace

TEST_CASE("heat in is stored or carried out, whatever the network", "[fast]") {
  const Network network = four_nodes();
  const auto flows = models::calc_heat_flows(network, 298.0, 303.0);
  double stored_W = 0.0;
  for (std::size_t i = 0; i < models::kNodeCount; ++i) {
    stored_W += network.heat_capacity_J_per_K[i] * flows.temperature_rate_K_s[i];
  }
  CHECK(stored_W + flows.to_air_W + flows.to_road_W == Approx(flows.heat_in_W).epsilon(1e-13));
  CHECK(flows.heat_in_W == 730.0);
}

TEST_CASE("in equilibrium with its surroundings nothing flows", "[fast]") {
  Network network = four_nodes();
  network.temperature_K = {300.0, 300.0, 300.0, 300.0};
  network.heat_W = {};
  const auto flows = models::calc_heat_flows(network, 300.0, 300.0);
  for (const double rate : flows.temperature_rate_K_s) CHECK(rate == 0.0);
}

TEST_CASE("heat flows from warm to cold, and a link is the same from both sides", "[fast]") {
  Network network;
  network.temperature_K = {310.0, 300.0, 0.0, 0.0};
  network.heat_capacity_J_per_K = {100.0, 50.0, 0.0, 0.0};
  network.link(Node::kGas, Node::kLiner) = 5.0;
  const auto flows = models::calc_heat_flows(network, 290.0, 290.0);
  CHECK(flows.temperature_rate_K_s[0] == Approx(-0.5));  // 50 W over 100 J/K
  CHECK(flows.temperature_rate_K_s[1] == Approx(1.0));
}

TEST_CASE("a node that is not there takes no part", "[fast]") {
  Network network = four_nodes();
  network.active[models::index_of(Node::kRim)] = false;
  const auto flows = models::calc_heat_flows(network, 298.0, 303.0);
  CHECK(flows.heat_in_W == 700.0);
  CHECK(flows.temperature_rate_K_s[models::index_of(Node::kRim)] == 0.0);
}
