#include "diagnosis/terms/hypothesis.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include "diagnosis/terms/machine_terms.h"
#include "sim/core/units.h"

namespace rollrig::diagnosis {
namespace {

using models::Prior;

/// Those of all machines, then those of one.
const std::vector<const Term*>& terms_in_order() {
  static const std::vector<const Term*> all = [] {
    std::vector<const Term*> terms = all_terms();
    terms.insert(terms.end(), all_machine_terms().begin(), all_machine_terms().end());
    return terms;
  }();
  return all;
}

std::size_t place_of(const Term* term) {
  const std::vector<const Term*>& all = terms_in_order();
  return static_cast<std::size_t>(std::find(all.begin(), all.end(), term) - all.begin());
}

struct NormalForm {
  double middle = 0.0;
  double half_width = 1.0;
};

NormalForm normal_form_of(const Prior& prior) {
  if (prior.scale == Prior::Scale::kLog) {
    return {0.5 * (std::log(prior.low) + std::log(prior.high)), 0.5 * (std::log(prior.high) - std::log(prior.low))};
  }
  return {0.5 * (prior.low + prior.high), 0.5 * (prior.high - prior.low)};
}

}  // namespace

std::vector<std::string> Hypothesis::names() const {
  std::vector<std::string> names;
  for (const SignedTerm& one : terms) names.push_back(one.term->name());
  return names;
}

bool contains_all(const std::vector<std::string>& names, const std::vector<std::string>& some) {
  return std::all_of(some.begin(), some.end(),
                     [&](const std::string& name) { return std::count(names.begin(), names.end(), name) > 0; });
}

std::string Hypothesis::name() const { return terms.empty() ? "none" : fmt::format("{}", fmt::join(names(), " + ")); }

bool Hypothesis::contains(const Term& term) const {
  return std::any_of(terms.begin(), terms.end(), [&](const SignedTerm& one) { return one.term == &term; });
}

bool Hypothesis::has_unknown() const {
  return std::any_of(terms.begin(), terms.end(), [](const SignedTerm& one) { return one.term->is_unknown(); });
}

Hypothesis Hypothesis::with(const SignedTerm& added) const {
  Hypothesis more = *this;
  more.terms.push_back(added);
  std::sort(more.terms.begin(), more.terms.end(),
            [](const auto& a, const auto& b) { return place_of(a.term) < place_of(b.term); });
  return more;
}

PriorUnits from_prior_units(const models::EffectParameter& parameter, double u, int sign) {
  const NormalForm form = normal_form_of(parameter.prior);
  double value = form.middle + form.half_width * u;
  double derivative = form.half_width;
  if (parameter.prior.scale == Prior::Scale::kLog) {
    value = sign * std::exp(value);
    derivative *= value;
  } else if (parameter.prior.either_sign) {
    value *= sign;
    derivative *= sign;
  }
  const double factor = unit_of_key(parameter.key).factor;
  return {value * factor, derivative * factor, parameter.range.contains(value)};
}

double to_prior_units(const models::EffectParameter& parameter, double value_SI) {
  constexpr double kFarthest = 3.0;
  const NormalForm form = normal_form_of(parameter.prior);
  constexpr double kInside = 0.01;  // of the range, so that a fit can start there
  const double margin = kInside * (parameter.prior.high - parameter.prior.low);
  double value = value_SI / unit_of_key(parameter.key).factor;
  value = std::clamp(value, parameter.range.lower + margin, parameter.range.upper - margin);
  if (parameter.prior.either_sign) value = std::abs(value);
  if (parameter.prior.scale == Prior::Scale::kLog) value = std::log(std::max(value, 1e-300));
  return std::clamp((value - form.middle) / form.half_width, -kFarthest, kFarthest);
}

std::vector<SizePoint> list_size_points(const models::EffectParameter& size, int sign, double judged_u) {
  constexpr int kPoints = 801;
  constexpr double kReach_sd = 4.0;
  const double off_SI = size.off.value_or(0.0) * unit_of_key(size.key).factor;
  const double judged_SI = from_prior_units(size, judged_u, sign).value_SI - off_SI;
  std::vector<SizePoint> points;
  double sum = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    const double u = kReach_sd * (2.0 * i / (kPoints - 1) - 1.0);
    const PriorUnits at = from_prior_units(size, u, sign);
    if (!at.allowed) continue;
    points.push_back({std::exp(-0.5 * u * u), (at.value_SI - off_SI) / judged_SI});
    sum += points.back().weight;
  }
  for (SizePoint& point : points) point.weight /= sum;
  return points;
}

PriorBounds bounds_in_prior_units(const models::EffectParameter& parameter, int sign) {
  const NormalForm form = normal_form_of(parameter.prior);
  const bool is_log = parameter.prior.scale == Prior::Scale::kLog;
  double lower = parameter.range.lower;
  double upper = parameter.range.upper;
  if (sign < 0) std::tie(lower, upper) = std::pair(-upper, -lower);
  const auto place = [&](double value) {
    return ((is_log ? std::log(std::max(value, 0.0)) : value) - form.middle) / form.half_width;
  };
  constexpr double kInside = 1e-9;  // of a prior unit: a bound itself may be open
  return {place(lower) + kInside, place(upper) - kInside};
}

std::vector<PriorBounds> list_own_bounds(const Hypothesis& hypothesis) {
  std::vector<PriorBounds> bounds;
  for (const auto& [term, sign] : hypothesis.terms) {
    const std::vector<models::EffectParameter>& parameters = term->parameters();
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      bounds.push_back(bounds_in_prior_units(parameters[i], i == 0 ? sign : 1));
    }
  }
  return bounds;
}

std::vector<int> possible_signs(const models::EffectParameter& size) {
  if (size.prior.either_sign) return {1, -1};
  return {1};
}

}  // namespace rollrig::diagnosis
