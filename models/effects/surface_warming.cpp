/// Drum or roller warms under the tire.
#include "models/effect.h"
#include "models/reference_conditions.h"

namespace rollrig::models::surface_warming {

struct SurfaceWarming {
  enum Parameter { kRise, kTimeConstant, kPower, kSkinShare };
  enum State { kSurfaceRise, kSkinRise };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "surface_warming";
    info.summary =
        "The surface of drum or roller warms above ambient as the tire rolls on it loaded; where its temperature is "
        "recorded, the record holds and this does nothing";
    info.equation =
        "T_surface <- T_surface + (1 - a) theta + a theta_s, tau d(theta)/dt = D (v Fz/(v_ref Fz_ref))^n - theta, "
        "tau_s d(theta_s)/dt likewise; tau_s = 4 min, v_ref = 80 km/h";
    info.source =
        "Kolekar and Narasimhan (2024) §3.3.2.1 (heat to the road in z). A road is new under every turn, so it acts on "
        "drums and rollers. Assumed: 2 to 15 K, 10 to 40 min; n, a power of load times speed; a skin that warms by "
        "itself, tau_s and its share a up to about a third. Not soaked: warm before the rest";
    info.parameters = {
        {"rise_dK",
         between(-30.0, 60.0),
         {2.0, 15.0, Prior::Scale::kLog},
         "D, in steady rolling at 80 km/h and the reference load",
         0.0},
        {"time_constant_min", between(0.5, 600.0), {10.0, 40.0, Prior::Scale::kLog}, "tau, of the surface's warm-up"},
        {"power", between(0.1, 2.0), {0.5, 1.0}, "n, of load times speed"},
        {"skin_share", between(0.0, 1.0), {0.0, 0.3}, "a, of the rise, that the skin has for itself"}};
    info.states = {{"surface_rise_dK", 10.0, "theta, rise of the body over ambient"},
                   {"skin_rise_dK", 10.0, "theta_s, rise of the skin over ambient"}};
    info.acts_on = &is_indoors;
    info.visible_in = {quantities::kMachineForce, quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"cell_air_warming"};
    info.splitting_tests = {"thermometer on the drum's surface", "cold tire on the hot drum",
                            "air temperature read beside the tire"};
    return info;
  }

  template <class S>
  static void initial(const EffectView<S>& self, const InitialPort<S>& port, S* states) {
    states[kSurfaceRise] = calc_rise_at_start(port, self.parameter(kRise), self.parameter(kTimeConstant));
    states[kSkinRise] = calc_rise_at_start(port, self.parameter(kRise), get_skin_time_s<S>());
  }

  template <class S>
  static void boundary(const EffectView<S>& self, const Instant<S>& now, BoundaryPort<S>& port) {
    if (now.acting.surface_recorded) return;
    const S& skin_share = self.parameter(kSkinShare);
    port.surface_K += (S(1.0) - skin_share) * self.state(kSurfaceRise) + skin_share * self.state(kSkinRise);
  }

  template <class S>
  static void rates(const EffectView<S>& self, const Instant<S>& now, S* rates) {
    using std::abs;
    using std::pow;
    const S reference_m_s = get_reference_speed_m_s<S>();
    const S& reference_N = now.context->tire.rolling_resistance.reference_load_N;
    const S work_ratio = abs(now.motion.speed_m_s) / reference_m_s * (positive_part(now.motion.load_N) / reference_N);
    const bool rolls = value_of(work_ratio) > 0.0;
    const S aim_dK =
        rolls ? S(self.parameter(kRise) * pow(work_ratio, self.parameter(kPower))) : S(0.0 * self.parameter(kRise));
    rates[kSurfaceRise] = (aim_dK - self.state(kSurfaceRise)) / self.parameter(kTimeConstant);
    rates[kSkinRise] = (aim_dK - self.state(kSkinRise)) / get_skin_time_s<S>();
  }

 private:
  template <class S>
  static S get_skin_time_s() {
    return quantity<S>(240.0, dimension::kTime);
  }
};

const Effect& effect() { return make_effect<SurfaceWarming>(); }

}  // namespace rollrig::models::surface_warming
