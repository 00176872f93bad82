#include "diagnosis/output/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/erase.hpp>
#include <cmath>

#include "diagnosis/terms/term.h"
#include "sim/core/columns.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::diagnosis {
namespace {

constexpr std::size_t kLabelColumns = 12;
constexpr int kWorthTelling_sd = 1;  // of moves of the files' numbers
constexpr std::size_t kMostMoves = 4;

std::size_t text_width() { return terminal_columns() - kLabelColumns - 2; }

/// In full, on as many lines as it needs.
std::string line(const std::string& label, const std::string& text) {
  return text_columns({{fmt::format("{:<{}}", label, kLabelColumns), text}}, {false, 0});
}

/// As many items as fit into `width` characters, then how many more there are.
std::string join_to_fit(const std::vector<std::string>& items, const char* separator, std::size_t width) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string next = (i == 0 ? "" : separator) + items[i];
    const std::size_t left = items.size() - i - 1;
    const std::string more = left == 0 ? "" : fmt::format(" and {} more", left);
    if (i > 0 && count_characters(text + next + more) > width) return text + fmt::format(" and {} more", left + 1);
    text += next;
  }
  return text;
}

/// A channel in one word: the last of its name, or what has the temperature.
std::string short_name(const std::string& channel) {
  return last_part(boost::erase_last_copy(plain_name(channel), " temperature"), ' ');
}

std::string with_unit(const std::string& number, const std::string& unit) {
  return unit.empty() ? number : number + " " + unit;
}

std::string verdict_line(const Findings& findings) {
  const std::string none = show_probability(probability_of(findings, "none"));
  const std::string unknown = show_probability(probability_of(findings, "unknown"));
  const bool named = !findings.causes.empty();
  switch (findings.verdict) {
    case Verdict::kNoGap:
      if (findings.nothing_detectable.has_value()) {
        return line("Verdict", fmt::format("no gap beyond the noise, probability {} (no effect at all {})",
                                           show_probability(*findings.nothing_detectable), none));
      }
      return line("Verdict", fmt::format("no gap {}, probability {}",
                                         findings.trace.has_value() ? "that matters" : "beyond the noise", none));
    case Verdict::kExplained: {
      const std::string own = named ? show_probability(findings.causes.front().probability) : "0 %";
      const std::string text = fmt::format("explained, probability {} (none {}, unknown {})", own, none, unknown);
      if (count_characters(text) <= text_width()) return line("Verdict", text);
      return line("Verdict", fmt::format("explained, probability {} (unknown {})", own, unknown));
    }
    case Verdict::kUnexplained:
      if (!findings.doubt.empty()) return line("Verdict", "unexplained: the files are in doubt, before any physics");
      if (named && (!findings.causes.front().adequate || !findings.causes.front().companions.empty())) {
        return line("Verdict", "unexplained: looks like this cause, but something else is missing");
      }
      return line("Verdict", fmt::format("unexplained: outside the catalog, probability {}", unknown));
  }
  return {};
}

/// "fall 0.0192 1/K"
std::string describe_size(const ParameterEstimate& size) {
  const std::string key = last_part(size.name);
  return fmt::format("{} {}", plain_name(key), with_unit(fmt::format("{:.3g}", size.value), size.unit));
}

/// An effect with its size and the interval of that, as far as they are known.
std::string describe_effect(const std::string& effect, const Cause& cause, const std::string& behind_name = "") {
  const ParameterEstimate* size = find_size(cause, effect);
  if (size == nullptr) return effect + behind_name;
  return fmt::format("{}{}: {} (95 %: {:.3g} to {:.3g}){}", effect, behind_name, describe_size(*size), size->low_95,
                     size->high_95, describe_limit(*size));
}

/// What a cause changes: "0.21 % of the energy, 0.12 noise floors".
std::string describe_change(const CauseChange& change) {
  const std::string floors = fmt::format("{:.2f} noise floors", change.floors);
  if (!change.energy_percent.has_value()) return floors;
  return fmt::format("{:.2g} % of the energy, {}", *change.energy_percent, floors);
}

