/// The air takes heat off the tire by another power of the speed.
#include "models/effect.h"

namespace rollrig::models {
namespace {

struct ConvectionLaw {
  enum Parameter { kDeficit, kReferenceSpeed, kOtherAir };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "convection_law";
    info.summary =
        "The air that carries heat off the tire does not go with the surface's speed but with a power of it, down to "
        "a fan whose air has one speed";
    info.equation =
        "f v <- f (v + v_0 (w/v_0)^(1 - d) - w), w^2 = v^2 + u^2: v_0 (v/v_0)^n with n = 1 - d where v >> u";
    info.source =
        "f v^n, n 0.6 to 1, or a fan whose air speed is not the roller's: effects.md; d = 1 - n, and d = 1 is a fan "
        "that "
        "blows at v_0. Assumed: v_0, at which the tire file's f holds; u, which keeps the power finite at standstill "
        "and is the air that moves there";
    info.parameters = {
        {"exponent_deficit", between(-0.5, 1.0), {0.0, 0.4}, "d, 1 less the exponent n", 0.0},
        {"reference_speed_m_s", between(2.0, 60.0), {14.0, 30.0, Prior::Scale::kLog}, "v_0, at which f v holds"},
        {"other_air_m_s", between(0.05, 20.0), {0.3, 3.0, Prior::Scale::kLog}, "u, air that moves at standstill"}};
    info.faint_on = {RigKind::kFlat};  // some K cooler costs a few parts in a thousand of what accelerating takes
    info.visible_in = {"drum_torque_Nm", "loss_force_N", "liner_temperature_degC", "cavity_pressure_kPa"};
    info.confused_with = {"standing_wave"};
    info.splitting_tests = {"fan on and off at 120 km/h", "speed steps 80, 120, 40 km/h on the warm tire",
                            "soak with temperature and pressure logged"};
    return info;
  }

  /// A factor on w that is 0 at no deficit, so that the baseline keeps its bits.
  template <class S>
  static void boundary(const EffectView<S>& self, const Instant<S>&, BoundaryPort<S>& port) {
    using std::pow;
    using std::sqrt;
    const S& other_m_s = self.parameter(kOtherAir);
    const S moved_m_s = sqrt(port.air_speed_m_s * port.air_speed_m_s + other_m_s * other_m_s);
    const S excess = pow(moved_m_s / self.parameter(kReferenceSpeed), -self.parameter(kDeficit)) - S(1.0);
    port.air_speed_m_s += moved_m_s * excess;
    if (value_of(port.air_speed_m_s) < 0.0) port.air_speed_m_s = zero<S>();
  }
};

}  // namespace

const Effect& effect_convection_law() {
  static const Effect effect = make_effect<ConvectionLaw>();
  return effect;
}

}  // namespace rollrig::models
