/// Rubber that has rested loses more until it has been worked.
#include "models/effect.h"

namespace rollrig::models::rubber_memory {

struct RubberMemory {
  enum Parameter { kExcess, kDecayTime, kRecoveryTime };
  enum State { kMemory };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "rubber_memory";
    info.summary =
        "Rested rubber loses more, at equal temperature, until minutes of loaded rolling have worked it; at rest and "
        "in skim that comes back";
    info.equation =
        "F_rr <- F_rr (1 + m s), ds/dt = -s w/tau + (1 - s)(1 - w)/tau_r; w = tanh(|v|/v_0) x^2/(x^2 + x_0^2) the "
        "working, x = Fz/Fz_ref; v_0 = 0.05 m/s, x_0 = 0.2";
    info.source =
        "filled rubber softens under repeated strain and recovers at rest (Payne, J. Appl. Polym. Sci. 6, 1962; "
        "Mullins, Rubber Chem. Technol. 42, 1969). Assumed: 1 to 8 %, 3 to 20 min of loaded rolling, after each skim; "
        "first order, tau_r some times tau, x_0: skim load lets recover, test loads work";
    info.parameters = {
        {"excess_percent", between(0.0, 100.0), {1.0, 8.0, Prior::Scale::kLog}, "m, higher loss after long rest", 0.0},
        {"decay_time_min",
         between(0.2, 300.0),
         {3.0, 20.0, Prior::Scale::kLog},
         "tau, of loaded rolling in which it decays"},
        {"recovery_time_min",
         between(0.2, 3000.0),
         {5.0, 60.0, Prior::Scale::kLog},
         "tau_r, of rest or skim in which it comes back"}};
    info.states = {{"memory", 1.0, "s, 1 after long rest"}};
    info.visible_in = {quantities::kMachineForce, quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"flat_spot", "rim_heat"};
    info.splitting_tests = {"load off and on at constant liner temperature", "roll after 10 min, 1 h and 12 h at rest",
                            "the same start at two speeds"};
    return info;
  }

  template <class S>
  static void initial(const EffectView<S>& self, const InitialPort<S>& port, S* states) {
    using std::exp;
    if (port.started_warm) return;  // worked
    states[kMemory] = port.soaked ? S(1.0) : S(S(1.0) - exp(-port.rest_before_s / self.parameter(kRecoveryTime)));
  }

  template <class S>
  static void loss(const EffectView<S>& self, const Instant<S>&, LossPort<S>& port) {
    port.factor *= S(1.0) + self.parameter(kExcess) * self.state(kMemory);
  }

  template <class S>
  static void rates(const EffectView<S>& self, const Instant<S>& now, S* rates) {
    constexpr double kHalfLoad = 0.2;  // x_0, where a load works the rubber half
    const S load = positive_part(now.motion.load_N) / now.context->tire.rolling_resistance.reference_load_N;
    using std::abs;
    const S working =
        calc_standstill_fade(S(abs(now.motion.speed_m_s))) * (load * load / (load * load + S(kHalfLoad * kHalfLoad)));
    rates[kMemory] = (S(1.0) - self.state(kMemory)) * (S(1.0) - working) / self.parameter(kRecoveryTime) -
                     self.state(kMemory) * working / self.parameter(kDecayTime);
  }
};

const Effect& effect() { return make_effect<RubberMemory>(); }

}  // namespace rollrig::models::rubber_memory
