/// Families of unknown effects as terms of hypotheses: a force, a load, heat, gas or a reading that is off by a simple
/// function of speed, load, temperature or pressure.
#include "diagnosis/terms/unknown_terms.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "models/reference_conditions.h"

namespace rollrig::models {
namespace {

constexpr double kKmhPer_m_s = 3.6;

std::string show_power(double power) { return fmt::format("{:.1f}", std::round(10.0 * power) / 10.0 + 0.0); }

/// "grows with the power 1.8 of the speed", "hardly depends on the speed".
std::string show_growth(const std::string& of, double power) {
  constexpr double kNone = 0.25;
  if (std::abs(power) < kNone) return fmt::format("hardly depends on the {}", of);
  return fmt::format("{} with the power {} of the {}", power > 0.0 ? "grows" : "falls", show_power(std::abs(power)),
                     of);
}

struct ForceInBand {
  enum Parameter { kForce, kSpeed, kWidth, kHeatShare };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "unknown force in a band of speeds";
    info.summary = "A resisting force that acts around one speed";
    info.equation = "F <- F + F_b exp(-((v - v_b)/w)^2/2), on a loaded tire; share h of it heats the rubber";
    info.source = "Assumed: all numbers";
    info.parameters = {
        {"force_N", between(-50.0, 50.0), {0.5, 4.0, Prior::Scale::kLog, true}, "F_b, at the middle of the band", 0.0},
        {"speed_m_s", between(0.0, 60.0), {10.0, 30.0}, "v_b, middle of the band"},
        {"width_m_s", between(0.5, 40.0), {1.5, 8.0, Prior::Scale::kLog}, "w, of the band"},
        {"heat_share", between(0.0, 1.0), {0.2, 0.8}, "h"}};
    info.visible_in = {quantities::kMachineForce};
    return info;
  }

  static std::string describe(const std::vector<double>& at) {
    const double low_km_h = kKmhPer_m_s * std::max(0.0, at[kSpeed] - at[kWidth]);
    const double high_km_h = kKmhPer_m_s * (at[kSpeed] + at[kWidth]);
    return fmt::format("a force of {:+.2g} N that acts between {:.0f} and {:.0f} km/h", at[kForce], low_km_h,
                       high_km_h);
  }

  template <class S>
  static void loss(const EffectView<S>& self, const Instant<S>& now, LossPort<S>& port) {
    using std::abs;
    using std::exp;
    if (value_of(now.motion.load_N) <= 0.0) return;
    const S x = (abs(now.motion.speed_m_s) - self.parameter(kSpeed)) / self.parameter(kWidth);
    port.add_force(self.parameter(kForce) * exp(S(-0.5) * x * x), self.parameter(kHeatShare));
  }
};

/// (v/80 km/h)^n, held at that of walking speed below it, so that a negative power stays finite.
template <class S>
S calc_speed_power(const Instant<S>& now, const S& power) {
  using std::abs;
  using std::pow;
  const S walking_m_s = quantity<S>(1.0, dimension::kSpeed);
  const S speed_m_s = abs(now.motion.speed_m_s);
  return pow(S((value_of(speed_m_s) > 1.0 ? speed_m_s : walking_m_s) / get_reference_speed_m_s<S>()), power);
}

template <class S>
S calc_load_power(const Instant<S>& now, const S& power) {
  using std::pow;
  return pow(S(now.motion.load_N / now.context->tire.rolling_resistance.reference_load_N), power);
}

struct ForceByPowers {
  enum Parameter { kForce, kSpeedPower, kLoadPower, kHeatShare };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "unknown force by powers of speed and load";
    info.summary = "A resisting force that goes with powers of speed and load";
    info.equation = "F <- F + F_p (v/80 km/h)^n (Fz/Fz_ref)^m, on a loaded tire; share h of it heats the rubber";
    info.source = "Assumed: all numbers";
    info.parameters = {{"force_N",
                        between(-50.0, 50.0),
                        {0.5, 5.0, Prior::Scale::kLog, true},
                        "F_p, at 80 km/h and the reference load",
                        0.0},
                       {"speed_power", between(-2.0, 5.0), {0.0, 2.0}, "n"},
                       {"load_power", between(-1.0, 4.0), {0.0, 1.5}, "m"},
                       {"heat_share", between(0.0, 1.0), {0.2, 0.8}, "h"}};
    info.visible_in = {quantities::kMachineForce};
    return info;
  }

  static std::string describe(const std::vector<double>& at) {
    return fmt::format("a force of {:+.2g} N at 80 km/h and the reference load that {} and {}", at[kForce],
                       show_growth("speed", at[kSpeedPower]), show_growth("load", at[kLoadPower]));
  }

