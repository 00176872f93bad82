/// Wind along the road, a slope that the record of the height lacks, and air of another density.
#include "models/effect.h"

namespace rollrig::models::wind_and_grade {

struct WindAndGrade {
  enum Parameter { kWind, kSlope, kDensity };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "wind_and_grade";
    info.summary = "Wind along the road, a slope beside the recorded one, and air of another density";
    info.equation = "wind <- wind + w, slope <- slope + s, density <- r density";
    info.source =
        "Assumed: 0 to 5 m/s, 0 to 0.5 %; one wind and one slope over a whole set, either way, since a road set does "
        "not record its heading; law off by 30 % here and there, as gusts and turns are a third of a mean wind; r: "
        "the weather, and some hundred meters of height";
    info.parameters = {
        {"wind_m_s", between(-30.0, 30.0), {0.5, 5.0, Prior::Scale::kLog, true}, "w, against the vehicle", 0.0},
        {"slope_percent", between(-5.0, 5.0), {-0.25, 0.25}, "s, rise over run"},
        {"density_ratio", between(0.5, 1.5), {0.96, 1.04}, "r, to dry air of the recorded temperature at 1013 hPa"}};
    info.acts_on = &is_on_road;
    info.visible_in = {quantities::kMachineForce};
    info.confused_with = {"toe_camber_drag", "tire_temperature"};
    info.splitting_tests = {"the same stretch in both directions", "an anemometer on the vehicle",
                            "the same drive at two speeds: drag goes with the square"};
    info.law_error = {0.3, 0.09};  // Assumed
    return info;
  }

  template <class S>
  static void input(const EffectView<S>& self, const Instant<S>&, InputPort<S>& port) {
    port.wind_m_s += self.parameter(kWind);
    port.slope += self.parameter(kSlope);
    port.air_density_ratio *= self.parameter(kDensity);
  }
};

const Effect& effect() { return make_effect<WindAndGrade>(); }

}  // namespace rollrig::models::wind_and_grade
