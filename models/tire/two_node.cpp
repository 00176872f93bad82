/// Tread and carcass have temperatures of their own.
#include "models/tire/model_parts.h"

namespace rollrig::models {
namespace {

struct TwoNode : CombinedLaw, OneNode {
  enum Parameter { kCapacityShare, kHeatShare, kLossShare, kConductance };

  static TireModelInfo info() {
    TireModelInfo info;
    info.id = "two_node";
    info.summary =
        "As combined, but tread and carcass have temperatures of their own: the tread faces air and road, the "
        "carcass, on which the liner's sensor sits, faces gas and rim, and the loss follows both";
    info.equation =
        "c C dT_t/dt = h Q + P - (z + f v)(T_t - T_amb) - G (T_t - T_c), (1 - c) C dT_c/dt = (1 - h) Q + G (T_t - "
        "T_c) - H (T_c - T_gas); Q = F_rr v, P friction of the contact; F_rr of the model combined at T = m T_t + (1 "
        "- m) T_c; of z the road's share acts on T_t - T_surface; C, H, z, f: [thermal]";
    info.source =
        "Kolekar and Narasimhan (2024) (3.8) to (3.14), of whose one node (§3.3.2.1) these are two parts; tread, "
        "carcass and gas as bodies, with the heat of sliding in the tread: B. Shyrokau and D. Harsh, Tire model with "
        "temperature effects for Formula SAE vehicle, Applied Sciences 9 (2019) 5328, section 3.1. Assumed: the "
        "carcass gives heat to the outside through the tread alone, since most of the outer surface that moving air "
        "and road reach is the tread's; heat of rolling resistance in both, there in the carcass alone; T in "
        "proportion, since each part's loss follows its own temperature (then m = h)";
    info.nodes = {{Node::kLiner, "carcass"}, {Node::kTread, "tread"}};
    info.tables = {"rolling_resistance", "thermal"};
    // Assumed: usual values of passenger-car tires, the tread with its belts. Masses of the parts are weighed or read
    // off a section; what arises where and flows between them is fitted at best.
    info.parameters = {
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
    return info;
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

}  // namespace

const TireModel& tire_model_two_node() { return make_tire_model<TwoNode>(); }

}  // namespace rollrig::models
