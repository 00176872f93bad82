/// The cavity of the tire becomes smaller under load and larger with speed.
#include "models/effect.h"

namespace rollrig::models {
namespace {

struct CavityVolume {
  enum Parameter { kContraction, kLoadPower, kGrowth, kSetting };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "cavity_volume";
    info.summary =
        "The deflection at the contact makes the cavity smaller, the centrifugal force makes it larger: the pressure "
        "steps with load and speed";
    info.equation = "V/V_0 = 1 - e ((Fz/Fz_ref)^m - l - q (v/v_1)^2); v_1 = 120 km/h";
    info.source =
        "0 to 1 %, with load and speed: effects.md. Assumed: m about 1, q up to 1, the square (centrifugal "
        "force), "
        "l from 0 (pressure set on the lifted wheel) to 1 (on the loaded one); the gas is compressed without heat, "
        "which exchange with the rubber would take within half a minute";
    info.parameters = {
        {"contraction_percent",
         between(-5.0, 10.0),
         {0.1, 1.0, Prior::Scale::kLog},
         "e, of the volume, from no load to the reference load",
         0.0},
        {"load_power", between(0.3, 3.0), {0.8, 1.5}, "m, of the load"},
        {"growth_ratio", between(-2.0, 5.0), {0.1, 0.9}, "q, growth at 120 km/h relative to e"},
        {"setting_ratio", between(-2.0, 3.0), {0.0, 1.0}, "l, contraction at which the pressure was set, of e"}};
    info.faint_on = {RigKind::kFlat};           // one load, no pressure channel
    info.visible_in = {"cavity_pressure_kPa"};  // the loss follows by half a percent at most
    info.splitting_tests = {"load off and on at constant liner temperature, pressure logged",
                            "pressure at standstill at several loads"};
    return info;
  }

  template <class S>
  static void gas(const EffectView<S>& self, const Instant<S>& now, GasPort<S>& port) {
    using std::pow;
    const S load_ratio = now.motion.load_N / now.context->tire.rolling_resistance.reference_load_N;
    const S speed_ratio = now.motion.speed_m_s / quantity<S>(120.0 / 3.6, dimension::kSpeed);
    const S pressed = value_of(load_ratio) > 0.0 ? S(pow(load_ratio, self.parameter(kLoadPower))) : S(0.0);
    const S contraction = pressed - self.parameter(kSetting) - self.parameter(kGrowth) * speed_ratio * speed_ratio;
    port.volume_ratio *= S(1.0) - self.parameter(kContraction) * contraction;
  }
};

}  // namespace

const Effect& effect_cavity_volume() {
  static const Effect effect = make_effect<CavityVolume>();
  return effect;
}

}  // namespace rollrig::models
