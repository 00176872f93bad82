#include "proof/case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace rollrig::proof {
namespace {

using diagnosis::Verdict;

/// The parameter that is the size as the generator has it (docs/blind.md, "Effects"), and what makes it that size.
struct SizeParameter {
  const char* name;
  double (*to_generators)(double value, double neutral) = [](double value, double) { return value; };
};

double add_neutral(double value, double neutral) { return value + neutral; }
double subtract_from_neutral(double value, double neutral) { return neutral - value; }
double invert(double value, double) { return 1.0 / value; }
double per_10_min(double per_hour, double) { return per_hour / 6.0; }

const std::map<std::string, SizeParameter>& size_parameters() {
  static const std::map<std::string, SizeParameter> parameters{
      {"bearing_load_friction", {"force_N"}},
      {"brake_drag", {"force_N"}},
      {"brake_heat", {"share_percent"}},
      {"cavity_volume", {"contraction_percent"}},
      {"cell_air_warming", {"rise_dK"}},
      {"clock_shift", {"shift_s"}},
      {"convection_law", {"exponent_deficit", subtract_from_neutral}},
      {"curvature_exponent", {"exponent"}},
      {"driveline_warming", {"force_N"}},
      {"flat_spot", {"excess_percent"}},
      {"inertia_error", {"error_percent"}},
      {"load_cross_talk", {"angle_mrad"}},
      {"load_exponent", {"exponent"}},
      {"load_record", {"error_percent"}},
      {"pressure_exponent", {"exponent_shift", add_neutral}},
      {"pressure_record", {"offset_kPa"}},
      {"rim_heat", {"conductance_W_per_K"}},
      {"rubber_memory", {"excess_percent"}},
      {"slip_loss", {"compliance_per_kN", invert}},
      {"slow_leak", {"rate_kPa_per_h"}},
      {"speed_record", {"error_percent"}},
      {"standing_wave", {"force_N"}},
      {"surface_warming", {"rise_dK"}},
      {"tie_down_load", {"added_load_N"}},
      {"tire_loss_in_skim", {"force_N"}},
      {"toe_camber_drag", {"force_N"}},
      {"torque_gain", {"gain_percent"}},
      {"torque_zero_drift", {"drift_N_per_h", per_10_min}},
      {"wind_and_grade", {"wind_m_s"}},
      {"windage", {"force_N"}},
  };
  return parameters;
}

bool holds(const std::vector<std::string>& all, const std::string& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

}  // namespace

double probability_of(const diagnosis::Diagnosis& diagnosis, const std::string& name) {
  const auto at = diagnosis.probability.find(name);
  return at == diagnosis.probability.end() ? 0.0 : at->second;
}

std::vector<std::string> Case::named_set() const {
  if (!has_cause()) return {};
  std::vector<std::string> all = cause().effects;
  all.insert(all.end(), cause().indistinguishable_from.begin(), cause().indistinguishable_from.end());
  return all;
}

bool Case::names_truth() const {
  if (truth.effects.empty()) return false;
  const std::vector<std::string> all = named_set();
  return all.size() <= kLargestNamedSet &&
         std::all_of(truth.effects.begin(), truth.effects.end(),
                     [&all](const TrueEffect& effect) { return holds(all, effect.id); });
}

bool Case::is_exact() const {
  if (!is(Verdict::kExplained) || !has_cause() || cause().effects.size() != truth.effects.size()) return false;
  return std::all_of(truth.effects.begin(), truth.effects.end(),
                     [this](const TrueEffect& effect) { return holds(cause().effects, effect.id); });
}

bool Case::is_wrong_above(double probability) const {
  return has_cause() && cause().probability > probability && !names_truth();
}

bool Case::is_right_above(double probability) const {
  return has_cause() && cause().probability > probability && names_truth();
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
  if (is_clean()) return is(Verdict::kNoGap);
  return truth.outside ? is(Verdict::kUnexplained) : is_named();
}

Stated Case::stated() const {
  if (is(Verdict::kExplained) && has_cause()) return {cause().probability, is_right()};
  return {probability_of(answer.diagnosis, is(Verdict::kNoGap) ? "none" : "unknown"), is_right()};
}

std::string Case::said() const {
  if (!answer.failure.empty()) return "failed";
  if (is(Verdict::kNoGap)) return "no gap";
  if (is(Verdict::kUnexplained) || !has_cause()) return "unexplained";
  return is_named() ? truth.name() : fmt::format("{}", fmt::join(cause().effects, "+"));
}

std::optional<SizeCheck> Case::check_size() const {
  if (!is_single() || !has_cause() || !is_exact()) return std::nullopt;
  const TrueEffect& effect = truth.effects.front();
  const auto known = size_parameters().find(effect.id);
  if (known == size_parameters().end() || std::isnan(effect.size)) return std::nullopt;
  const std::string name = effect.id + "." + known->second.name;
  for (const diagnosis::ParameterEstimate& parameter : cause().parameters) {
    if (parameter.name != name) continue;
    const auto convert = [&](double value) { return known->second.to_generators(value, effect.neutral); };
    const auto [low, high] = std::minmax({convert(parameter.low_95), convert(parameter.high_95)});
    const double whole = std::isfinite(effect.neutral) ? std::abs(effect.size - effect.neutral) : std::abs(effect.size);
    return SizeCheck{std::abs(convert(parameter.value) - effect.size) / whole,
                     low <= effect.size && effect.size <= high};
  }
  return std::nullopt;
}

}  // namespace rollrig::proof
