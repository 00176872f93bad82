/// Tread and liner have temperatures of their own.
#include "models/effect.h"

namespace rollrig::models::tread_liner_lag {

struct TreadLinerLag {
  enum Parameter { kShare, kConductance, kHeatPower, kCoolingPower };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "tread_liner_lag";
    info.summary =
        "Tread and liner are two nodes: the tread takes part of heat and cooling, the sensor sees the liner, and the "
        "loss follows both";
    info.equation =
        "tread: share s of the rubber's heat capacity, q = 1 - (1 - s)^h of its heat, c = 1 - (1 - s)^k of its "
        "cooling to air and road; liner: the rest; between them 4 s (1 - s) G, which is G for two halves; F_rr sees "
        "(1 - q) T_liner + q T_tread, since each part's loss follows its own temperature";
    info.source =
        "Kolekar and Narasimhan (2024) §3.3.2.1, §4.2.2: one lumped node. As a share, since a conductance has no value "
        "at which it does nothing, and so that no time constant goes to 0 with the size. Assumed: G, 0.45 m2 and 1 to "
        "4 mm of rubber of 0.25 W/(m K); s about a half (tread, belts and their rubber), h (heat evenly by mass = 1), "
        "k (most of the air and all of the road act on the tread)";
    info.parameters = {
        {"tread_share", between(0.0, 0.95), {0.3, 0.7}, "s, of the rubber's heat capacity that is the tread's", 0.0},
        {"conductance_W_per_K",
         between(5.0, 500.0),
         {30.0, 150.0, Prior::Scale::kLog},
         "G, between tread and liner where both are halves"},
        {"heat_power", between(0.0, 5.0), {0.6, 1.5, Prior::Scale::kLog}, "h, of the tread's share of the heat"},
        {"cooling_power",
         between(0.0, 10.0),
         {1.0, 4.0, Prior::Scale::kLog},
         "k, of the tread's share of the cooling"}};
    info.nodes[index_of(Node::kTread)] = true;
    info.faint_on = &is_on_road;  // the loss follows the mean of both, which hardly changes
    info.visible_in = {quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"clock_shift"};
    info.splitting_tests = {"load and speed steps with an infrared sensor on the tread",
                            "steps up and down: a clock shifts both alike"};
    return info;
  }

  /// The part of the rubber's heat or cooling that a power gives to the tread.
  template <class S>
  static S calc_part(const S& share, const S& power) {
    using std::pow;
    return S(1.0) - pow(S(1.0) - share, power);
  }

  template <class S>
  static void loss(const EffectView<S>& self, const Instant<S>& now, LossPort<S>& port) {
    const auto& temperature_K = now.thermal.temperature_K;
    port.temperature_K += calc_part(self.parameter(kShare), self.parameter(kHeatPower)) *
                          (temperature_K[index_of(Node::kTread)] - temperature_K[index_of(Node::kLiner)]);
  }

  /// All of the tread is in proportion to its share, so its temperature has a limit as that goes to 0. There
  /// a trace of tread takes part, which the rubber does not feel, so that values are the baseline's to the
  /// bit and derivatives by the share are right.
  template <class S>
  static void thermal(const EffectView<S>& self, const Instant<S>&, ThermalPort<S>& port) {
    const std::size_t rubber = index_of(Node::kLiner);
    const std::size_t tread = index_of(Node::kTread);
    const S& share = self.parameter(kShare);
    const S trace = S(value_of(share) == 0.0 ? 1e-30 : 0.0);  // below rounding in any sum over the nodes
    const auto split = [&](auto& of, const S& power) {
      const S part = calc_part(share, power);
      of[tread] = (part + trace * power) * of[rubber];
      of[rubber] -= part * of[rubber];
    };
    split(port.heat_capacity_J_per_K, S(1.0));
    split(port.heat_W, self.parameter(kHeatPower));
    split(port.air_W_per_K, self.parameter(kCoolingPower));
    split(port.road_W_per_K, self.parameter(kCoolingPower));
    const S full_W_per_K = S(4.0) * self.parameter(kConductance);
    port.link(Node::kLiner, Node::kTread) += share * (S(1.0) - share) * full_W_per_K;
    port.heat_W[tread] += trace * full_W_per_K * (port.temperature_K[rubber] - port.temperature_K[tread]);
  }
};

const Effect& effect() { return make_effect<TreadLinerLag>(); }

}  // namespace rollrig::models::tread_liner_lag
