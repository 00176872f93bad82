/// The gas takes up the tire's heat faster or slower than assumed.
#include "models/effect.h"
#include "models/reference_conditions.h"

namespace rollrig::models::gas_heat_transfer {

struct GasHeatTransfer {
  enum Parameter { kRatio, kStirred };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "gas_heat_transfer";
    info.summary =
        "The coefficient from tire to gas is another than the tire file's, so that the pressure follows the tire's "
        "temperature sooner or later";
    info.equation = "H <- H h^(1 - s + s |v|/v_ref), not above 3 H; v_ref = 80 km/h";
    info.source =
        "Kolekar and Narasimhan (2024) §3.3.2.2: H is another author's, not measured. As a ratio to the tire file's H, "
        "so that 1 is the baseline for every tire. Assumed: h, 1 to 8 W/K where files have about 4; s, since a turning "
        "tire stirs its gas, so that what is off may go with speed";
    info.parameters = {{"transfer_ratio",
                        between(0.02, 50.0),
                        {0.25, 2.0, Prior::Scale::kLog},
                        "h, coefficient over the tire file's, at 80 km/h",
                        1.0},
                       {"stirred_share", between(-1.0, 2.0), {0.0, 0.7}, "s, of the exponent, in proportion to speed"}};
    info.faint_on = &is_on_road;  // no pressure channel
    info.visible_in = {quantities::kCavityPressure};
    info.confused_with = {"rim_heat"};
    info.splitting_tests = {"speed steps with the pressure logged every second", "gas thermocouple at the valve"};
    return info;
  }

  template <class S>
  static void thermal(const EffectView<S>& self, const Instant<S>& now, ThermalPort<S>& port) {
    using std::abs;
    using std::pow;
    constexpr double kMost = 3.0;  // Assumed: faster gas hardly differs from gas that follows at once
    const S speed_ratio = abs(now.motion.speed_m_s) / get_reference_speed_m_s<S>();
    const S stirring = S(1.0) + self.parameter(kStirred) * (speed_ratio - S(1.0));
    const S factor = pow(self.parameter(kRatio), stirring);
    port.link(Node::kLiner, Node::kGas) *= value_of(factor) > kMost ? S(kMost) : factor;
  }
};

const Effect& effect() { return make_effect<GasHeatTransfer>(); }

}  // namespace rollrig::models::gas_heat_transfer
