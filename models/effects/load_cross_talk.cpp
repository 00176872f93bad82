/// Load leaks into the torque measurement.
#include "models/effect.h"

namespace rollrig::models::load_cross_talk {

struct LoadCrossTalk {
  enum Parameter { kAngle, kBending };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "load_cross_talk";
    info.summary =
        "Part of the load stands in the direction in which force is measured, at every speed and temperature alike";
    info.equation =
        "torque <- torque + R Fz sin e, loss force <- loss force + Fz sin e, e = d (1 - b + b Fz/Fz_ref); Fz as "
        "recorded";
    info.source =
        "misaligned load, as ISO 28580 corrects by turning both ways. Means over the sample, with a row's load held "
        "until the next. Assumed: Fz sin(d), d 0 to 0.5 mrad; either sign; the recorded load, whose own error would "
        "change a small force by a small share; b, a frame that bends under the load";
    info.parameters = {{"angle_mrad",
                        between(-20.0, 20.0),
                        {0.05, 0.5, Prior::Scale::kLog, true},
                        "d, between the load and the normal to the direction of the force, at the reference load",
                        0.0},
                       {"bending_share", between(-1.0, 1.0), {0.0, 0.3}, "b, of the angle, in proportion to load"}};
    info.acts_on = &is_indoors;
    info.visible_in = {quantities::kMachineForce};
    info.clean_in = {quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"bearing_load_friction"};
    info.splitting_tests = {"the same run with reversed rotation", "torque at standstill at several loads"};
    return info;
  }

  /// Mean load over every sample, as loggers average a load that holds from row to row.
  template <class S>
  static std::vector<S> calc_means(const TracePort<S>& port, const std::vector<S>& load_N) {
    std::vector<S> means = load_N;
    for (std::size_t i = 1; i + 1 < load_N.size(); ++i) {
      const double start_s = port.find_mean_start_s(i);
      const double share = (port.time_s[i] - start_s) / (port.find_mean_start_s(i + 1) - start_s);  // before the row
      means[i] += S(share) * (load_N[i - 1] - load_N[i]);
    }
    if (load_N.size() > 1) means.back() = load_N[load_N.size() - 2];
    return means;
  }

  template <class S>
  static void trace(const EffectView<S>& self, TracePort<S>& port) {
    using std::sin;
    const std::vector<S>* load_N = port.find(quantities::kLoad);
    std::vector<S>* force = port.find_force();
    if (load_N == nullptr || force == nullptr) return;
    const std::vector<S> mean_N = calc_means(port, *load_N);
    const S& reference_N = port.context->tire.rolling_resistance.reference_load_N;
    const S& bending = self.parameter(kBending);
    for (std::size_t i = 0; i < mean_N.size(); ++i) {
      const S share = sin(S(self.parameter(kAngle) * (S(1.0) - bending + bending * mean_N[i] / reference_N)));
      (*force)[i] += port.to_reading(mean_N[i] * share);
    }
  }
};

const Effect& effect() { return make_effect<LoadCrossTalk>(); }

}  // namespace rollrig::models::load_cross_talk
