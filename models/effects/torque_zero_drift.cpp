/// The zero of the torque measurement moves.
#include "models/effect.h"

namespace rollrig::models::torque_zero_drift {

struct TorqueZeroDrift {
  enum Parameter { kRate, kTimeConstant, kAmbientTime };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "torque_zero_drift";
    info.summary =
        "The zero of the torque measurement moves from the start of the run on, ever slower, and with the ambient";
    info.equation =
        "torque <- torque + R D, loss force <- loss force + D; D = r (tau (1 - exp(-t/tau)) + k (T_amb - T_amb0)), "
        "t and T_amb0 from the run's start";
    info.source =
        "Kolekar and Narasimhan (2024) §3.2.1, item 4: the torque sensor's +-0.9 N m. Assumed: 0 to 0.5 N per 10 min, "
        "with time or ambient; first order in time (electronics and flange warm up), k up to ten minutes of drift a "
        "kelvin. Taken at a row's time, which is its mean but for r dt^2/(24 tau), and half a sample at the run's two "
        "ends";
    info.parameters = {{"drift_N_per_h",
                        between(-100.0, 100.0),
                        {0.3, 3.0, Prior::Scale::kLog, true},
                        "r, at the surface, at the run's start",
                        0.0},
                       {"time_constant_min",
                        between(1.0, 6000.0),
                        {20.0, 300.0, Prior::Scale::kLog},
                        "tau, in which the drift comes to rest"},
                       {"ambient_min_per_K",
                        between(-1000.0, 1000.0),
                        {-6.0, 6.0},
                        "k, minutes of drift at the rate r that one kelvin of ambient makes"}};
    info.acts_on = &is_indoors;
    info.visible_in = {quantities::kMachineForce};
    info.clean_in = {quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"bearing_warmup"};
    info.splitting_tests = {"torque at standstill before and after",
                            "drum alone for 30 min, then a cold tire on the hot drum"};
    return info;
  }

  /// D at every row.
  template <class S>
  static std::vector<S> calc_drift_N(const EffectView<S>& self, TracePort<S>& port) {
    using std::exp;
    const S& time_constant_s = self.parameter(kTimeConstant);
    const std::vector<S>* ambient_K = port.find(quantities::kAmbient);
    std::vector<S> drift_N;
    for (std::size_t i = 0; i < port.time_s.size(); ++i) {
      const S since_start_s = quantity<S>(port.time_s[i] - port.time_s.front(), dimension::kTime);
      S drifting_s = time_constant_s * (S(1.0) - exp(-since_start_s / time_constant_s));
      if (ambient_K != nullptr) {
        drifting_s += self.parameter(kAmbientTime) * ((*ambient_K)[i] - ambient_K->front());
      }
      drift_N.push_back(self.parameter(kRate) * drifting_s);
    }
    return drift_N;
  }

  template <class S>
  static void trace(const EffectView<S>& self, TracePort<S>& port) {
    std::vector<S>* force = port.find_force();
    if (force == nullptr) return;
    const std::vector<S> drift_N = calc_drift_N(self, port);
    for (std::size_t i = 0; i < drift_N.size(); ++i) (*force)[i] += port.to_reading(drift_N[i]);
  }
};

const Effect& effect() { return make_effect<TorqueZeroDrift>(); }

}  // namespace rollrig::models::torque_zero_drift
