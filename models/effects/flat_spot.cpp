/// A tire that has stood rolls out of round at first.
#include "models/effect.h"

namespace rollrig::models::flat_spot {

struct FlatSpot {
  enum Parameter { kExcess, kDistance, kSetTime };
  enum State { kFlatness };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "flat_spot";
    info.summary = "Standing leaves a flat spot: the loss is higher until the distance rolled has rounded it out";
    info.equation = "F_rr <- F_rr (1 + e s), ds/dt = -s |v|/L + (1 - s) (1 - tanh(|v|/v_0))/tau; v_0 = 0.05 m/s";
    info.source =
        "temporary flat spots of parked tires roll out in the first miles (tire makers' and sellers' advice, such as "
        "Tire Rack, Flat-Spotted Tires). Assumed: 1 to 8 %, 4 to 15 km; both first order, tau: a tire sets as it "
        "cools, in one to a few hours";
    info.parameters = {{"excess_percent",
                        between(-50.0, 100.0),
                        {1.0, 8.0, Prior::Scale::kLog},
                        "e, higher loss after long standing",
                        0.0},
                       {"distance_km", between(0.1, 200.0), {4.0, 15.0, Prior::Scale::kLog}, "L, over which it decays"},
                       {"set_time_h",
                        between(0.02, 100.0),
                        {0.7, 4.0, Prior::Scale::kLog},
                        "tau, of standing in which it comes back"}};
    info.states = {{"flatness", 1.0, "s, 1 after long standing"}};
    info.visible_in = {quantities::kMachineForce, quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"rubber_memory"};
    info.splitting_tests = {"roll after 10 min, 1 h and 12 h at rest", "the same start at two speeds"};
    return info;
  }

  template <class S>
  static void initial(const EffectView<S>& self, const InitialPort<S>& port, S* states) {
    using std::exp;
    if (port.started_warm) return;  // rolled out
    states[kFlatness] = port.soaked ? S(1.0) : S(S(1.0) - exp(-port.rest_before_s / self.parameter(kSetTime)));
  }

  template <class S>
  static void loss(const EffectView<S>& self, const Instant<S>&, LossPort<S>& port) {
    port.factor *= S(1.0) + self.parameter(kExcess) * self.state(kFlatness);
  }

  template <class S>
  static void rates(const EffectView<S>& self, const Instant<S>& now, S* rates) {
    using std::abs;
    const S speed_m_s = abs(now.motion.speed_m_s);
    const S still = S(1.0) - calc_standstill_fade(speed_m_s);
    rates[kFlatness] = (S(1.0) - self.state(kFlatness)) * still / self.parameter(kSetTime) -
                       self.state(kFlatness) * speed_m_s / self.parameter(kDistance);
  }
};

const Effect& effect() { return make_effect<FlatSpot>(); }

}  // namespace rollrig::models::flat_spot
