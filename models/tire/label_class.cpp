#include "models/tire/label_class.h"

#include <fmt/format.h>

#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <utility>

#include "sim/core/limits.h"

namespace rollrig::models {
namespace {

constexpr double kStep = 1e-4;     // 0.1 N/kN, to which an RRc is declared
constexpr double kSlack = 1e-6;    // of a step: what a binary number lacks of a decimal one
constexpr double kPerKilo = 1e-3;  // N/N in a N/kN

/// How far a standard normal number lies below z.
double calc_normal_share(double z) { return boost::math::cdf(boost::math::normal_distribution<double>(), z); }

/// Where an RRc is below those of a class, the bound that it is below; else nothing.
std::string compare_with_least(TireClass tire_class, double rrc) {
  constexpr double kLeastShare = 0.6;
  const double least = kLeastShare * list_label_bounds(tire_class).front();
  if (is_at_least(rrc, least)) return "";
  return fmt::format("below {:g} N/kN, {:g} times the upper bound of label class A", least / kPerKilo, kLeastShare);
}

}  // namespace

std::optional<RrcMistake> find_rrc_mistake(double rrc) {
  const auto is_of_a_tire = [](double one) {
    return is_at_least(one, kLowestTireRrc) && is_at_most(one, kHighestTireRrc);
  };
  if (is_of_a_tire(rrc)) return std::nullopt;
  std::string hint;
  for (const auto& [factor, unit] : {std::pair{1e3, "N/N"}, std::pair{10.0, "percent"}, std::pair{0.1, "0.1 N/kN"}}) {
    if (!hint.empty() || !is_of_a_tire(rrc * factor)) continue;
    hint = fmt::format("; {:g} in {} is {:g} N/kN", rrc / kPerKilo, unit, rrc * factor / kPerKilo);
  }
  return RrcMistake{fmt::format("no tire has an RRc of {:g} N/kN", rrc / kPerKilo),
                    fmt::format("{:g} to {:g} N/kN, which is kg/t{}", kLowestTireRrc / kPerKilo,
                                kHighestTireRrc / kPerKilo, hint)};
}

double round_declared_rrc(double rrc) { return std::floor(rrc / kStep + 0.5 + kSlack) * kStep; }

std::array<double, kLabelClassCount - 1> list_label_bounds(TireClass tire_class) {
  std::array<double, kLabelClassCount - 1> bounds{6.5, 7.7, 9.0, 10.5};
  if (tire_class == TireClass::kC2) bounds = {5.5, 6.7, 8.0, 9.2};
  if (tire_class == TireClass::kC3) bounds = {4.0, 5.0, 6.0, 7.0};
  for (double& bound : bounds) bound *= kPerKilo;
  return bounds;
}

std::size_t find_label_class(TireClass tire_class, double rrc) {
  const double declared = round_declared_rrc(rrc);
  std::size_t place = 0;
  for (const double bound : list_label_bounds(tire_class)) {
    if (declared <= bound + 0.5 * kStep) return place;
    ++place;
  }
  return place;
}

std::array<double, kLabelClassCount> calc_label_probabilities(TireClass tire_class, double rrc, double rrc_sd) {
  std::array<double, kLabelClassCount> probabilities{};
  if (!(rrc_sd > 0.0)) {
    probabilities[find_label_class(tire_class, rrc)] = 1.0;
    return probabilities;
  }
  double below = 0.0;
  std::size_t place = 0;
  for (const double bound : list_label_bounds(tire_class)) {
    const double up_to = calc_normal_share((bound + 0.5 * kStep - rrc) / rrc_sd);
    probabilities[place++] = up_to - below;
    below = up_to;
  }
  probabilities[place] = 1.0 - below;
  return probabilities;
}

std::vector<RrcLimit> list_rrc_limits(TireClass tire_class, bool is_severe_snow) {
  const double more = is_severe_snow ? 1.0 : 0.0;
  std::array<double, 2> limits{12.0, 10.5};
  if (tire_class == TireClass::kC2) limits = {10.5, 9.0};
  if (tire_class == TireClass::kC3) limits = {8.0, 6.5};
  return {{1, (limits[0] + more) * kPerKilo}, {2, (limits[1] + more) * kPerKilo}};
}

std::optional<std::string> doubt_class_by_mean(TireClass tire_class, double mean_rrc) {
  const double most = list_rrc_limits(tire_class, false).front().rrc;
  std::string limit = compare_with_least(tire_class, mean_rrc);
  if (!is_at_most(mean_rrc, most)) limit = fmt::format("above {:g} N/kN, the limit of UN R117, stage 1", most / kPerKilo);
  if (limit.empty()) return std::nullopt;
  return fmt::format("the tires of class {} have a mean RRc of {:.2f} N/kN, {}: is the class right?",
                     name_of(tire_class), mean_rrc / kPerKilo, limit);
}

std::optional<std::string> doubt_class_by_rrc(TireClass tire_class, double rrc, bool is_severe_snow) {
  constexpr double kMostShare = 1.5;
  const double most = list_rrc_limits(tire_class, is_severe_snow).front().rrc;
  std::string limit = compare_with_least(tire_class, rrc);
  if (!is_at_most(rrc, kMostShare * most)) {
    limit = fmt::format("more than {:g} times the limit of UN R117, stage 1, {:g} N/kN", kMostShare, most / kPerKilo);
  }
  if (limit.empty()) return std::nullopt;
  return fmt::format("an RRc of {:.4g} N/kN is {}: is the class {} right?", rrc / kPerKilo, limit, name_of(tire_class));
}

double get_highest_laboratory_sd(TireClass tire_class) {
  return (tire_class == TireClass::kC3 ? 0.06 : 0.075) * kPerKilo;
}

}  // namespace rollrig::models
