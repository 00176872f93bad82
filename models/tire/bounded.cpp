/// A loss between two levels over speed, and between two over temperature; tread and carcass as in two_node.
#include <fmt/format.h>

#include <algorithm>

#include "models/reference_conditions.h"
#include "models/tire/bounded.h"
#include "models/tire/model_parts.h"

namespace rollrig::models {
namespace {

struct Bounded : TreadAndCarcass {
  enum Parameter {
    kLoss = TreadAndCarcass::kCount,
    kSpeedRise,
    kFall,
    kFallRise,
    kLoadExponent,
    kStepSpeed,
    kStepPower,
    kColdLimit,
    kHotLimit,
    kLimitWidth
  };

  static constexpr double kReference_K = kZeroCelsius_K + 30.0;  // at which F_0 holds

  static TireModelInfo info() {
    TireModelInfo info;
    info.id = "bounded";
    info.summary =
        "The loss rises with speed from one level to another, and falls with temperature from one level to another, "
        "so that it stays physical at all speeds and temperatures; tread and carcass as in two_node";
    info.equation =
        "F_rr = K F_0 (Fz/Fz_ref)^b (p/p_ref)^-a exp(s (S - S_80) - B (1 + c (S - S_80)) (theta(T) - theta(30 degC))), "
        "S = v^q/(v^q + v_m^q), S_80 that at 80 km/h, theta = w ln((1 + exp((T - T_m)/w))/(1 + exp((T - T_h)/w))); T "
        "and the heat balances of the model two_node";
    info.source =
        "Between T_m and T_h the exponential of Kolekar and Narasimhan (2024) (3.2); nodes as in two_node. Assumed: "
        "levels on both sides, as of rubber that is glassy or rubbery, where the exponential would go on rising or "
        "falling, and of a loss that speed raises once";
    info.nodes = {{Node::kLiner, "carcass"}, {Node::kTread, "tread"}};
    info.tables = {"rolling_resistance", "thermal"};
    info.has_speed_lines = false;
    info.find_mistake = &find_mistake;
    info.parameters = parameters();
    // Assumed: usual values of passenger-car tires; a diagnosis does not move numbers without an uncertainty.
    const std::vector<TireModelParameter> law{
        {{"loss_N", between(1e-3, 1e5), "F_0, at 80 km/h, 30 degC and the references of [rolling_resistance]"},
         38.0,
         0.03,
         FitRole::kFree},
        {{"speed_rise", between(0.0, 5.0), "s, logarithm of the loss at high over that at low speed, at 30 degC"},
         0.3,
         0.1,
         FitRole::kFreeOverSpeeds},
        {{"fall_per_degC", non_negative(), "B, relative fall with the tire's temperature at 80 km/h"},
         0.016,
         0.1,
         FitRole::kFree},
        {{"speed_rise_of_fall", any_number(), "c, how much that fall rises from low to high speed"},
         0.0,
         0.0,
         FitRole::kFreeOverSpeedsWithinLaw},
        {{"load_exponent", between(0.3, 2.0), "b"}, 1.1, 0.05, FitRole::kFreeOverLoads},
        {{"step_speed_km_h", positive(), "v_m, at which the rise is half done"}, 62.0, 0.0},
        {{"step_power", between(1.0, 10.0), "q, how steep it is"}, 4.0, 0.0},
        {{"cold_limit_degC", any_number(), "T_m, below which the loss is constant"}, 25.0, 0.0},
        {{"hot_limit_degC", any_number(), "T_h, above which it is constant"}, 70.0, 0.0},
        {{"limit_width_K", positive(), "w, width of the transition to a constant loss"}, 4.0, 0.0}};
    info.parameters.insert(info.parameters.end(), law.begin(), law.end());
    return info;
  }

  template <class S>
  static S calc_loss_N(const Instant<S>& now) {
    using std::abs;
    using std::exp;
    using std::pow;
    const TireParameters<S>& tire = now.context->tire;
    const LossReference<S>& reference = tire.rolling_resistance;
    const OwnParameters<S>& own = tire.own;
    const S& load_N = now.motion.load_N;
    // A lifted tire has none. 0^m would have no derivative where a fit tries an exponent below 1.
    const S load_factor =
        value_of(load_N) > 0.0 ? S(pow(S(load_N / reference.reference_load_N), own[kLoadExponent])) : S(0.0);
    const S pressure_factor =
        calc_pressure_factor(now.pressure_Pa, reference.reference_pressure_Pa, reference.pressure_exponent);
    const S above_80 =
        calc_speed_step(S(abs(now.motion.speed_m_s)), own) - calc_speed_step(get_reference_speed_m_s<S>(), own);
    const S reference_K = quantity<S>(kReference_K, dimension::kTemperature);
    const S warmer_dK = calc_bounded_dK(now.loss.temperature_K, own) - calc_bounded_dK(reference_K, own);
    const S fall_per_K = own[kFall] * (S(1.0) + own[kFallRise] * above_80);
    return load_factor * pressure_factor * own[kLoss] * exp(own[kSpeedRise] * above_80 - fall_per_K * warmer_dK);
  }

