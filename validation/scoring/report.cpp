#include "validation/scoring/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/core/text.h"

namespace rollrig::validation {
namespace {

std::string format_cases(const Figure& figure) {
  return figure.interval.has_value() ? fmt::format("{}/{}", figure.k, figure.n) : fmt::format("{}", figure.n);
}

std::string format_target(const Figure& figure) {
  if (!figure.target.has_value()) return "-";
  return fmt::format("{} {}", figure.more_is_better ? ">=" : "<=", format_value(figure, figure.target));
}

/// What an ideal observer would reach, where that is known.
std::string format_upper_bounds(const Score& score) {
  std::string text;
  for (const Figure& figure : score.figures) {
    if (!figure.upper_bound.has_value()) continue;
    text += fmt::format("{} {} {}", text.empty() ? "" : ";", figure.label, format_value(figure, figure.upper_bound));
  }
  return text.empty() ? "" : wrap("An ideal observer would reach:" + text, 0);
}

std::string format_figures(const Score& score) {
  constexpr char kRow[] = "{:<33}{:>6} {:>13} {:>8} {:>9} {:>7}\n";
  std::string text = fmt::format(kRow, "figure", "value", "95 %", "cases", "target", "best b.");
  for (const Figure& figure : score.figures) {
    text += fmt::format(kRow, figure.label, format_value(figure, figure.value), format_interval(figure.interval),
                        figure.value.has_value() ? format_cases(figure) : "", format_target(figure),
                        format_value(figure, figure.best_baseline));
    if (!figure.value.has_value()) text += wrap(figure.note, 4);
  }
  return text + "Shares in %. best b.: the best of the baselines, - where none was run.\n" + format_upper_bounds(score);
}

std::string format_baselines(const Score& score) {
  if (score.baselines.empty()) return "";
  std::string text = fmt::format("\n{:<33}", "baselines");
  for (const BaselineScore& baseline : score.baselines) text += fmt::format(" {:>8}", baseline.id);
  for (const Figure& figure : score.figures) {
    if (!figure.best_baseline.has_value()) continue;
    text += fmt::format("\n{:<33}", figure.label);
    for (const BaselineScore& baseline : score.baselines) {
      text += fmt::format(" {:>8}", format_value(figure, find_value(baseline, figure)));
    }
  }
  return text + '\n';
}

std::string format_tally_row(const std::string& name, const Tally& tally) {
  const double share =
      100.0 * static_cast<double>(tally.named) / static_cast<double>(std::max<std::size_t>(1, tally.cases));
  return fmt::format("{:<24}{:>5} {:>5} {:>5.1f} {:>5} {:>6} {:>6} {:>4} {:>7} {:>5.2f}\n", clip(name, 24), tally.cases,
                     tally.named, share, tally.named_wrong, tally.no_gap, tally.unexplained, tally.failed,
                     fmt::format("{},{}", tally.right_above, tally.wrong_above), tally.mean_named_set());
}

std::string format_tallies(const std::string& title, const Tallies& tallies) {
  if (tallies.empty()) return "";
  std::string text = fmt::format("\n{:<24}{:>5} {:>5} {:>5} {:>5} {:>6} {:>6} {:>4} {:>7} {:>5}\n", title, "cases",
                                 "named", "%", "other", "no gap", "unexp.", "fail", "> 0.9", "set");
  for (const auto& [name, tally] : tallies) text += format_tally_row(name, tally);
  return text;
}

std::string format_confusion(const Confusion& confusion) {
  std::string text = "\nConfusion (true: said, where that is another)\n";
  for (const auto& [truth, row] : confusion) {
    std::string others;
    for (const auto& [said, count] : row) {
      const bool is_right = said == truth || (truth == "none" && said == "no gap");
      if (!is_right) others += fmt::format("{}{} {}", others.empty() ? "" : ", ", said, count);
    }
    if (!others.empty()) text += wrap(fmt::format("{}: {}", truth, others), 2);
  }
  return text;
}

std::string format_reliability(const Reliability& reliability) {
  std::string text = fmt::format("\n{:<12}{:>6} {:>10} {:>8} {:>14}\n", "stated", "cases", "mean", "right", "95 %");
  for (std::size_t i = 0; i < reliability.size(); ++i) {
    const ReliabilityBin& bin = reliability[i];
    if (bin.cases == 0) continue;
    text += fmt::format("{:<12}{:>6} {:>8.1f} % {:>6.1f} % {:>14}\n", fmt::format("{} to {} %", 10 * i, 10 * (i + 1)),
                        bin.cases, 100.0 * bin.mean_probability, 100.0 * bin.right_share(),
                        format_interval(calc_wilson_95(bin.right, bin.cases)));
  }
  return text;
}

std::string format_missed(const std::vector<Case>& missed) {
  if (missed.empty()) return "\nNone was missed.\n";
  std::string text = fmt::format("\nMissed: {} cases\n", missed.size());
  for (const Case& one : missed) {
    text += wrap(describe_truth(one), 2) + wrap(describe_answer(one), 4);
  }
  return text;
}

}  // namespace

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

std::string format_score(const Score& score) {
  std::string text = fmt::format("{} cases\n", score.cases) + format_figures(score) + format_baselines(score);
  for (const std::string& warning : score.warnings) text += wrap("warning: " + warning, 0);
  text += format_tallies("effect", score.by_effect) + format_tally_row("all effects", score.all_effects);
  text += format_tallies("campaign", score.by_campaign) + format_tallies("size", score.by_size_class);
  text += wrap(
      "named: the truth is the first cause, in a set of at most three; other: another cause stands there; > 0.9: how "
      "many causes stated above 0.9 are right, and how many wrong; set: mean size of the named set.",
      0);
  return text + format_confusion(score.confusion) + format_reliability(score.reliability) + format_follow_ups(score) +
         format_missed(score.missed);
}

}  // namespace rollrig::validation