/// Of a cause that is too small to matter: its effects with their sizes, what they change, how likely they are.
std::string trace_line(const Cause& trace) {
  std::vector<std::string> effects;
  for (const std::string& effect : trace.effects) effects.push_back(describe_effect(effect, trace));
  std::string text = fmt::format("a trace of {}", fmt::join(effects, " with "));
  if (!trace.indistinguishable_from.empty()) {
    text += fmt::format(", or {} {}", trace.effects.size() > 1 ? "in place of one or more of them" : "as well",
                        fmt::join(trace.indistinguishable_from, ", "));
  }
  text += ", too small to matter";
  if (trace.change.has_value()) text += fmt::format(" ({})", describe_change(*trace.change));
  return line("Cause", fmt::format("{}; probability {}", text, show_probability(trace.probability)));
}

/// An effect of a cause with its size; where the cause has several, with the probability that this one acts.
std::string describe_member(std::size_t i, const Cause& cause, const Findings& findings) {
  const std::string& effect = cause.effects[i];
  if (cause.effects.size() == 1) return describe_effect(effect, cause);
  return describe_effect(effect, cause, fmt::format(" ({})", show_probability(probability_of(findings, effect))));
}

std::string cause_line(const Findings& findings) {
  if (findings.trace.has_value() && findings.verdict == Verdict::kNoGap) return trace_line(*findings.trace);
  if (findings.verdict == Verdict::kNoGap) return line("Cause", "none needed");
  if (findings.causes.empty()) return line("Cause", "none of the catalog");
  const Cause& cause = findings.causes.front();
  return line("Cause", describe_member(0, cause, findings));
}

std::string describe_alternatives(const Cause& cause) {
  const std::string why =
      cause.effects.size() > 1 ? " in place of one or more of them (this set cannot tell)" : " (this set cannot tell)";
  return join_to_fit(cause.indistinguishable_from, ", ", text_width() - why.size()) + why;
}

/// Why the files cannot be right, in full.
std::string doubt_lines(const Findings& findings) {
  return line("Cause", "none is named until this is corrected:") + line("", findings.doubt);
}

/// What an effect outside the catalog is like; empty where that is not known, or nothing is unexplained.
std::string likeness_line(const Findings& findings) {
  if (findings.verdict != Verdict::kUnexplained || !findings.unknown_like.has_value()) return {};
  const Likeness& like = *findings.unknown_like;
  const std::string beside = like.beside.empty() ? "" : fmt::format(", beside {}", fmt::join(like.beside, " and "));
  return line("It is like", fmt::format("{}{} ({})", like.text, beside, show_probability(like.probability)));
}

/// What acts beside the first effect; else what may act in its place; else what it is.
std::string second_line(const Findings& findings) {
  if (findings.verdict == Verdict::kNoGap) {
    return line("", "the simulation stands, within the uncertainty of its numbers");
  }
  if (findings.causes.empty()) return line("", "see where the gap lies, and which equation misses something");
  const Cause& cause = findings.causes.front();
  std::string more;
  for (std::size_t i = 1; i < cause.effects.size(); ++i) {
    more += line("  with", describe_member(i, cause, findings));
  }
  if (!more.empty()) return more;
  if (!cause.indistinguishable_from.empty()) return line("or as well", describe_alternatives(cause));
  const Term* term = look_up_term(cause.effects.front());
  return line("", term != nullptr ? term->info().summary : cause.effects.front());
}

/// "acts 98 %, alone 90 %; else most likely with load_exponent 3 %, slip_loss 2 %"; empty where it acts alone.
std::string alone_line(const Findings& findings) {
  if (findings.verdict == Verdict::kNoGap || findings.causes.empty()) return {};
  const Cause& cause = findings.causes.front();
  if (!cause.alone.has_value() || cause.partners.empty()) return {};
  std::vector<std::string> partners;
  for (const Partner& partner : cause.partners) {
    partners.push_back(fmt::format("{} {}", partner.effect, show_probability(partner.probability)));
  }
  const std::string text =
      cause.indistinguishable_from.empty()
          ? fmt::format("acts {}, alone {}", show_probability(*cause.acts), show_probability(*cause.alone))
          : fmt::format("one of these and nothing else {}", show_probability(cause.complete.value_or(*cause.alone)));
  return line(cause.effects.size() == 1 ? "  alone" : "  these alone",
              text + "; else with " + join_to_fit(partners, ", ", text_width() - 8));
}

std::string where_line(const Findings& findings) {
  if (findings.where.empty()) {
    return line("Where", findings.verdict == Verdict::kNoGap ? "nowhere above the noise" : "no stretch stands out");
  }
  const Location& at = findings.where.front();
  const std::string size = fmt::format(": {} (z {:.1f}), {:.0f} % of gap",
                                       with_unit(fmt::format("{:+.2g}", at.size), at.unit), at.z, at.share_percent);
  const std::string place = fmt::format("{} in {}, {}", short_name(at.channel), at.run, at.phase);
  return line("Where", place + size);
}