  static BoundedMargins calc_margins(const OwnParameters<double>& own) {
    const double at_80 = calc_step_at_80(own);
    const double at_30_dK = calc_bounded_dK(kReference_K, own);
    const double fall_rise_per_K = own[kFall] * own[kFallRise];
    BoundedMargins margins;
    margins.fall_at_rest = 1.0 - own[kFallRise] * at_80;
    margins.fall_at_high_speed = 1.0 + own[kFallRise] * (1.0 - at_80);
    margins.least_speed_rise =
        std::max(fall_rise_per_K * (own[kHotLimit] - own[kColdLimit] - at_30_dK), -fall_rise_per_K * at_30_dK);
    margins.speed_rise = own[kSpeedRise] - margins.least_speed_rise;
    return margins;
  }

 private:
  /// S of the equation, 0 at standstill, 1 at high speed.
  template <class S>
  static S calc_speed_step(const S& speed_m_s, const OwnParameters<S>& own) {
    using std::pow;
    const S power = pow(speed_m_s / own[kStepSpeed], own[kStepPower]);
    return power / (S(1.0) + power);
  }

  static double calc_step_at_80(const OwnParameters<double>& own) {
    return calc_speed_step(get_reference_speed_m_s<double>(), own);
  }

  /// Refuses limits in the wrong order or too near for the width of their transitions, a loss that rises with
  /// temperature at some speed, and one that falls with speed at some temperature.
  /// Equation  T_m < T_h,  w <= (T_h - T_m)/4
  ///           1 + c (S - S_80) >= 0  at S = 0 and S = 1
  ///           s >= B c (theta - theta(30 degC))  at theta = 0 and theta = T_h - T_m
  static std::optional<TireModelMistake> find_mistake(const OwnParameters<double>& own) {
    const double cold_K = own[kColdLimit];
    const double hot_K = own[kHotLimit];
    if (cold_K >= hot_K) {
      return TireModelMistake{"hot_limit_degC", "the limits of the law are in the wrong order",
                              fmt::format("more than cold_limit_degC = {:.5g}", cold_K - kZeroCelsius_K)};
    }
    const double widest_K = 0.25 * (hot_K - cold_K);
    if (own[kLimitWidth] > widest_K) {
      return TireModelMistake{"limit_width_K", "the transitions to a constant loss leave no range between them",
                              fmt::format("at most {:.4g}, a quarter of the range between the limits", widest_K)};
    }
    const BoundedMargins margins = calc_margins(own);
    if (margins.fall_at_rest < 0.0 || margins.fall_at_high_speed < 0.0) {
      const double at_80 = calc_step_at_80(own);
      return TireModelMistake{"speed_rise_of_fall", "the loss would rise with temperature at some speed",
                              fmt::format("{:.4g} to {:.4g}", -1.0 / (1.0 - at_80), 1.0 / at_80)};
    }
    if (margins.speed_rise >= 0.0) return std::nullopt;
    return TireModelMistake{"speed_rise", "the loss would fall with speed at some temperature",
                            fmt::format(">= {:.4g}, or speed_rise_of_fall nearer to 0", margins.least_speed_rise)};
  }

  /// theta of the equation: T - T_m between T_m and T_h, 0 below and T_h - T_m above, smooth between.
  template <class S>
  static S calc_bounded_dK(const S& temperature_K, const OwnParameters<S>& own) {
    using std::exp;
    using std::log;
    constexpr double kLinearFrom = 50.0;  // from here on, log(1 + e^x) is x in double precision; e^x overflows at 709
    const auto above = [&](const S& from_K) {
      const S widths = (temperature_K - from_K) / own[kLimitWidth];
      return value_of(widths) > kLinearFrom ? widths : S(log(S(1.0) + exp(widths)));
    };
    return own[kLimitWidth] * (above(own[kColdLimit]) - above(own[kHotLimit]));
  }
};

}  // namespace

BoundedMargins calc_bounded_margins(const OwnParameters<double>& own) { return Bounded::calc_margins(own); }

const TireModel& tire_model_bounded() { return make_tire_model<Bounded>(); }

}  // namespace rollrig::models
