/// The source's combined model: the loss follows speed, load, pressure and the temperature of the rubber, one node.
#include "models/tire/model_parts.h"

namespace rollrig::models {
namespace {

struct Combined : CombinedLaw, OneNode {
  static TireModelInfo info() {
    TireModelInfo info;
    info.id = "combined";
    info.summary = "The loss follows speed, load, pressure and the temperature of the rubber, which is one node";
    info.equation =
        "F_rr = K (p/p_ref)^-a (Fz/Fz_ref) (A0 + A1 v) exp(-(B0 + B1 v) T); C dT/dt = F_rr v - (z + f v)(T - T_amb) - "
        "H (T - T_gas), C_gas dT_gas/dt = H (T - T_gas)";
    info.source = "Kolekar and Narasimhan (2024) (3.4), (3.8) to (3.14)";
    info.nodes = {{Node::kLiner, "rubber"}};
    info.tables = {"rolling_resistance", "thermal"};
    return info;
  }
};

}  // namespace

const TireModel& tire_model_combined() { return make_tire_model<Combined>(); }

}  // namespace rollrig::models