  template <class S>
  static void loss(const EffectView<S>& self, const Instant<S>& now, LossPort<S>& port) {
    if (value_of(now.motion.load_N) <= 0.0) return;
    port.add_force(self.parameter(kForce) * calc_speed_power(now, self.parameter(kSpeedPower)) *
                       calc_load_power(now, self.parameter(kLoadPower)),
                   self.parameter(kHeatShare));
  }
};

struct LoadWithSpeed {
  enum Parameter { kShare, kPower };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "unknown load that goes with speed";
    info.summary = "A load on the tire, beyond the recorded one, that goes with a power of the speed";
    info.equation = "Fz <- Fz + s Fz_ref (v/80 km/h)^n, on a loaded tire";
    info.source = "Assumed: all numbers; n: 2 of what centrifugal force or air does";
    info.parameters = {{"share_percent",
                        between(-30.0, 30.0),
                        {0.5, 4.0, Prior::Scale::kLog, true},
                        "s, at 80 km/h, of the reference load",
                        0.0},
                       {"power", between(0.2, 5.0), {1.2, 2.6}, "n"}};
    info.visible_in = {quantities::kMachineForce};
    return info;
  }

  static std::string describe(const std::vector<double>& at) {
    return fmt::format("a load of {:+.2g} % at 80 km/h, beyond the recorded one, that {}", 100.0 * at[kShare],
                       show_growth("speed", at[kPower]));
  }

  template <class S>
  static void input(const EffectView<S>& self, const Instant<S>& now, InputPort<S>& port) {
    using std::abs;
    using std::pow;
    if (value_of(port.load_N) <= 0.0) return;
    const S ratio = abs(port.speed_m_s) / get_reference_speed_m_s<S>();
    if (value_of(ratio) <= 0.0) return;
    const S& reference_N = now.context->tire.rolling_resistance.reference_load_N;
    port.load_N =
        positive_part(S(port.load_N + self.parameter(kShare) * reference_N * pow(ratio, self.parameter(kPower))));
  }
};

struct HeatByPower {
  enum Parameter { kHeat, kSpeedPower, kLoadPower };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "unknown heat by powers of speed and load";
    info.summary = "Heat in the rubber that no resisting force makes, or that leaves it by another way";
    info.equation = "Q <- Q + F_q v (v/80 km/h)^n (Fz/Fz_ref)^m, on a loaded tire";
    info.source = "Assumed: all numbers; F_q, the force that would make the heat: a few percent of the loss";
    info.parameters = {{"force_N",
                        between(-50.0, 50.0),
                        {1.0, 6.0, Prior::Scale::kLog, true},
                        "F_q, the force that would make it",
                        0.0},
                       {"speed_power", between(-2.0, 4.0), {-0.8, 1.0}, "n"},
                       {"load_power", between(-1.0, 4.0), {0.0, 1.0}, "m"}};
    info.visible_in = {quantities::kLinerTemperature, quantities::kCavityPressure};
    return info;
  }

  static std::string describe(const std::vector<double>& at) {
    return fmt::format(
        "heat of {:+.0f} W in the rubber at 80 km/h and the reference load, beyond what the loss makes, that {} and {}",
        at[kHeat] * 80.0 / kKmhPer_m_s, show_growth("speed", at[kSpeedPower] + 1.0),
        show_growth("load", at[kLoadPower]));
  }

  template <class S>
  static void loss(const EffectView<S>& self, const Instant<S>& now, LossPort<S>& port) {
    if (value_of(now.motion.load_N) <= 0.0) return;
    port.extra_heating_force_N += self.parameter(kHeat) * calc_speed_power(now, self.parameter(kSpeedPower)) *
                                  calc_load_power(now, self.parameter(kLoadPower));
  }
};

