#include "diagnosis/comparison/truncated_normal.h"

#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <utility>

namespace rollrig::diagnosis {
namespace {

constexpr double kShare = 0.95;
constexpr double kFarOut = -25.0;  // from here on the tail is an exponential function to 0.2 %
constexpr double kRootTwo = boost::math::constants::root_two<double>();

double calc_density(double x) {
  return std::isinf(x) ? 0.0 : std::exp(-0.5 * x * x) * boost::math::constants::one_div_root_two_pi<double>();
}

/// Phi, precise for negative x.
double calc_below(double x) { return 0.5 * std::erfc(-x / kRootTwo); }

double find_quantile(double below) { return -kRootTwo * boost::math::erfc_inv(2.0 * below); }

/// Limits in standard deviations from the mean, mirrored so that the upper one is nearer to the mean than the lower
/// one, or below it: there Phi is precise.
struct Standardized {
  double lower;
  double upper;
  bool is_mirrored;

  bool is_far_out() const { return upper < kFarOut; }
  double mass() const { return calc_below(upper) - calc_below(lower); }
};

Standardized standardize(const TruncatedNormal& of) {
  const double lower = (of.lower - of.mean) / of.sd;
  const double upper = (of.upper - of.mean) / of.sd;
  if (lower + upper > 0.0) return {-upper, -lower, true};
  return {lower, upper, false};
}

/// Of an exponential function that rises with `rate` up to 0 and begins at -length: its share that lies within.
double calc_within(double rate, double length) { return -std::expm1(-rate * length); }

TruncatedSpread find_standard_spread(const Standardized& limits) {
  if (limits.is_far_out()) {
    const double rate = -limits.upper;
    const double within = calc_within(rate, limits.upper - limits.lower);
    return {1.0 / rate, limits.upper + std::log1p(-kShare * within) / rate, limits.upper};
  }
  const double mass = limits.mass();
  const double at_lower = calc_density(limits.lower);
  const double at_upper = calc_density(limits.upper);
  const double lower_moment = at_lower > 0.0 ? limits.lower * at_lower : 0.0;
  const double upper_moment = at_upper > 0.0 ? limits.upper * at_upper : 0.0;
  const double shift = (at_lower - at_upper) / mass;
  const double variance = 1.0 + (lower_moment - upper_moment) / mass - shift * shift;
  TruncatedSpread spread{std::sqrt(std::fmax(variance, 0.0))};
  spread.high_95 = kRootTwo * boost::math::erf_inv(kShare * mass);
  spread.low_95 = -spread.high_95;
  if (limits.upper >= spread.high_95) return spread;
  spread.high_95 = limits.upper;
  spread.low_95 = find_quantile(calc_below(limits.upper) - kShare * mass);
  return spread;
}

}  // namespace

double calc_log_mass(const TruncatedNormal& distribution) {
  const Standardized limits = standardize(distribution);
  if (!limits.is_far_out()) return std::log(limits.mass());
  const double rate = -limits.upper;
  return std::log(calc_density(0.0)) - 0.5 * rate * rate - std::log(rate) +
         std::log(calc_within(rate, limits.upper - limits.lower));
}

TruncatedSpread find_spread(const TruncatedNormal& distribution) {
  const Standardized limits = standardize(distribution);
  TruncatedSpread spread = find_standard_spread(limits);
  const bool is_cut = spread.high_95 == limits.upper;
  if (limits.is_mirrored) {
    spread.low_95 = -std::exchange(spread.high_95, -spread.low_95);
  }
  const double low = distribution.mean + distribution.sd * spread.low_95;
  const double high = distribution.mean + distribution.sd * spread.high_95;
  const bool ends_at_lower = is_cut && limits.is_mirrored;
  const bool ends_at_upper = is_cut && !limits.is_mirrored;
  return {distribution.sd * spread.sd, ends_at_lower ? distribution.lower : std::fmax(low, distribution.lower),
          ends_at_upper ? distribution.upper : std::fmin(high, distribution.upper)};
}

}  // namespace rollrig::diagnosis
