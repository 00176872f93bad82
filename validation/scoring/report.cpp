#include "validation/scoring/report.h"

#include <fmt/format.h>

#include <cmath>

namespace rollrig::validation {
std::string format_value(const Figure& figure, const std::optional<double>& value) {
  if (!value.has_value()) return "-";
  if (figure.unit == Unit::kPercent) return fmt::format("{:.4g}", std::round(1000.0 * *value) / 10.0);
  if (figure.unit == Unit::kNumber) return fmt::format("{:.3g}", *value);
  return *value < 1.0 ? fmt::format("{:.2f} s", *value) : fmt::format("{:.3g} s", *value);
}

std::string format_interval(const std::optional<Interval>& share) {
  return share.has_value() ? fmt::format("{:.1f} to {:.1f}", 100.0 * share->low, 100.0 * share->high) : "";
}

std::optional<double> find_value(const BaselineScore& baseline, const Figure& figure) {
  const auto at = baseline.values.find(figure.id);
  return at == baseline.values.end() ? std::nullopt : std::optional<double>(at->second);
}

std::string describe_truth(const Case& one) {
  std::string text = fmt::format("{} {}", one.truth.number, one.truth.campaign);
  for (const TrueEffect& effect : one.truth.effects) {
    text += fmt::format(", {} {:.3g} {}", effect.id, effect.size, effect.unit);
    if (!effect.size_class.empty()) text += fmt::format(" ({})", effect.size_class);
  }
  if (one.is_clean()) text += ", no effect";
  if (one.truth.outside) text += ", outside of the catalog";
  text += fmt::format("; signal {:.2f} noise floors", one.truth.signal_floors);
  if (one.d_prime.has_value()) text += fmt::format(", d' {:.1f}", *one.d_prime);
  return text;
}

std::string describe_answer(const Case& one) {
  if (!one.answer.failure.empty()) return "failed: " + one.answer.failure;
  const diagnosis::Diagnosis& answer = one.answer.diagnosis;
  std::string text = fmt::format("{}; none {:.3f}, unknown {:.3f}", one.said(), probability_of(answer, "none"),
                                 probability_of(answer, "unknown"));
  if (one.is_single()) text += fmt::format(", truth {:.3f}", probability_of(answer, one.truth.effects.front().id));
  if (one.has_cause()) {
    const diagnosis::Cause& cause = one.cause();
    text += fmt::format("; first cause {} {:.3f}", fmt::join(cause.effects, "+"), cause.probability);
    if (!cause.indistinguishable_from.empty()) {
      text += fmt::format(", not told from {}", fmt::join(cause.indistinguishable_from, ", "));
    }
    if (!cause.parameters.empty()) {
      const diagnosis::ParameterEstimate& size = cause.parameters.front();
      text += fmt::format(", {:.3g} {} ({:.3g} to {:.3g})", size.value, size.unit, size.low_95, size.high_95);
    }
    for (const std::string& objection : cause.objections) text += "; but " + objection;
  }
  const diagnosis::Gap& gap = answer.gap;
  text += fmt::format("; gap {:.2f} as calibrated, {:.2f} recalibrated, {:.2f} after", gap.as_calibrated.before,
                      gap.recalibrated.before, gap.recalibrated.after);
  return text;
}

}  // namespace rollrig::validation
