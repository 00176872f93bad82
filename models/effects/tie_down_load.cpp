/// The restraint of a vehicle on rollers presses its wheels down.
#include "models/effect.h"

namespace rollrig::models::tie_down_load {

struct TieDownLoad {
  enum Parameter { kLoad, kRelaxing };
  enum State { kRelaxed };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "tie_down_load";
    info.summary = "The tie-downs press every wheel onto its roller with more than the recorded load";
    info.equation =
        "Fz <- Fz + dF (1 - r w), where Fz > 0, not below 0; tau dw/dt = 1 - w, w = 0 at the start, 1 right after "
        "another run, "
        "tau = 15 min";
    info.source =
        "Kolekar and Narasimhan (2024) §3.4.2 (vehicle held by tie-downs). Assumed: 50 to 400 N a wheel; straps that "
        "creep, r, tau; tied down anew before a run, but for one right after another";
    info.parameters = {
        {"added_load_N", between(-1000.0, 3000.0), {50.0, 400.0, Prior::Scale::kLog}, "dF, of one wheel", 0.0},
        {"relaxing_share", between(-0.5, 0.8), {0.0, 0.2}, "r, of it, that straps lose as they creep"}};
    info.states = {{"relaxed_share", 1.0, "w, of what the straps will lose, that they have lost"}};
    info.acts_on = &is_tied_down;
    info.visible_in = {quantities::kMachineForce, quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"curvature_exponent", "load_record"};
    info.splitting_tests = {"tie-downs slack and tight", "wheel load cells under the rollers"};
    return info;
  }

  template <class S>
  static void initial(const EffectView<S>&, const InitialPort<S>& port, S* states) {
    states[kRelaxed] = S(port.started_warm ? 1.0 : 0.0);
  }

  template <class S>
  static void input(const EffectView<S>& self, const Instant<S>&, InputPort<S>& port) {
    if (value_of(port.load_N) <= 0.0) return;  // the rollers alone: no vehicle stands on them
    const S added_N = self.parameter(kLoad) * (S(1.0) - self.parameter(kRelaxing) * self.state(kRelaxed));
    port.load_N = positive_part(S(port.load_N + added_N));
  }

  template <class S>
  static void rates(const EffectView<S>& self, const Instant<S>&, S* rates) {
    rates[kRelaxed] = (S(1.0) - self.state(kRelaxed)) / quantity<S>(900.0, dimension::kTime);
  }
};

const Effect& effect() { return make_effect<TieDownLoad>(); }

}  // namespace rollrig::models::tie_down_load