struct GasByPressure {
  enum Parameter { kRate, kPower };
  enum State { kLost };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "unknown gas that leaves above the cold pressure";
    info.summary = "Gas leaves the tire while its pressure is above that at filling";
    info.equation =
        "m/m_0 <- (m/m_0)(1 - s), ds/dt = r ((p - p_cold)/10 kPa)^n/(p_cold + p_amb) above p_cold, 0 below; set back "
        "by filling";
    info.source =
        "Assumed: all numbers; n: large for a valve or a crack that opens at a pressure, and above 1.2, since a leak "
        "that hardly depends on the pressure is slow_leak";
    info.parameters = {{"rate_kPa_per_h",
                        between(0.0, 100.0),
                        {0.2, 2.0, Prior::Scale::kLog},
                        "r, fall of the pressure at the temperature at which it was set, 10 kPa above the cold one",
                        0.0},
                       {"power", between(1.2, 8.0), {1.5, 3.5}, "n"}};
    info.states = {{"gas_lost", 0.01, "s, share of the gas that was filled in"}};
    info.visible_in = {quantities::kCavityPressure};
    return info;
  }

  static std::string describe(const std::vector<double>& at) {
    constexpr double kPa_per_h = 1e3 / 3600.0;
    return fmt::format("gas that leaves at {:.2g} kPa/h at 10 kPa above the cold pressure, a rate that {} above it",
                       at[kRate] / kPa_per_h, show_growth("pressure", at[kPower]));
  }

  template <class S>
  static void gas(const EffectView<S>& self, const Instant<S>&, GasPort<S>& port) {
    port.mass_ratio *= S(1.0) - self.state(kLost);
  }

  template <class S>
  static void rates(const EffectView<S>& self, const Instant<S>& now, S* rates) {
    using std::pow;
    const S above = (now.pressure_Pa - now.inflation.cold_pressure_Pa) / quantity<S>(10e3, dimension::kPressure);
    const S filled_abs_Pa = now.inflation.cold_pressure_Pa + now.inflation.ambient_pressure_Pa;
    const S growth = value_of(above) > 0.0 ? S(pow(above, self.parameter(kPower))) : zero<S>();
    rates[kLost] = self.parameter(kRate) * growth / filled_abs_Pa;
  }

  template <class S>
  static void inflated(const EffectView<S>&, S* states) {
    states[kLost] = S(0.0);
  }
};

struct BentTemperature {
  enum Parameter { kError, kPower };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "unknown error of the temperature reading";
    info.summary = "The liner's sensor reads off by a power of its distance from 25 degC";
    info.equation = "T <- T + e ((T - T_25)/30 K)^n above T_25 = 25 degC";
    info.source = "Assumed: all numbers";
    info.parameters = {{"error_dK", between(-20.0, 20.0), {0.3, 2.0, Prior::Scale::kLog, true}, "e, at 55 degC", 0.0},
                       {"power", between(0.3, 5.0), {1.0, 2.5}, "n"}};
    info.visible_in = {quantities::kLinerTemperature};
    return info;
  }

  static std::string describe(const std::vector<double>& at) {
    return fmt::format("an error of the liner's reading of {:+.2g} K at 55 degC that {} above 25 degC", at[kError],
                       show_growth("temperature", at[kPower]));
  }

  template <class S>
  static void trace(const EffectView<S>& self, TracePort<S>& port) {
    using std::pow;
    std::vector<S>* liner_K = port.find(quantities::kLinerTemperature);
    if (liner_K == nullptr) return;
    const S reference_K = get_reference_temperature_K<S>();
    const S span_K = quantity<S>(30.0, dimension::kTemperature);
    for (S& value_K : *liner_K) {
      const S above = (value_K - reference_K) / span_K;
      if (!(value_of(above) > 0.0)) continue;  // nor where there is no sample
      value_K += self.parameter(kError) * pow(above, self.parameter(kPower));
    }
  }
};

}  // namespace
}  // namespace rollrig::models

namespace rollrig::diagnosis {
namespace {

class UnknownTerm : public Term {
 public:
  using Describe = std::string (*)(const std::vector<double>&);
  UnknownTerm(const models::Effect& effect, Describe describe) : effect_(effect), describe_(describe) {}
  const models::EffectInfo& info() const override { return effect_.info; }
  const models::Effect& effect() const override { return effect_; }
  std::optional<std::string> describe(const std::vector<double>& own_SI) const override { return describe_(own_SI); }
  bool is_unknown() const override { return true; }

 private:
  const models::Effect& effect_;
  Describe describe_;
};

template <class Family>
UnknownTerm make_unknown_term() {
  return {models::make_effect<Family>(), &Family::describe};
}

}  // namespace

std::vector<const Term*> list_unknown_terms() {
  static const std::vector<UnknownTerm> families{
      make_unknown_term<models::ForceInBand>(),   make_unknown_term<models::ForceByPowers>(),
      make_unknown_term<models::LoadWithSpeed>(), make_unknown_term<models::HeatByPower>(),
      make_unknown_term<models::GasByPressure>(), make_unknown_term<models::BentTemperature>()};
  std::vector<const Term*> terms;
  for (const UnknownTerm& family : families) terms.push_back(&family);
  return terms;
}

}  // namespace rollrig::diagnosis
