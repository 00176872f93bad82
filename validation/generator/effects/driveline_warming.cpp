/// Oil of axle and wheel bearings: viscosity by Vogel or by Walther, warmed by its own friction.
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

/// What both oils have in common: how soon and how far they warm, and that a rest cools them.
class WarmingOil : public Effect {
 public:
  using Effect::Effect;

  std::size_t state_count() const override { return 1; }

  void start(const RunStart& start, double* rise_dK) const override {
    rise_dK[0] = 0.7 * rise_dK_ * start.left_after_rest(time_s_);
  }

 protected:
  static constexpr double kHeating = 1.6;  // Assumed: of the steady rise, with oil as cold as soaked

  double force_N_ = size_;
  double time_s_ = note_min("time_constant_min", 60.0 * draws_.from(log_normal(15.0, 60.0, 11.0, 80.0)));
  double rise_dK_ = note("rise_dK", draws_.uniform(20.0, 50.0));
};

class VogelOil : public WarmingOil {
 public:
  using WarmingOil::WarmingOil;

  void act(const double* rise_dK, Instant& now) const override { now.rig_force_N += force_N_ * friction(rise_dK, now); }

  void rates(const double* rise_dK, const Instant& now, double* rates) const override {
    const double x = now.speed_m_s / kSpeed80_m_s;
    const double transmitted = 0.3 * std::abs(now.longitudinal_N) / 500.0;
    rates[0] = (rise_dK_ * x * (kHeating * friction(rise_dK, now) + transmitted) - rise_dK[0]) / time_s_;
  }

 private:
  /// Friction over that of oil at 23 degC.
  double friction(const double* rise_dK, const Instant& now) const {
    constexpr double kVogel_K = 900.0;
    constexpr double kVogel_degC = 110.0;
    constexpr double kSoaked_degC = 23.0;
    const double oil_degC = kSoaked_degC + rise_dK[0] + air_share_ * (now.ambient_degC - kSoaked_degC);
    return std::exp(viscous_power_ * kVogel_K * (1.0 / (oil_degC + kVogel_degC) - 1.0 / (kSoaked_degC + kVogel_degC)));
  }

  double viscous_power_ = note("power_of_viscosity", draws_.uniform(0.4, 0.7));
  double air_share_ = note("share_of_ambient", draws_.uniform(0.0, 0.4));
};

/// Gear oil 75W-90 by Walther's law, log log(nu + 0.7) = A - B log T, beside a part that does not feel the oil.
class WaltherOil : public WarmingOil {
 public:
  using WarmingOil::WarmingOil;

  void act(const double* rise_dK, Instant& now) const override { now.rig_force_N += force_N_ * friction(rise_dK[0]); }

  void rates(const double* rise_dK, const Instant& now, double* rates) const override {
    rates[0] = (kHeating * rise_dK_ * now.speed_m_s / kSpeed80_m_s * friction(rise_dK[0]) - rise_dK[0]) / time_s_;
  }

 private:
  static constexpr double kSoaked_K = 296.15;

  /// mm2/s; Assumed: 100 at 40 degC and 15 at 100 degC, as makers of such oils say.
  static double viscosity(double oil_K) {
    return std::pow(10.0, std::pow(10.0, 7.6437 - 2.9418 * std::log10(oil_K))) - 0.7;
  }

  /// Friction over that of oil at 23 degC.
  double friction(double rise_dK) const {
    const double thinner = viscosity(kSoaked_K + rise_dK) / viscosity(kSoaked_K);
    return dry_ + (1.0 - dry_) * std::pow(thinner, viscous_power_);
  }

  double viscous_power_ = note("power_of_viscosity", draws_.uniform(0.4, 0.6));
  double dry_ = note("mechanical_share", draws_.uniform(0.1, 0.3));
};

}  // namespace

const EffectKind kind_driveline_warming{
    "driveline_warming",
    {"N", "friction of one wheel, soaked at 23 degC", 0.0, 0.0, 200.0, log_normal(3.0, 25.0, 2.0, 35.0)},
    {{"vogel",
      "power of a viscosity by Vogel, at the temperature of oil that its own friction and the transmitted force warm",
      make_law<VogelOil>},
     {"walther",
      "a mechanical part beside a power of the viscosity of gear oil by Walther (ASTM D341), at the temperature of oil "
      "that its own friction warms",
      make_law<WaltherOil>}},
    kVehicleGrounds,
    kVehicleGrounds};

}  // namespace rollrig::generator