std::string equation_line(const Findings& findings) {
  if (findings.balance.empty())
    return line("Equation", findings.verdict == Verdict::kNoGap ? "none needs a perturbation" : "none stands out");
  std::vector<std::string> shares;
  for (const BalanceShare& share : findings.balance) {
    shares.push_back(fmt::format("{} {:.0f} %", share.name, share.share_percent));
  }
  return line("Equation", join_to_fit(shares, ", ", text_width()));
}

/// Two digits, and no more than two behind the point.
std::string short_number(double value) {
  return std::abs(value) < 0.995 ? fmt::format("{:.2f}", value) : fmt::format("{:.2g}", value);
}

/// A whole number of percent, without a sign on zero.
std::string whole(double percent) { return fmt::format("{:.0f}", std::round(percent) + 0.0); }

std::string gap_lines(const Findings& findings) {
  const Gap& gap = findings.gap;
  std::string floors = fmt::format("{:.1f} noise floors as calibrated, {:.1f} recalibrated", gap.as_calibrated.before,
                                   gap.recalibrated.before);
  const bool is_caused = !findings.causes.empty() && findings.verdict != Verdict::kNoGap;
  if (is_caused) floors += fmt::format(", {:.1f} with cause", gap.recalibrated.after);
  std::vector<std::string> channels;
  for (const ChannelGap& at : gap.channels) {
    channels.push_back(
        fmt::format("{} {}->{} {}", short_name(at.channel), short_number(at.before), short_number(at.after), at.unit));
  }
  const std::string units = channels.empty() ? "no channel is compared" : join_to_fit(channels, ", ", text_width());
  return line("Gap", floors) + line("  in units", units);
}

/// Whether the lines above say a torque in N.
bool tells_torque_as_force(const Findings& findings) {
  const auto is_told = [](const std::string& channel, const std::string& unit) {
    return short_name(channel) == "torque" && unit == "N";
  };
  const std::vector<ChannelGap>& channels = findings.gap.channels;
  return (!findings.where.empty() && is_told(findings.where.front().channel, findings.where.front().unit)) ||
         std::any_of(channels.begin(), channels.end(),
                     [&is_told](const ChannelGap& at) { return is_told(at.channel, at.unit); });
}

/// "91 % (84 to 96)"
std::string show_share(double percent, const std::array<double, 2>& ci95_percent) {
  return fmt::format("{} % ({} to {})", whole(percent), whole(ci95_percent[0]), whole(ci95_percent[1]));
}

/// What the cause is judged on: "3 held out".
std::string describe_judge(const Gap& gap) {
  if (gap.judged_by == JudgedBy::kStretches) return "stretches held out";
  return fmt::format("{} held out", gap.judged_on.size());
}

/// The same by the other ways of judging it, and for the energy of a run.
std::string side_by_side_lines(const Gap& gap) {
  std::string text;
  std::vector<std::string> parts;
  const auto add = [&parts](const std::optional<Shrinkage>& by, const char* on) {
    if (by.has_value() && by->percent.has_value()) {
      parts.push_back(fmt::format("{} on {}", show_share(*by->percent, by->ci95_percent), on));
    }
  };
  if (gap.judged_by != JudgedBy::kStretches) add(gap.stretches, "stretches");
  add(gap.fitted, "fitted data");
  if (!parts.empty()) text += line("  else", fmt::format("{}", fmt::join(parts, ", ")));
  const std::optional<Shrinkage>& judge = gap.judged_by == JudgedBy::kRuns ? gap.runs : gap.stretches;
  if (gap.judged_by != JudgedBy::kNothing && judge.has_value() && judge->energy_percent.has_value()) {
    text += line("  energy", fmt::format("of a run is off by {:.2g} %, with the cause by {:.2g} %",
                                         judge->energy_percent->before, judge->energy_percent->after));
  }
  return text;
}

/// How much likelier the cause makes what was left out.
std::string likelier_line(const Gap& gap) {
  if (!gap.left_out_nats.has_value()) return {};
  return line("  predicted", fmt::format("{} and numbers of the files, each from the rest, are {} likelier with the "
                                         "cause",
                                         gap.held_out.empty() ? "stretches" : "runs", show_factor(*gap.left_out_nats)));
}

