/// A constant coefficient: the loss follows the load alone, whatever the tire's temperature, which is that of one node.
#include "models/tire/model_parts.h"

namespace rollrig::models {
namespace {

struct ConstantRrc : OneNode {
  static TireModelInfo info() {
    TireModelInfo info;
    info.id = kConstantModel;
    info.summary = "The loss is a constant share of the load, as most vehicle simulators have it";
    info.equation = "F_rr = RRc Fz; temperatures as in the model combined";
    info.source = "Kolekar and Narasimhan (2024) §2.2.1: the coefficient by which ISO 28580 describes a tire";
    info.nodes = {{Node::kLiner, "rubber"}};
    info.tables = {"thermal", "constant"};
    info.loss_follows_heat = false;
    info.loss_follows_curvature = false;
    return info;
  }

  template <class S>
  static S calc_loss_N(const Instant<S>& now) {
    return now.context->tire.constant.rrc * now.motion.load_N;
  }
};

}  // namespace

const TireModel& tire_model_constant_rrc() { return make_tire_model<ConstantRrc>(); }

}  // namespace rollrig::models
