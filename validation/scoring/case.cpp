#include "validation/scoring/case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace rollrig::validation {
namespace {

using diagnosis::Verdict;

using Conversion = double (*)(double value, double neutral);

/// What makes the generator's size of an effect's own, where they are not the same number (docs/validation_effects.md,
/// "Meaning of a size").
const std::map<std::string, Conversion> kSizeConversions{
    {"convection_law", [](double deficit, double neutral) { return neutral - deficit; }},
    {"pressure_exponent", [](double shift, double neutral) { return neutral + shift; }},
    {"slip_loss", [](double compliance, double) { return 1.0 / compliance; }},
    {"torque_zero_drift", [](double per_hour, double) { return per_hour / 6.0; }},  // per 10 min
};

/// Effects whose size means something else in the generator's law, so that nothing can be compared.
const std::set<std::string> kSizesApart{"bearing_warmup", "gas_heat_transfer", "tire_temperature", "tread_liner_lag"};

/// The effects of a trace, and all that it cannot be told from.
std::vector<std::string> list_trace(const diagnosis::Cause& trace) {
  std::vector<std::string> all = trace.effects;
  all.insert(all.end(), trace.indistinguishable_from.begin(), trace.indistinguishable_from.end());
  return all;
}

}  // namespace

std::vector<std::string> Case::named_set() const {
  if (is(Verdict::kNoGap) && answer.diagnosis.trace.has_value()) return list_trace(*answer.diagnosis.trace);
  return has_cause() ? list_named(answer.diagnosis) : std::vector<std::string>{};
}

Case Case::answered_after(const FollowUp& test) const {
  Case after;
  after.truth = truth;
  if (test.answer.has_value()) after.answer = *test.answer;
  return after;
}

bool Case::is_split_by(const FollowUp& test) const {
  if (!test.answer.has_value()) return false;
  const Case after = answered_after(test);
  return after.is_named() && after.named_set().size() < test.plan.named.size();
}

bool Case::names_truth() const {
  const std::vector<std::string> all = named_set();
  return all.size() <= kLargestNamedSet && truth.is_within(all);
}

bool Case::names_trace() const {
  if (!is(Verdict::kNoGap) || !answer.diagnosis.trace.has_value() || is_clean()) return false;
  const std::vector<std::string> all = list_trace(*answer.diagnosis.trace);
  return all.size() <= kLargestNamedSet && truth.is_within(all);
}

bool Case::is_named_strictly() const {
  const diagnosis::Diagnosis& found = answer.diagnosis;
  return is_named() && (names_trace() ? *found.trace : cause()).effects.size() <= truth.effects.size();
}

bool Case::shows_nothing() const {
  if (is_clean()) return true;
  return d_prime.has_value() ? *d_prime < kDetectable_d_prime : truth.signal_floors < kDetectable_floors;
}

bool Case::is_exact() const {
  return is(Verdict::kExplained) && has_cause() && cause().effects.size() == truth.effects.size() &&
         truth.is_within(cause().effects);
}

std::vector<std::string> Case::claims_above(double probability) const {
  std::vector<std::string> claims;
  if (!is(Verdict::kExplained)) return claims;
  for (const auto& [name, stated] : answer.diagnosis.probability) {
    if (name != "none" && name != "unknown" && stated > probability) claims.push_back(name);
  }
  return claims;
}

std::vector<std::string> Case::false_claims_above(double probability) const {
  std::vector<std::string> claims = claims_above(probability);
  const auto acts = [this](const std::string& name) { return is_true_effect(name); };
  claims.erase(std::remove_if(claims.begin(), claims.end(), acts), claims.end());
  return claims;
}

std::optional<Stated> Case::stated_alone() const {
  if (!is(Verdict::kExplained) || !has_cause() || !cause().alone.has_value()) return std::nullopt;
  return Stated{*cause().alone, is_exact()};
}

std::optional<Stated> Case::stated_acts() const {
  if (!is(Verdict::kExplained) || !has_cause() || !cause().acts.has_value()) return std::nullopt;
  return Stated{*cause().acts, first_cause_acts()};
}

