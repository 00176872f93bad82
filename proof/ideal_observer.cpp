#include "proof/ideal_observer.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <functional>

#include "proof/figures.h"

namespace rollrig::proof {
namespace {

using Chance = std::function<double(const Case&)>;
using Is = std::function<bool(const Case&)>;

double calc_normal_share_below(double deviations) { return cdf(boost::math::normal(), deviations); }

/// Mean chance over the cases of a figure; none where one of them lacks what `is_known` asks for, or there is none.
std::optional<double> find_mean(const std::vector<Case>& cases, const Is& is_of_figure, const Is& is_known,
                                const Chance& chance) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const Case& one : cases) {
    if (!is_of_figure(one)) continue;
    if (!is_known(one)) return std::nullopt;
    sum += chance(one);
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

bool has_d_prime(const Case& one) { return one.d_prime.has_value(); }
bool has_bayes_factors(const Case& one) { return has_d_prime(one) && !one.log_bayes_factors.empty(); }

/// At 1 % false alarms.
double calc_chance_of_detection(const Case& one) {
  constexpr double kAlarm = 2.326;  // quantile of the normal distribution
  return calc_normal_share_below(*one.d_prime - kAlarm);
}

double has_small_set(const Case& one) {
  constexpr double kTold_nats = 3.0;  // as the ceiling's `twins`
  const auto twins = std::count_if(one.log_bayes_factors.begin(), one.log_bayes_factors.end(),
                                   [](double nats) { return nats < kTold_nats; });
  return static_cast<std::size_t>(twins) < kLargestNamedSet ? 1.0 : 0.0;
}

}  // namespace

double calc_chance_among_first(std::size_t places, const std::vector<double>& log_bayes_factors) {
  std::vector<double> ahead{1.0};  // chance of so many others ahead
  for (const double nats : log_bayes_factors) {
    const double chance = calc_normal_share_below(-std::sqrt(0.5 * std::max(0.0, nats)));
    ahead.push_back(0.0);
    for (std::size_t n = ahead.size() - 1; n > 0; --n) {
      ahead[n] = (1.0 - chance) * ahead[n] + chance * ahead[n - 1];
    }
    ahead[0] *= 1.0 - chance;
  }
  double sum = 0.0;
  for (std::size_t n = 0; n < std::min(places, ahead.size()); ++n) sum += ahead[n];
  return sum;
}

void add_ceilings(const std::vector<Case>& cases, const ScoreOptions& options, std::vector<Figure>& figures) {
  const Is is_single = [](const Case& one) { return one.is_single(); };
  const Is is_detectable_single = [&](const Case& one) { return one.is_single() && is_detectable(one, options); };
  const Is is_pair = [](const Case& one) { return one.is_pair(); };
  const Is is_known_pair = [](const Case& one) { return has_d_prime(one) && one.identifiable.has_value(); };
  for (Figure& figure : figures) {
    if (figure.id == "detection") {
      figure.ceiling = find_mean(cases, is_detectable_single, has_d_prime, calc_chance_of_detection);
    } else if (figure.id == "top1_set_aware") {
      figure.ceiling = find_mean(cases, is_detectable_single, has_bayes_factors, has_small_set);
    } else if (figure.id == "top3") {
      figure.ceiling = find_mean(cases, is_single, has_bayes_factors,
                                 [](const Case& one) { return calc_chance_among_first(kTop, one.log_bayes_factors); });
    } else if (figure.id == "pairs") {
      figure.ceiling = find_mean(cases, is_pair, is_known_pair, [&](const Case& one) {
        return is_detectable(one, options) && *one.identifiable ? 1.0 : 0.0;
      });
    }
  }
}

}  // namespace rollrig::proof
