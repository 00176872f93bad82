/// The tire loses gas.
#include "models/effect.h"
#include "models/reference_conditions.h"

namespace rollrig::models::slow_leak {

struct SlowLeak {
  enum Parameter { kRate, kGrowth };
  enum State { kLost };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "slow_leak";
    info.summary =
        "The tire loses gas, all the time alike or faster while warm: the pressure falls, and the loss rises after "
        "hours; filling it anew sets that back";
    info.equation =
        "m/m_0 <- (m/m_0)(1 - s), ds/dt = r exp(e (T - 40 degC))/(p_cold + p_amb) tanh(p/p_0); p_0 = 10 kPa: no "
        "overpressure, no leak";
    info.source =
        "Kolekar and Narasimhan (2024) (3.14) has the gas sealed. Assumed: r, since sound rubber lets through some kPa "
        "a month, and a tire that loses more than 2 kPa an hour is mended; the pressure that drives it hardly changes; "
        "e, a hole knows no temperature, while gas goes through rubber with 25 to 45 kJ/mol, 0.03 to 0.055 /K at 40 "
        "degC, of a warm tire; T of the liner; tight before the run, whose cold pressure is read at its start";
    info.parameters = {{"rate_kPa_per_h",
                        between(0.0, 100.0),
                        {0.2, 2.0, Prior::Scale::kLog},
                        "r, fall of the pressure at the temperature at which it was set, while the tire is at 40 degC",
                        0.0},
                       {"growth_per_K", between(-0.05, 0.2), {0.0, 0.05}, "e, of the rate with temperature"}};
    info.states = {{"gas_lost", 0.01, "s, share of the gas that was filled in"}};
    info.faint_on = &is_on_road;  // has no pressure channel, and the loss follows after hours
    info.visible_in = {quantities::kCavityPressure};
    info.confused_with = {"cell_air_warming"};
    info.splitting_tests = {"soak with pressure logged", "setting gauge before and after, at one temperature"};
    return info;
  }

  template <class S>
  static void gas(const EffectView<S>& self, const Instant<S>&, GasPort<S>& port) {
    port.mass_ratio *= S(1.0) - self.state(kLost);
  }

  template <class S>
  static void rates(const EffectView<S>& self, const Instant<S>& now, S* rates) {
    using std::exp;
    using std::tanh;
    const S warmer_dK = now.thermal.temperature_K[index_of(Node::kLiner)] - get_reference_temperature_K<S>() -
                        quantity<S>(15.0, dimension::kTemperature);
    const S low_Pa = quantity<S>(10e3, dimension::kPressure);
    const S filled_abs_Pa = now.inflation.cold_pressure_Pa + now.inflation.ambient_pressure_Pa;
    rates[kLost] = self.parameter(kRate) * exp(self.parameter(kGrowth) * warmer_dK) / filled_abs_Pa *
                   tanh(now.pressure_Pa / low_Pa);
  }

  template <class S>
  static void inflated(const EffectView<S>&, S* states) {
    states[kLost] = S(0.0);
  }
};

const Effect& effect() { return make_effect<SlowLeak>(); }

}  // namespace rollrig::models::slow_leak
