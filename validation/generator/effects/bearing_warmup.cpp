/// Grease of the rig's bearings, thinner as the bearings' own friction warms it: by Vogel's law, or by Arrhenius'.
#include <cmath>

#include "sim/core/units.h"
#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

constexpr double kSoaked_degC = 25.0;

class BearingWarmup : public Effect {
 public:
  explicit BearingWarmup(const Making& of) : Effect(of) {
    rise_dK_ = note("rise_dK", of.draws.from(log_normal(8.0, 25.0, 5.0, 35.0)));
    const double time_min = note("time_constant_min", of.draws.from(log_normal(10.0, 60.0, 6.0, 90.0)));
    const double warm_share = note("reference_share", of.draws.uniform(0.7, 1.2));
    vogel_degC_ = note("vogel_degC", of.draws.uniform(90.0, 135.0));
    forced_share_ = note("forced_cooling_share", of.draws.uniform(0.2, 0.6));
    reference_degC_ = kSoaked_degC + warm_share * rise_dK_;
    const double warm_degC = kSoaked_degC + rise_dK_;
    vogel_K_ = of.size * (kSoaked_degC + vogel_degC_) * (warm_degC + vogel_degC_);
    const double cold_N = of.specimen.truth(Base::kC0) + of.specimen.truth(Base::kC1) * kSpeed80_m_s;
    cooling_W_per_K_ = thinning(warm_degC) * cold_N * kSpeed80_m_s / rise_dK_;
    capacity_J_per_K_ = 60.0 * time_min * cooling_W_per_K_;
    time_s_ = 60.0 * time_min;
  }

  std::size_t state_count() const override { return 1; }

  void start(const RunStart& start, double* rise_dK) const override {
    // Not soaked: warm before the rest. Standing, only the unforced share of the cooling acts.
    rise_dK[0] = rise_dK_ * start.left_after_rest(time_s_, 1.0 - forced_share_);
  }

  void act(const double* rise_dK, Instant& now) const override {
    now.bearing_factor *= thinning(now.ambient_degC + rise_dK[0]);
  }

  void rates(const double* rise_dK, const Instant& now, double* rates) const override {
    const double cooling_W_per_K =
        cooling_W_per_K_ * (1.0 - forced_share_ + forced_share_ * std::pow(now.speed_m_s / kSpeed80_m_s, 0.8));
    rates[0] = (now.bearing_N * now.speed_m_s - cooling_W_per_K * rise_dK[0]) / capacity_J_per_K_;
  }

 private:
  /// Viscosity over that at which c0 and c1 were taken.
  double thinning(double bearing_degC) const {
    return std::exp(vogel_K_ / (bearing_degC + vogel_degC_) - vogel_K_ / (reference_degC_ + vogel_degC_));
  }

  double rise_dK_ = 0.0;
  double time_s_ = 0.0;
  double vogel_degC_ = 0.0;
  double vogel_K_ = 0.0;
  double forced_share_ = 0.0;
  double reference_degC_ = 0.0;
  double cooling_W_per_K_ = 0.0;
  double capacity_J_per_K_ = 0.0;
};

/// Viscosity by Arrhenius' law at the temperature of the races, which warm a housing.
class ArrheniusBearing : public Effect {
 public:
  explicit ArrheniusBearing(const Making& of) : Effect(of) {
    rise_dK_ = note("rise_dK", of.draws.from(log_normal(8.0, 25.0, 5.0, 35.0)));
    const double time_min = note("time_constant_min", of.draws.from(log_normal(10.0, 60.0, 6.0, 90.0)));
    const double warm_share = note("reference_share", of.draws.uniform(0.7, 1.2));
    forced_share_ = note("forced_cooling_share", of.draws.uniform(0.2, 0.6));
    race_share_ = note("share_between_race_and_housing",
                       of.draws.uniform(0.1, 0.35));  // Assumed: of the rise, between races and housing
    const double race_min = note("race_min", of.draws.uniform(2.0, 6.0));
    reference_K_ = kSoaked_degC + warm_share * rise_dK_ + kZeroCelsius_K;
    const double soaked_K = kSoaked_degC + kZeroCelsius_K;
    activation_K_ = of.size * soaked_K * (soaked_K + rise_dK_);
    const double cold_N = of.specimen.truth(Base::kC0) + of.specimen.truth(Base::kC1) * kSpeed80_m_s;
    const double steady_W = thinning(soaked_K + rise_dK_) * cold_N * kSpeed80_m_s;
    link_W_per_K_ = steady_W / (race_share_ * rise_dK_);
    cooling_W_per_K_ = steady_W / ((1.0 - race_share_) * rise_dK_);
    time_s_ = 60.0 * time_min;
    race_s_ = 60.0 * race_min;
  }

  std::size_t state_count() const override { return 2; }  // rise of races and of housing

  void start(const RunStart& start, double* rise_dK) const override {
    rise_dK[1] = (1.0 - race_share_) * rise_dK_ * start.left_after_rest(time_s_, 1.0 - forced_share_);
    rise_dK[0] = rise_dK[1] + race_share_ * rise_dK_ * start.left_after_rest(race_s_);
  }

  void act(const double* rise_dK, Instant& now) const override {
    now.bearing_factor *= thinning(now.ambient_degC + rise_dK[0] + kZeroCelsius_K);
  }

  void rates(const double* rise_dK, const Instant& now, double* rates) const override {
    const double cooling_W_per_K =
        cooling_W_per_K_ * (1.0 - forced_share_ + forced_share_ * std::pow(now.speed_m_s / kSpeed80_m_s, 0.8));
    const double to_housing_W = link_W_per_K_ * (rise_dK[0] - rise_dK[1]);
    rates[0] = (now.bearing_N * now.speed_m_s - to_housing_W) / (race_s_ * link_W_per_K_);
    rates[1] = (to_housing_W - cooling_W_per_K * rise_dK[1]) / (time_s_ * cooling_W_per_K_);
  }

 private:
  double thinning(double race_K) const { return std::exp(activation_K_ * (1.0 / race_K - 1.0 / reference_K_)); }

  double rise_dK_ = 0.0;
  double time_s_ = 1.0;
  double race_s_ = 1.0;
  double forced_share_ = 0.0;
  double race_share_ = 0.0;
  double activation_K_ = 0.0;
  double reference_K_ = 0.0;
  double link_W_per_K_ = 1.0;
  double cooling_W_per_K_ = 1.0;
};

}  // namespace

const EffectKind kind_bearing_warmup{
    "bearing_warmup",
    {"1/K", "relative fall of c0 + c1 v per K, from soaked at 25 degC to steady at 80 km/h", 0.0, 0.0, 0.2,
     log_normal(0.005, 0.04, 0.002, 0.06)},
    {{"vogel",
      "grease by Vogel's law exp(V/(T_b + T_V)) on c0 + c1 v alone, not on the drum's air drag; T_b warmed by the "
      "bearings' own friction power, cooled faster with speed",
      make_law<BearingWarmup>},
     {"arrhenius",
      "grease by Arrhenius' law on c0 + c1 v alone; its friction warms races, these a housing that is cooled faster "
      "with speed",
      make_law<ArrheniusBearing>}}};

}  // namespace rollrig::generator
