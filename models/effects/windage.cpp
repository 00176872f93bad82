/// The turning tire stirs the air.
#include "models/effect.h"
#include "models/reference_conditions.h"

namespace rollrig::models::windage {

struct Windage {
  enum Parameter { kForce, kSpeedPower };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "windage";
    info.summary =
        "The turning tire loses work to the air around it, whatever its load, and none of it heats the rubber; where "
        "the parasitic loss (on a road the drag of the vehicle) is uncertain, its v^2 term takes it up";
    info.equation = "F <- F + F_v (v/v_ref)^n; v_ref = 80 km/h; none on a tire that is lifted";
    info.source =
        "fading with tanh(v/0.05 m/s), as all rolling loss. Assumed: c v^n, n 1.8 to 2.2, no heat in the rubber, 0.3 "
        "to 3 N at 80 km/h";
    info.parameters = {
        {"force_N", between(-20.0, 50.0), {0.3, 3.0, Prior::Scale::kLog}, "F_v, of one tire at 80 km/h", 0.0},
        {"speed_power", between(0.5, 4.0), {1.8, 2.2}, "n, power of the speed"}};
    info.visible_in = {quantities::kMachineForce};
    info.clean_in = {quantities::kLinerTemperature, quantities::kCavityPressure};
    info.splitting_tests = {"drum alone and with the tire in skim, at several speeds",
                            "speed sweep with the tire's temperature logged: windage leaves it as it is",
                            "smooth covers over the sides of tire and rim"};
    return info;
  }

  template <class S>
  static void loss(const EffectView<S>& self, const Instant<S>& now, LossPort<S>& port) {
    using std::abs;
    using std::pow;
    const S reference_m_s = get_reference_speed_m_s<S>();
    const S speed_ratio = abs(now.motion.speed_m_s) / reference_m_s;
    if (value_of(speed_ratio) <= 0.0 || value_of(now.motion.load_N) <= 0.0) return;  // lifted: nothing turns it
    port.add_force(self.parameter(kForce) * pow(speed_ratio, self.parameter(kSpeedPower)), S(0.0));
  }
};

const Effect& effect() { return make_effect<Windage>(); }

}  // namespace rollrig::models::windage
