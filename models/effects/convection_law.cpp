/// The air takes heat off the tire by another power of the speed.
#include "models/effect.h"

namespace rollrig::models::convection_law {

struct ConvectionLaw {
  enum Parameter { kDeficit, kReferenceSpeed, kOtherAir, kFanShare };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "convection_law";
    info.summary =
        "The air that carries heat off the tire does not go with the surface's speed but with a power of it, or a fan "
        "blows across it";
    info.equation =
        "f v <- f (q + v_0 (w/v_0)^(1 - (1-s) d) - w), w^2 = q^2 + u^2, q = v + sqrt(v^2 (1 - s d) + s d v_0^2 + u^2) "
        "- sqrt(v^2 + u^2): n = 1 - d about v_0; with s = 0 v_0 (v/v_0)^n, with s = 1 a fan whose air adds by squares";
    info.source =
        "Kolekar and Narasimhan (2024) (3.18) has a conductance linear in speed; forced convection of turbulent flow "
        "goes with v^0.8 (Incropera et al., Fundamentals of Heat and Mass Transfer, chapter 7). Assumed: exponent n "
        "0.6 to 1, d = 1 - n, or a fan whose air speed is not the roller's; v_0, at which the tire file's f holds; u, "
        "which keeps the power finite at standstill and is the air that moves there without a fan; s, any part of d by "
        "the fan";
    info.parameters = {
        {"exponent_deficit", between(-0.5, 1.0), {0.0, 0.4}, "d, 1 less the exponent n", 0.0},
        {"reference_speed_m_s", between(2.0, 60.0), {14.0, 30.0, Prior::Scale::kLog}, "v_0, at which f v holds"},
        {"other_air_m_s", between(0.05, 20.0), {0.3, 3.0, Prior::Scale::kLog}, "u, air that moves at standstill"},
        {"fan_share", between(0.0, 1.0), {0.0, 1.0}, "s, of the deficit, by a fan"}};
    info.faint_on = &is_on_road;  // some K cooler costs a few parts in a thousand of what accelerating takes
    info.visible_in = {quantities::kMachineForce, quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"standing_wave"};
    info.splitting_tests = {"fan on and off at 120 km/h", "speed steps 80, 120, 40 km/h on the warm tire",
                            "soak with temperature and pressure logged"};
    return info;
  }

  /// Sums to the speed that are 0 at no deficit, so that the baseline keeps its bits.
  template <class S>
  static void boundary(const EffectView<S>& self, const Instant<S>&, BoundaryPort<S>& port) {
    using std::pow;
    using std::sqrt;
    const S& reference_m_s = self.parameter(kReferenceSpeed);
    const S other_m2_s2 = self.parameter(kOtherAir) * self.parameter(kOtherAir);
    const S by_fan = self.parameter(kDeficit) * self.parameter(kFanShare);
    const S own_m2_s2 = port.air_speed_m_s * port.air_speed_m_s + other_m2_s2;
    S with_fan_m2_s2 = own_m2_s2 + by_fan * (reference_m_s * reference_m_s - port.air_speed_m_s * port.air_speed_m_s);
    if (value_of(with_fan_m2_s2) < value_of(other_m2_s2)) with_fan_m2_s2 = other_m2_s2;  // no fan takes more than all
    port.air_speed_m_s += sqrt(with_fan_m2_s2) - sqrt(own_m2_s2);
    const S moved_m_s = sqrt(port.air_speed_m_s * port.air_speed_m_s + other_m2_s2);
    port.air_speed_m_s += moved_m_s * (pow(moved_m_s / reference_m_s, by_fan - self.parameter(kDeficit)) - S(1.0));
    if (value_of(port.air_speed_m_s) < 0.0) port.air_speed_m_s = zero<S>();
  }
};

const Effect& effect() { return make_effect<ConvectionLaw>(); }

}  // namespace rollrig::models::convection_law
