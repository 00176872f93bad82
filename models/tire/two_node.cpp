/// Tread and carcass have temperatures of their own.
#include "models/tire/model_parts.h"

namespace rollrig::models {
namespace {

struct TwoNode : CombinedLaw, TreadAndCarcass {
  static TireModelInfo info() {
    TireModelInfo info;
    info.id = "two_node";
    info.summary =
        "As combined, but tread and carcass have temperatures of their own: the tread faces air and road, the "
        "carcass, on which the liner's sensor sits, faces gas and rim, and the loss follows both";
    info.equation =
        "c C dT_t/dt = h Q + P - (z + f v)(T_t - T_amb) - G (T_t - T_c), (1 - c) C dT_c/dt = (1 - h) Q + G (T_t - "
        "T_c) - H (T_c - T_gas); Q = F_rr v, P friction of the contact; F_rr of the model combined at T = m T_t + (1 "
        "- m) T_c; the road's shares of z and f v act on T_t - T_surface; C, H, z, f: [thermal]";
    info.source =
        "Kolekar and Narasimhan (2024) (3.8) to (3.14), of whose one node (§3.3.2.1) these are two parts; tread, "
        "carcass and gas as bodies, with the heat of sliding in the tread: B. Shyrokau and D. Harsh, Tire model with "
        "temperature effects for Formula SAE vehicle, Applied Sciences 9 (2019) 5328, section 3.1. Assumed: the "
        "carcass gives heat to the outside through the tread alone, since most of the outer surface that moving air "
        "and road reach is the tread's; heat of rolling resistance in both, there in the carcass alone; T in "
        "proportion, since each part's loss follows its own temperature (then m = h)";
    info.nodes = {{Node::kLiner, "carcass"}, {Node::kTread, "tread"}};
    info.tables = {"rolling_resistance", "thermal"};
    info.parameters = parameters();
    return info;
  }
};

}  // namespace

const TireModel& tire_model_two_node() { return make_tire_model<TwoNode>(); }

}  // namespace rollrig::models
