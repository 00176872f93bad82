/// The tire keeps a loss of its own when the load is taken off.
#include "models/effect.h"

namespace rollrig::models::tire_loss_in_skim {

struct TireLossInSkim {
  enum Parameter { kForce, kTemperatureCoefficient, kLoadPower };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "tire_loss_in_skim";
    info.summary =
        "At skim load the tire keeps a loss of its own beyond its share of the load; it falls as the tire warms";
    info.equation =
        "F_rr <- F_rr + F_s ((Fz + F_0)/(F_skim + F_0))^m exp(-b (T - 25 degC)) tanh(Fz/F_0); F_0 = 20 N: below it "
        "the contact is lost";
    info.source =
        "Kolekar and Narasimhan (2024) §4.1.7, §5.2: what is measured in skim depends on the tire's temperature. "
        "Assumed: F_s, some tenths of such a loss; exponential fall, power of the load, F_0";
    info.parameters = {
        {"force_N",
         between(-20.0, 20.0),
         {0.3, 3.0, Prior::Scale::kLog},
         "F_s, at the rig's skim load and 25 degC",
         0.0},
        {"fall_per_degC",
         between(0.0, 0.1),
         {0.007, 0.03, Prior::Scale::kLog},
         "b, relative fall with the tire's temperature"},
        {"load_power", between(-1.0, 1.0), {-0.2, 0.2}, "m, how it goes on with load; 0 = the same at every load"}};
    info.acts_on = &has_skim;  // that has a skim
    info.visible_in = {quantities::kMachineForce, quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"load_exponent", "bearing_warmup"};
    info.splitting_tests = {"skim at 50, 100, 200 and 400 N, extrapolated to zero",
                            "drum alone for 30 min, then a cold tire on the hot drum"};
    return info;
  }

  template <class S>
  static void loss(const EffectView<S>& self, const Instant<S>& now, LossPort<S>& port) {
    using std::exp;
    using std::pow;
    using std::tanh;
    const S contact_N = quantity<S>(20.0, dimension::kForce);
    const S reference_K = quantity<S>(kZeroCelsius_K + 25.0, dimension::kTemperature);
    const S load_N = positive_part(now.motion.load_N);
    const S load_ratio = (load_N + contact_N) / (now.context->skim_load_N + contact_N);
    port.add_heating_force(self.parameter(kForce) * pow(load_ratio, self.parameter(kLoadPower)) *
                           exp(-self.parameter(kTemperatureCoefficient) * (port.temperature_K - reference_K)) *
                           tanh(load_N / contact_N));
  }
};

const Effect& effect() { return make_effect<TireLossInSkim>(); }

}  // namespace rollrig::models::tire_loss_in_skim
