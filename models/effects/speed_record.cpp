/// The recorded speed is off by a scale, a part of which may grow with speed or be a fixed speed.
#include "models/effect.h"
#include "models/reference_conditions.h"

namespace rollrig::models::speed_record {

struct SpeedRecord {
  enum Parameter { kError, kGrowingShare, kFixedShare };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "speed_record";
    info.summary =
        "What really turns is faster or slower than recorded, by a share, fixed or other at other speeds: loss, heat, "
        "drag and inertia go with the true speed, while the record keeps its own";
    info.equation =
        "x <- x + s ((1 - g - o) x + g x^2 + o x sqrt((1 + e^2)/(x^2 + e^2))), x = v/v_ref, v_ref = 80 km/h, e = 0.15; "
        "dv/dt by the derivative; neither below a tenth of what is recorded; on entry as recorded";
    info.source =
        "the record is given and the truth follows from it; torque and force are measured by themselves, so that "
        "their channels have no error of their own from it. A slope is taken as it is recorded. Assumed: scale, 1 to "
        "10 %, at most 15 % (a radius that is wrong by more is another wheel); either sign; g, a diameter or a belt "
        "that grows with speed; o, a fixed speed, which is gone at rest, "
        "within e";
    info.parameters = {{"error_percent",
                        between(-15.0, 15.0),
                        {1.0, 10.0, Prior::Scale::kLog, true},
                        "s, true over recorded at 80 km/h, less one",
                        0.0},
                       {"growing_share", between(-1.0, 1.0), {-0.3, 0.3}, "g, of the error, in proportion to speed"},
                       {"fixed_share", between(-1.0, 1.0), {-0.2, 0.2}, "o, of the error, that is a fixed speed"}};
    info.visible_in = {quantities::kMachineForce, quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"inertia_error"};
    info.splitting_tests = {"hand tachometer on drum or roller", "revolutions counted over a minute",
                            "ramps of several accelerations with the tire lifted"};
    return info;
  }

  template <class S>
  static void input(const EffectView<S>& self, const Instant<S>&, InputPort<S>& port) {
    using std::abs;
    using std::sqrt;
    constexpr double kAtRest = 0.15;
    constexpr double kLeast = 0.1;
    const S& error = self.parameter(kError);
    const S& growing = self.parameter(kGrowingShare);
    const S& fixed = self.parameter(kFixedShare);
    const S x = abs(port.speed_m_s) / get_reference_speed_m_s<S>();
    const S squares = x * x + S(kAtRest * kAtRest);
    const S of_fixed = fixed * sqrt(S(S(1.0 + kAtRest * kAtRest) / squares));
    const S constant = S(1.0) - growing - fixed;
    const S turns = S(1.0) + error * (constant + growing * x + of_fixed);
    const S gains = S(1.0) + error * (constant + S(2.0) * growing * x + of_fixed * S(kAtRest * kAtRest) / squares);
    const bool is_sound = value_of(turns) > kLeast;  // no error turns a drum the other way round
    port.speed_m_s *= is_sound ? turns : S(kLeast);
    port.acceleration_m_s2 *= is_sound ? gains : S(kLeast);
  }
};

const Effect& effect() { return make_effect<SpeedRecord>(); }

}  // namespace rollrig::models::speed_record
