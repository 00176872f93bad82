/// The gas takes up the tire's heat faster or slower than assumed.
#include "models/effect.h"

namespace rollrig::models {
namespace {

struct GasHeatTransfer {
  enum Parameter { kRatio };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "gas_heat_transfer";
    info.summary =
        "The coefficient from tire to gas is another than the tire file's, so that the pressure follows the tire's "
        "temperature sooner or later";
    info.equation = "H <- h H";
    info.source =
        "1 to 8 W/K other than assumed: effects.md; as a ratio to the tire file's H, about 4 W/K, so that 1 is the "
        "baseline for every tire";
    info.parameters = {
        {"transfer_ratio", between(0.02, 50.0), {0.25, 2.0}, "h, coefficient over the tire file's", 1.0}};
    info.faint_on = {RigKind::kFlat};  // no pressure channel
    info.visible_in = {"cavity_pressure_kPa"};
    info.confused_with = {"rim_heat"};
    info.splitting_tests = {"speed steps with the pressure logged every second", "gas thermocouple at the valve"};
    return info;
  }

  template <class S>
  static void thermal(const EffectView<S>& self, const Instant<S>&, ThermalPort<S>& port) {
    port.link(Node::kRubber, Node::kGas) *= self.parameter(kRatio);
  }
};

}  // namespace

const Effect& effect_gas_heat_transfer() {
  static const Effect effect = make_effect<GasHeatTransfer>();
  return effect;
}

}  // namespace rollrig::models
