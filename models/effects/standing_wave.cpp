/// Waves on the tire at high speed cost work.
#include "models/effect.h"

namespace rollrig::models::standing_wave {

struct StandingWave {
  enum Parameter { kForce, kCriticalSpeed, kLoadPower };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "standing_wave";
    info.summary = "Above a critical speed waves behind the contact cost a force that heats the rubber";
    info.equation =
        "F <- F + F_w (v - v_c)^2/((v_1 - v_c)^2 + v_0^2) (Fz/Fz_ref)^m for v > v_c; v_1 = 120 km/h, v_0 = 1 m/s, "
        "so that a v_c at v_1 stays finite";
    info.source =
        "Assumed: v_c 26 to 33 m/s, (v - v_c)^2, 0.5 to 4 N at 120 km/h; v_0 (it changes what F_w is called, not "
        "which forces there are), m (the wave starts from the tire's deflection)";
    info.parameters = {{"force_N",
                        between(-50.0, 100.0),
                        {0.5, 4.0, Prior::Scale::kLog},
                        "F_w, at 120 km/h and the reference load",
                        0.0},
                       {"critical_speed_m_s", between(15.0, 50.0), {26.0, 33.0}, "v_c, above which it is there"},
                       {"load_power", between(0.0, 2.0), {0.3, 1.2}, "m, how it goes with load"}};
    info.visible_in = {quantities::kMachineForce, quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"convection_law"};
    info.splitting_tests = {"fine speed steps from 90 to 140 km/h", "fan on and off at 120 km/h"};
    return info;
  }

  template <class S>
  static void loss(const EffectView<S>& self, const Instant<S>& now, LossPort<S>& port) {
    using std::abs;
    using std::pow;
    const S first_m_s = quantity<S>(120.0 / 3.6, dimension::kSpeed);
    const S least_m_s = quantity<S>(1.0, dimension::kSpeed);
    const S& critical_m_s = self.parameter(kCriticalSpeed);
    const S over_m_s = positive_part(S(abs(now.motion.speed_m_s) - critical_m_s));
    const S& load_N = now.motion.load_N;
    if (value_of(over_m_s) <= 0.0 || value_of(load_N) <= 0.0) return;
    const S reach_m_s = first_m_s - critical_m_s;
    const S load_ratio = load_N / now.context->tire.rolling_resistance.reference_load_N;
    port.add_heating_force(self.parameter(kForce) * over_m_s * over_m_s /
                           (reach_m_s * reach_m_s + least_m_s * least_m_s) *
                           pow(load_ratio, self.parameter(kLoadPower)));
  }
};

const Effect& effect() { return make_effect<StandingWave>(); }

}  // namespace rollrig::models::standing_wave