/// Runs that do not count, and what they alone hold.
std::string not_judged_line(const Gap& gap) {
  if (gap.not_judged.empty()) return {};
  std::vector<std::string> runs;
  for (const UnjudgedRun& at : gap.not_judged) {
    runs.push_back(at.alone_in.empty() ? at.run
                                       : fmt::format("{} (alone in {})", at.run, fmt::join(at.alone_in, ", ")));
  }
  return line("Not judged",
              join_to_fit(runs, ", ", 2 * text_width()) +
                  (runs.size() == 1 ? ": cannot be judged without it" : ": cannot be judged without them"));
}

std::string shrinkage_line(const Findings& findings) {
  const Gap& gap = findings.gap;
  std::vector<std::string> parts;
  if (gap.shrink_percent.has_value()) {
    parts.push_back(
        fmt::format("{} on {}", show_share(*gap.shrink_percent, gap.shrink_ci95_percent), describe_judge(gap)));
  } else if (findings.verdict == Verdict::kUnexplained && findings.causes.empty()) {
    parts.emplace_back("no cause to shrink it by");
  } else if (findings.verdict != Verdict::kNoGap && gap.judged_by == JudgedBy::kNothing) {
    parts.emplace_back("unknown: nothing can judge it");
  } else {
    parts.emplace_back("nothing above the noise to shrink");
  }
  if (gap.recalibration_percent.has_value()) {
    parts.push_back("recalibration " + whole(*gap.recalibration_percent) + " %");
  }
  if (gap.black_box_percent.has_value()) parts.push_back("black box " + whole(*gap.black_box_percent) + " %");
  const bool is_caused = !findings.causes.empty() && findings.verdict != Verdict::kNoGap;
  return line("Shrinks by", fmt::format("{}", fmt::join(parts, ", "))) +
         (is_caused ? side_by_side_lines(gap) + likelier_line(gap) : "");
}

/// The numbers of the files that moved furthest: with the cause where one is shown, else in the recalibration.
std::string moved_line(const Findings& findings) {
  std::vector<std::string> moved;
  const bool is_caused = !findings.base_numbers.empty() && findings.base_numbers.front().with_cause.has_value();
  for (const BaseNumber& base : findings.base_numbers) {
    const double by_sd = base.with_cause_moved_sd.value_or(base.moved_sd);
    if (std::abs(by_sd) >= kWorthTelling_sd) moved.push_back(fmt::format("{} {:+.1f} sd", last_part(base.name), by_sd));
  }
  const std::string none = fmt::format("no number of the files by more than {} standard uncertainty", kWorthTelling_sd);
  const std::string when = is_caused ? " with the cause" : "";
  if (moved.empty()) return line("Moved", none + when);
  const std::size_t told = std::min(moved.size(), kMostMoves);
  const std::string more = told < moved.size() ? fmt::format(" and {} more", moved.size() - told) : "";
  moved.resize(told);
  return line("Moved", fmt::format("{}{}{}", fmt::join(moved, ", "), more, when));
}

/// The uncertainties that are assumed, as shares of the numbers; empty where the files give them all.
std::string assumed_line(const Findings& findings) {
  std::vector<std::string> assumed;
  bool is_class = false;
  for (const BaseNumber& base : findings.base_numbers) {
    if (base.sd_source == SdSource::kFile) continue;
    is_class = is_class || base.sd_source == SdSource::kClass;
    const std::string size = base.value != 0.0 ? fmt::format("{:.2g} %", 100.0 * std::abs(base.sd / base.value))
                                               : with_unit(fmt::format("{:.2g}", base.sd), base.unit);
    assumed.push_back(last_part(base.name) + " " + size);
  }
  if (assumed.empty()) return {};
  const std::string why = is_class ? "as class values: " : "no _sd in the files: ";
  return line("Assumed", why + join_to_fit(assumed, ", ", text_width() - why.size()));
}

/// What the command left out of the comparison; empty where nothing was.
std::string restriction_line(const Findings& findings) {
  const std::string text = describe_restriction(findings, [](const std::string& id) { return id; });
  return text.empty() ? text : line("Compared", text);
}

std::string next_line(const Findings& findings) {
  if (findings.next_tests.empty()) return line("Next test", "none would tell more");
  const NextTest& next = findings.next_tests.front();
  const std::string gain = fmt::format(" ({:.1g} bits/h)", next.expected_bits_per_hour);
  return line("Next test", next.test + gain);
}

