/// The recorded load is off by a scale, straight or bent, an offset, or some of both.
#include "models/effect.h"

namespace rollrig::models::load_record {

struct LoadRecord {
  enum Parameter { kError, kOffsetShare, kPower };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "load_record";
    info.summary =
        "What really presses the tire down differs from the recorded load, by a share of it, straight or bent, by an "
        "offset, or by some of both: loss and heat go with the true load";
    info.equation =
        "Fz <- Fz + s Fz_ref ((1 - g) (Fz/Fz_ref)^n + g), not below 0, on entry as recorded; a lifted tire stays "
        "lifted";
    info.source =
        "the record is given and the truth follows from it. Assumed: scale or offset, 1 to 5 %; either sign; g up to "
        "about a half, since an offset of the whole is a large part of the skim load and would be seen there; n about "
        "1, other for a load cell that bends. A road set records no load: the weight of a vehicle is an error of its "
        "file";
    info.parameters = {{"error_percent",
                        between(-30.0, 30.0),
                        {1.0, 5.0, Prior::Scale::kLog, true},
                        "s, true over recorded at the reference load, less one",
                        0.0},
                       {"offset_share", between(0.0, 1.0), {0.0, 0.5}, "g, of the error, that is an offset"},
                       {"power", between(0.3, 3.0), {0.6, 1.4}, "n, of the recorded load, by which the rest grows"}};
    info.acts_on = &is_indoors;
    info.visible_in = {quantities::kMachineForce, quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"torque_gain", "tie_down_load"};
    info.splitting_tests = {"dead weights or a second load cell under the tire",
                            "skim at 50, 100, 200 and 400 N, extrapolated to zero"};
    return info;
  }

  template <class S>
  static void input(const EffectView<S>& self, const Instant<S>& now, InputPort<S>& port) {
    using std::pow;
    if (value_of(port.load_N) <= 0.0) return;
    const S& offset_share = self.parameter(kOffsetShare);
    const S& reference_N = now.context->tire.rolling_resistance.reference_load_N;
    const S of_scale = pow(S(port.load_N / reference_N), self.parameter(kPower));
    const S error_N = self.parameter(kError) * reference_N * ((S(1.0) - offset_share) * of_scale + offset_share);
    port.load_N = positive_part(S(port.load_N + error_N));
  }
};

const Effect& effect() { return make_effect<LoadRecord>(); }

}  // namespace rollrig::models::load_record