bool Case::is_true_effect(const std::string& id) const {
  const std::vector<std::string> ids = truth.ids();
  return std::count(ids.begin(), ids.end(), id) > 0;
}

bool Case::first_cause_acts() const {
  return std::all_of(cause().effects.begin(), cause().effects.end(),
                     [this](const std::string& effect) { return is_true_effect(effect); });
}

bool Case::names_one_of_two() const {
  if (!is_pair() || !has_cause() || cause().effects.size() != 1) return false;
  return std::any_of(truth.effects.begin(), truth.effects.end(),
                     [this](const TrueEffect& effect) { return effect.id == cause().effects.front(); });
}

double Case::stated_whole() const { return cause().complete.value_or(cause().probability); }

bool Case::is_wrong_above(double probability) const {
  if (!has_cause()) return false;
  const std::vector<std::string> all = list_named(answer.diagnosis);
  const bool any_acts =
      std::any_of(all.begin(), all.end(), [this](const std::string& effect) { return is_true_effect(effect); });
  return (stated_whole() > probability && !names_truth()) || (cause().probability > probability && !any_acts) ||
         (cause().acts.value_or(0.0) > probability && !first_cause_acts());
}

bool Case::is_right_above(double probability) const {
  return has_cause() && stated_whole() > probability && names_truth();
}

std::size_t Case::rank_of_truth() const {
  const std::string& id = truth.effects.front().id;
  const double own = probability_of(answer.diagnosis, id);
  std::size_t rank = 0;
  for (const auto& [name, probability] : answer.diagnosis.probability) {
    if (name != "none" && name != "unknown" && name != id && probability >= own) ++rank;
  }
  return rank;
}

bool Case::is_right() const {
  if (!answer.failure.empty()) return false;
  if (is(Verdict::kNoGap)) return shows_nothing() || names_trace();
  if (is_clean()) return false;
  return truth.outside ? is(Verdict::kUnexplained) : is_named();
}

Stated Case::stated() const {
  if (is(Verdict::kExplained) && has_cause()) return {stated_whole(), is_right()};
  if (is(Verdict::kUnexplained)) return {probability_of(answer.diagnosis, "unknown"), is_right()};
  return {answer.diagnosis.nothing_detectable.value_or(probability_of(answer.diagnosis, "none")), is_right()};
}

std::string Case::said() const {
  if (!answer.failure.empty()) return "failed";
  if (is(Verdict::kNoGap)) return "no gap";
  if (is(Verdict::kUnexplained) || !has_cause()) return "unexplained";
  return is_named() ? truth.name() : fmt::format("{}", fmt::join(cause().effects, "+"));
}

std::vector<diagnosis::Location> Case::scored_locations() const {
  return places.empty() || !answer.failure.empty() ? std::vector<diagnosis::Location>{} : answer.diagnosis.where;
}

std::optional<SizeCheck> Case::check_size() const {
  if (!is_single() || !has_cause() || !is_exact()) return std::nullopt;
  const TrueEffect& effect = truth.effects.front();
  if (kSizesApart.count(effect.id) > 0 || std::isnan(effect.size)) return std::nullopt;
  const auto known = kSizeConversions.find(effect.id);
  const auto convert = [&](double value) {
    return known == kSizeConversions.end() ? value : known->second(value, effect.neutral);
  };
  for (const diagnosis::ParameterEstimate& parameter : cause().parameters) {
    if (parameter.name.rfind(effect.id + ".", 0) != 0) continue;  // the first of an effect's parameters is its size
    const auto [low, high] = std::minmax({convert(parameter.low_95), convert(parameter.high_95)});
    const double whole = std::isfinite(effect.neutral) ? std::abs(effect.size - effect.neutral) : std::abs(effect.size);
    return SizeCheck{std::abs(convert(parameter.value) - effect.size) / whole,
                     low <= effect.size && effect.size <= high};
  }
  return std::nullopt;
}

}  // namespace rollrig::validation