std::string describe_rest(const LoneRun& lone) {
  const std::string probability = ", probability " + show_probability(lone.probability);
  if (lone.verdict == Verdict::kNoGap) return "no gap beyond the noise" + probability;
  const std::string verdict = lone.verdict == Verdict::kExplained ? "explained by " : "unexplained, looks like ";
  if (lone.effects.empty()) return "unexplained as well";
  return fmt::format("{}{}{}", verdict, fmt::join(lone.effects, " with "), probability);
}

}  // namespace

double probability_of_verdict(const Findings& findings) {
  if (findings.verdict == Verdict::kNoGap) {
    return findings.nothing_detectable.value_or(probability_of(findings, "none"));
  }
  const bool is_explained = findings.verdict == Verdict::kExplained && !findings.causes.empty();
  return is_explained ? findings.causes.front().probability : probability_of(findings, "unknown");
}

std::string show_probability(double probability) {
  if (probability > 0.99 && probability < 1.0) return "over 99 %";
  if (probability < 0.01 && probability > 0.0) return "under 1 %";
  return fmt::format("{:.0f} %", 100.0 * probability);
}

std::string describe_restriction(const Findings& findings, const std::function<std::string(const std::string&)>& name) {
  const auto join = [&name](const std::vector<std::string>& ids) {
    std::vector<std::string> names;
    for (const std::string& id : ids) names.push_back(name(id));
    return fmt::format("{}", fmt::join(names, ", "));
  };
  std::string text;
  if (!findings.only.empty()) text = "only " + join(findings.only);
  if (!findings.without.empty()) text += (text.empty() ? "all but " : ", without ") + join(findings.without);
  return text;
}

std::string show_factor(double nats) {
  const double factor = std::exp(std::min(nats, 100.0));
  if (factor > 1e6) return "over a million times";
  if (factor < 0.01) return "less than 0.01 times";
  return factor >= 10.0 ? fmt::format("{:.0f} times", factor) : fmt::format("{:.2g} times", factor);
}

std::string format_summary(const Findings& findings) {
  const bool in_doubt = !findings.doubt.empty();
  std::string text =
      verdict_line(findings) +
      (in_doubt ? doubt_lines(findings)
                : cause_line(findings) + second_line(findings) + alone_line(findings) + likeness_line(findings)) +
      restriction_line(findings) + where_line(findings) + equation_line(findings) + gap_lines(findings) +
      shrinkage_line(findings);
  text += line("Not excluded", findings.not_excluded.empty() ? "nothing: each effect at its usual size would have shown"
                                                             : join_to_fit(findings.not_excluded, ", ", text_width()));
  text += next_line(findings);
  if (!findings.base_numbers.empty()) text += moved_line(findings) + assumed_line(findings);
  if (tells_torque_as_force(findings)) text += line("Torque", "in N, as force at the drum's surface");
  if (!findings.causes.empty()) {
    const Cause& first = findings.causes.front();
    if (first.effects.size() > 1 && !first.indistinguishable_from.empty()) {
      text += line("Or as well", describe_alternatives(first));
    }
    if (findings.verdict != Verdict::kNoGap) text += not_judged_line(findings.gap);
    for (const std::string& objection : first.objections) text += line("But", objection);
    for (const std::string& companion : first.companions) {
      text += line("Beside it", "the best fit adds an effect that is not named: " + companion);
    }
  }
  if (const auto& lone = findings.without_run) {
    const bool several = lone->run.find(',') != std::string::npos;
    const std::string why = in_doubt ? fmt::format(", which {} in doubt", several ? "are" : "is")
                                     : fmt::format(", which holds {:.0f} % of the gap", lone->share_percent);
    text += line("Without", fmt::format("run{} {}{}: {}", several ? "s" : "", lone->run, why, describe_rest(*lone)));
  }
  if (!findings.next_sensors.empty()) {
    const NextSensor& next = findings.next_sensors.front();
    text += line("Sensor", fmt::format("{} ({:.1g} bits more on an ordinary run, {:.2g} h to fit)", next.sensor,
                                       next.expected_bits, next.hours));
  }
  for (const std::string& warning : findings.warnings) {
    if (warning != findings.doubt) text += line("Warning", warning);
  }
  return text;
}

std::string describe_limit(const ParameterEstimate& estimate) {
  if (estimate.on_limit == RangeLimit::kNone) return {};
  return ", on the limit of its range";
}

}  // namespace rollrig::diagnosis
