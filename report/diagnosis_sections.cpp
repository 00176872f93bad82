#include <fmt/format.h>

#include <algorithm>

#include "diagnosis/output/explain.h"
#include "diagnosis/output/summary.h"
#include "diagnosis/terms/term.h"
#include "report/blocks.h"
#include "report/diagnosis_page.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

using diagnosis::show_probability;

constexpr double kListed = 0.005;  // probability from which an effect has a bar

std::string summary_of(const std::string& id) {
  if (id == "none") return "no effect is needed";
  if (id == "unknown") return "something outside the catalog";
  const diagnosis::Term* term = diagnosis::look_up_term(id);
  return term != nullptr ? term->info().summary : id;
}

std::string join(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, ", ")); }

/// Names of effects as the page shows them, with `between` between them.
std::string join_effects(const std::vector<std::string>& ids, const char* between = ", ") {
  std::vector<std::string> names;
  for (const std::string& id : ids) names.push_back(name_effect(id));
  return fmt::format("{}", fmt::join(names, between));
}

std::string show_estimate(const ParameterEstimate& at) {
  const std::string unit = at.unit.empty() ? "" : " " + pretty_unit(at.unit);
  return fmt::format("{:.3g}{} (95 %: {:.3g} to {:.3g}){}", at.value, unit, at.low_95, at.high_95,
                     diagnosis::describe_limit(at));
}

std::string describe_shrinkage(const Gap& gap) {
  if (!gap.shrink_percent.has_value()) return "";
  return fmt::format(
      " It takes {:.0f} % of the gap that recalibration leaves ({:.0f} to {:.0f} %) on {} that the fit did not see.",
      *gap.shrink_percent, gap.shrink_ci95_percent[0], gap.shrink_ci95_percent[1],
      gap.judged_by == JudgedBy::kStretches ? "stretches" : "runs");
}

/// A cause that is too small to matter: size, what it changes, probability.
std::string describe_trace(const Cause& trace) {
  std::string text = fmt::format("There is a trace of {}, too small to matter", join_effects(trace.effects, " with "));
  if (!trace.parameters.empty()) {
    text += fmt::format(": {} {}", plain_name(last_part(trace.parameters.front().name)),
                        show_estimate(trace.parameters.front()));
  }
  if (trace.change.has_value()) {
    text += fmt::format("; it changes the readings by {:.2f} noise floors", trace.change->floors);
    if (trace.change->energy_percent.has_value()) {
      text += fmt::format(" and the energy by {:.2g} %", *trace.change->energy_percent);
    }
  }
  return text + fmt::format(" (probability {}).", show_probability(trace.probability));
}

/// One way of judging the cause beside the others.
std::vector<std::string> make_shrinkage_row(const std::string& on, const std::optional<Shrinkage>& by) {
  if (!by.has_value()) return {on, "-", "-", "cannot be judged", "-", "-"};
  const auto show = [](double value) { return fmt::format("{:.2f}", value); };
  const auto show_energy = [&](double GapView::*which) {
    return by->energy_percent.has_value() ? fmt::format("{:.2g} %", (*by->energy_percent).*which) : std::string("-");
  };
  const std::string share = by->percent.has_value() ? fmt::format("{:.0f} % ({:.0f} to {:.0f} %)", *by->percent,
                                                                  by->ci95_percent[0], by->ci95_percent[1])
                                                    : std::string("not above the noise");
  return {on,    show(by->gap.before),          show(by->gap.after),
          share, show_energy(&GapView::before), show_energy(&GapView::after)};
}

Block make_shrinkages(const Gap& gap) {
  Table table{"What the cause takes from the gap, by what it is judged on",
              {"on", "before, floors", "after", "shrinks by (95 %)", "energy of a run off by", "with the cause"},
              {}};
  table.rows.push_back({"the numbers of the files, nothing fitted but the cause",
                        fmt::format("{:.2f}", gap.as_calibrated.before), fmt::format("{:.2f}", gap.as_calibrated.after),
                        "-", "-", "-"});
  table.rows.push_back(make_shrinkage_row("the fitted data, recalibrated", gap.fitted));
  table.rows.push_back(make_shrinkage_row("stretches left out of the fit, likewise", gap.stretches));
  table.rows.push_back(make_shrinkage_row("runs left out of the fit, likewise", gap.runs));
  return make_table(table);
}

Block make_probabilities(const Findings& findings) {
  std::vector<std::pair<double, std::string>> ranked;
  for (const auto& [name, probability] : findings.probability) {
    if (probability >= kListed || name == "none" || name == "unknown") ranked.emplace_back(probability, name);
  }
  std::sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  Json rows = Json::array();
  for (const auto& [probability, name] : ranked) {
    rows.push_back({{"label", name_effect(name)},
                    {"note", summary_of(name)},
                    {"share", rounded(probability)},
                    {"text", show_probability(probability)}});
  }
  const std::size_t others = findings.probability.size() - ranked.size();
  return {
      {"type", "shares"},
      {"caption", fmt::format("Probability that each effect acts. Several may act together, so each bar is a share of "
                              "its own whole. {} more are below {:.1f} %",
                              others, 100.0 * kListed)},
      {"columns", {"effect", "probability"}},
      {"rows", rows}};
}

Block make_ranking(const Findings& findings) {
  Table table{"Causes, the likeliest first", {"cause", "probability", "cannot be told from", "size", "adequate"}, {}};
  for (const Cause& cause : findings.causes) {
    const bool sized = !cause.parameters.empty();
    table.rows.push_back({join_effects(cause.effects, " + "), show_probability(cause.probability),
                          cause.indistinguishable_from.empty() ? "-" : join_effects(cause.indistinguishable_from),
                          sized ? show_estimate(cause.parameters.front()) : "-", cause.adequate ? "yes" : "no"});
  }
  return make_table(table);
}

/// Whether a first cause is shown: named, or only what the gap looks most like.
bool shows_cause(const Findings& findings) { return findings.verdict != Verdict::kNoGap && !findings.causes.empty(); }

/// On what gap.recalibrated is.
const char* name_judge(const Findings& findings) {
  const Gap& gap = findings.gap;
  if (gap.judged_by == JudgedBy::kStretches) return "stretches left out of the fit";
  if (gap.judged_by == JudgedBy::kRuns || (!shows_cause(findings) && !gap.held_out.empty()))
    return "runs left out of the fit";
  return "fitted data";
}

/// The same in a sentence.
std::string describe_judge(const Findings& findings) {
  const Gap& gap = findings.gap;
  if (gap.judged_by == JudgedBy::kStretches) return "Judged on stretches, each left out of the fit in turn.";
  if (gap.held_out.empty()) return "There is one run, so nothing can be left out: judged on the fitted data.";
  if (shows_cause(findings) && gap.judged_by == JudgedBy::kNothing) {
    return "Nothing that is left out is predicted well enough to judge the cause: shown on the fitted data.";
  }
  const std::vector<std::string>& runs = gap.judged_by == JudgedBy::kRuns ? gap.judged_on : gap.held_out;
  return fmt::format("Judged on {}, each left out of the fit in turn: {}.", format_count(runs.size(), "run"),
                     join(runs));
}

Block make_channel_gaps(const Findings& findings) {
  Table table{fmt::format("Gap of each channel, without noise, on {}", name_judge(findings)),
              {"channel", "before", "after", "unit"},
              {}};
  for (const ChannelGap& at : findings.gap.channels) {
    table.rows.push_back(
        {plain_name(at.channel), fmt::format("{:.3f}", at.before), fmt::format("{:.3f}", at.after), at.unit});
  }
  return make_table(table);
}

Block make_explanation(const models::EffectInfo& info) {
  Json items = Json::array();
  const auto add = [&items](const char* term, const std::vector<std::string>& texts, bool is_code = false) {
    if (!texts.empty()) items.push_back({{"term", term}, {"texts", texts}, {"code", is_code}});
  };
  std::vector<std::string> parameters;
  for (const models::EffectParameter& each : info.parameters) {
    parameters.push_back(fmt::format("{}: {}", plain_name(each.key), diagnosis::describe_parameter(each)));
  }
  std::vector<std::string> confusions;
  for (const std::string& id : info.confused_with) confusions.push_back(name_effect(id) + ": " + summary_of(id));
  add("What it is", {info.summary});
  add("On the command line", {info.id}, true);
  items.push_back({{"term", "Equation"}, {"of", "effect " + info.id}});
  add("Source", {info.source});
  add("Own parameters", parameters);
  add("Confused with", confusions);
  add("Separated by", info.splitting_tests);
  return {{"type", "definitions"}, {"title", capitalized(name_effect(info.id))}, {"items", items}};
}

}  // namespace

std::string name_effect(const std::string& id) {
  if (id == "none") return "no effect";
  if (id == "unknown") return "something else";
  return plain_name(id);
}

std::string describe_verdict(const Findings& findings) {
  const bool has_cause = !findings.causes.empty();
  if (findings.verdict == Verdict::kNoGap) {
    const std::string none = show_probability(diagnosis::probability_of(findings, "none"));
    const std::string probability =
        findings.nothing_detectable.has_value()
            ? fmt::format("probability {} that nothing acts which this set would show; {} that nothing acts at all",
                          show_probability(*findings.nothing_detectable), none)
            : "probability " + none;
    return fmt::format("No gap: the simulation meets the measurement within noise and the files' uncertainties ({}).",
                       probability);
  }
  if (!findings.doubt.empty()) return "Unexplained: the files are in doubt, before any physics.";
  if (findings.verdict == Verdict::kUnexplained || !has_cause) {
    const std::string like = has_cause ? fmt::format("; it looks most like {}, but that does not explain it",
                                                     join_effects(findings.causes.front().effects, " with "))
                                       : "";
    return fmt::format("Unexplained: there is a gap that no effect of the catalog follows (probability {}){}.",
                       show_probability(diagnosis::probability_of(findings, "unknown")), like);
  }
  const Cause& cause = findings.causes.front();
  std::string text =
      fmt::format("Explained: measurement and simulation differ by {}", join_effects(cause.effects, " with "));
  const std::string alternatives = join_effects(cause.indistinguishable_from);
  if (!alternatives.empty() && cause.effects.size() == 1) text += " or, as well, " + alternatives;
  if (!alternatives.empty() && cause.effects.size() > 1) text += ", or in place of one or more of them " + alternatives;
  return fmt::format("{} (probability {}).", text, show_probability(cause.probability));
}

namespace {

/// " If something acts beside it, it is most likely rim heat (3 %)."; empty where nothing is likely to.
std::string describe_alone(const Cause& cause) {
  constexpr std::size_t kMost = 3;
  if (!cause.alone.has_value() || cause.partners.empty()) return {};
  std::vector<std::string> partners;
  for (const Partner& partner : cause.partners) {
    if (partners.size() == kMost) break;
    partners.push_back(fmt::format("{} ({})", name_effect(partner.effect), show_probability(partner.probability)));
  }
  if (!cause.indistinguishable_from.empty()) {
    return fmt::format(" One of these and nothing else acts with a probability of {}; else most likely with {}.",
                       show_probability(cause.complete.value_or(*cause.alone)), join(partners));
  }
  return fmt::format(" If something acts beside it, it is most likely {}.", join(partners));
}

}  // namespace

namespace {

/// A summary up to its first semicolon or colon: what the effect is, in a clause.
std::string make_clause(const std::string& summary) { return summary.substr(0, summary.find_first_of(";:")); }

Tile make_cause_tile(const Findings& findings) {
  const bool has_cause = !findings.causes.empty();
  if (findings.verdict == Verdict::kNoGap) return {"Cause", "none", "", "the simulation meets the measurement", "good"};
  if (!findings.doubt.empty()) return {"Cause", "files in doubt", "", "before any physics", "bad"};
  if (findings.verdict == Verdict::kUnexplained || !has_cause) {
    return {"Cause", "unknown", "", "no effect of the catalog follows the gap", "bad"};
  }
  const Cause& cause = findings.causes.front();
  std::vector<std::string> names;
  std::vector<std::string> clauses;
  for (const std::string& id : cause.effects) {
    names.push_back(name_effect(id));
    clauses.push_back(make_clause(summary_of(id)));
  }
  return {"Cause", fmt::format("{}", fmt::join(names, " and ")), "", fmt::format("{}", fmt::join(clauses, "; ")),
          "good"};
}

/// How sure the verdict is.
Tile make_certainty_tile(const Findings& findings) {
  const auto tile = [&findings](const char* note, const std::string& from) {
    return Tile{"How sure", show_probability(diagnosis::probability_of_verdict(findings)), "", note, "", {from}};
  };
  if (findings.verdict == Verdict::kNoGap) {
    if (findings.nothing_detectable.has_value()) {
      return tile("probability that nothing acts which this set would show", "/nothing_detectable");
    }
    return tile("probability that nothing acts", "/probability/none");
  }
  if (findings.verdict == Verdict::kUnexplained || findings.causes.empty()) {
    return tile("probability of something outside the catalog", "/probability/unknown");
  }
  const Cause& cause = findings.causes.front();
  Tile sure = tile("probability that it acts", "/causes/0/probability");
  if (!findings.only.empty()) {
    sure.note += fmt::format(", of the {} that were compared", format_count(findings.only.size(), "cause"));
  }
  if (cause.alone.has_value()) sure.note += fmt::format("; that nothing else does: {}", show_probability(*cause.alone));
  return sure;
}

/// What the gap was and what the cause leaves of it.
std::vector<Tile> make_gap_tiles(const Findings& findings) {
  const GapView& judged = findings.gap.recalibrated;
  const char* where = name_judge(findings);
  const auto show = [](double floors) { return fmt::format("{:.2f}", floors); };
  if (findings.verdict != Verdict::kExplained || findings.causes.empty()) {
    return {{"Gap",
             show(judged.before),
             "noise floors",
             fmt::format("measured minus simulated, over its noise; {}", where),
             "",
             {"/gap/recalibrated/before"}}};
  }
  return {{"Gap before",
           show(judged.before),
           "noise floors",
           fmt::format("measured minus simulated, over its noise; {}", where),
           "",
           {"/gap/recalibrated/before"}},
          {"Gap with the cause",
           show(judged.after),
           "noise floors",
           "likewise; 0: nothing is left",
           "",
           {"/gap/recalibrated/after"}}};
}

/// The residual before and after: the first chart of the page.
Block make_gap_bars(const Findings& findings) {
  const Gap& gap = findings.gap;
  Json series = Json::array({{{"name", "recalibrated"}, {"values", {rounded(gap.recalibrated.before)}}}});
  if (shows_cause(findings)) {
    series.push_back({{"name", "recalibrated, with the cause"}, {"values", {rounded(gap.recalibrated.after)}}});
  }
  return make_bars({"Gap: measured minus simulated, without noise", "noise floors"}, {name_judge(findings)}, series,
                   "One noise floor is the standard deviation of a mean over ten seconds. Recalibrated: the numbers of "
                   "the files are moved within their uncertainties.");
}

}  // namespace

Section make_verdict(const Findings& findings) {
  Section section{"Verdict"};
  std::vector<Tile> tiles{make_cause_tile(findings), make_certainty_tile(findings)};
  for (const Tile& tile : make_gap_tiles(findings)) tiles.push_back(tile);
  const char* tone = findings.verdict == Verdict::kUnexplained ? "bad" : "good";
  std::string more = findings.doubt;
  if (findings.verdict == Verdict::kNoGap && findings.trace.has_value()) more = describe_trace(*findings.trace);
  if (findings.verdict == Verdict::kUnexplained && findings.doubt.empty() && findings.unknown_like.has_value()) {
    const Likeness& like = *findings.unknown_like;
    const std::string beside = like.beside.empty() ? "" : ", beside " + join_effects(like.beside, " and ");
    more = fmt::format("It is like {}{} (probability {}).", like.text, beside, show_probability(like.probability));
  }
  if (findings.verdict == Verdict::kExplained && !findings.causes.empty()) {
    const Cause& cause = findings.causes.front();
    std::string meaning = summary_of(cause.effects.front());
    if (!cause.parameters.empty()) {
      meaning += fmt::format("; {} {}", plain_name(last_part(cause.parameters.front().name)),
                             show_estimate(cause.parameters.front()));
    }
    more = meaning + "." + describe_shrinkage(findings.gap) + describe_alone(cause);
  }
  section.blocks.push_back(make_lead(tone, describe_verdict(findings)));
  section.blocks.push_back(make_tiles(tiles));
  if (!findings.warnings.empty()) section.blocks.push_back(make_warnings(findings.warnings));
  if (findings.verdict != Verdict::kNoGap) section.blocks.push_back(make_gap_bars(findings));  // else no bar is seen
  if (!more.empty()) section.blocks.push_back(make_paragraph(pretty_unit(more)));
  return section;
}

Section make_causes(const Findings& findings) {
  Section section{"Causes"};
  section.blocks.push_back(make_probabilities(findings));
  if (findings.causes.empty()) return section;
  section.blocks.push_back(make_ranking(findings));
  if (!findings.causes.front().parameters.empty()) {
    const Cause& cause = findings.causes.front();
    const std::string title =
        fmt::format("Fitted size of {}, with 95 % interval", join_effects(cause.effects, " and "));
    std::vector<std::string> keys;
    for (const ParameterEstimate& at : cause.parameters) keys.push_back(at.name);
    const std::vector<std::string> names = name_numbers(keys);
    std::vector<ParameterEstimate> parameters = cause.parameters;
    for (std::size_t i = 0; i < parameters.size(); ++i) parameters[i].name = names[i];
    section.blocks.push_back(make_table(make_estimate_table(title, parameters)));
  }
  const std::vector<std::string>& objections = findings.causes.front().objections;
  if (!objections.empty()) {
    section.blocks.push_back(
        {{"type", "text"}, {"paragraphs", Json::array({"Against the first cause speaks:"})}, {"items", objections}});
  }
  return section;
}

Section make_base_numbers(const Findings& findings) {
  Section section{"Numbers of the files",
                  "The recalibration weighs each move by the number's standard uncertainty. Moves are in standard "
                  "uncertainties. An uncertainty is that of the file (key _sd), or it is assumed: the usual one of an "
                  "identified number, or that of a value of the tire's class."};
  const char* sources[] = {"file", "assumed, usual", "assumed, class"};
  Table table{
      "", {"number", "unit", "file", "uncertainty", "from", "recalibrated", "moved", "with the cause", "moved"}, {}};
  const auto show = [](double value) { return fmt::format("{:.4g}", value); };
  const auto show_move = [](double by_sd) { return fmt::format("{:+.1f}", by_sd); };
  std::vector<std::string> keys;
  for (const BaseNumber& base : findings.base_numbers) keys.push_back(base.name);
  const std::vector<std::string> names = name_numbers(keys);
  for (std::size_t i = 0; i < findings.base_numbers.size(); ++i) {
    const BaseNumber& base = findings.base_numbers[i];
    table.rows.push_back({names[i], pretty_unit(base.unit), show(base.value), fmt::format("{:.2g}", base.sd),
                          sources[static_cast<int>(base.sd_source)], show(base.recalibrated), show_move(base.moved_sd),
                          base.with_cause.has_value() ? show(*base.with_cause) : "-",
                          base.with_cause_moved_sd.has_value() ? show_move(*base.with_cause_moved_sd) : "-"});
  }
  section.blocks.push_back(make_table(table));
  return section;
}

Section make_gap(const Findings& findings) {
  const Gap& gap = findings.gap;
  Section section{"Before and after", describe_judge(findings)};
  for (Block& block : make_gap_waterfalls(gap)) section.blocks.push_back(std::move(block));
  const auto percent = [](const std::optional<double>& value) {
    return value.has_value() ? fmt::format("{:.0f} %", *value) : std::string("not above the noise");
  };
  const bool is_unjudged = shows_cause(findings) && gap.judged_by == JudgedBy::kNothing;
  std::string shrinks =
      is_unjudged ? "not known: nothing left out is predicted well enough" : percent(gap.shrink_percent);
  if (gap.shrink_percent.has_value()) {
    shrinks += fmt::format(" ({:.0f} to {:.0f} %)", gap.shrink_ci95_percent[0], gap.shrink_ci95_percent[1]);
  }
  Table shares{"",
               {},
               {{"The cause takes from the recalibrated gap", shrinks},
                {"Recalibration alone takes from the gap", percent(gap.recalibration_percent)},
                {"A smooth function of the inputs takes", percent(gap.black_box_percent)}}};
  if (shows_cause(findings) && gap.left_out_nats.has_value()) {
    shares.rows.push_back({"What was left out is likelier with the cause", diagnosis::show_factor(*gap.left_out_nats)});
  }
  section.blocks.push_back(make_table(shares));
  if (shows_cause(findings) && gap.fitted.has_value()) section.blocks.push_back(make_shrinkages(gap));
  if (shows_cause(findings) && !gap.not_judged.empty()) {
    std::vector<std::string> runs;
    for (const UnjudgedRun& at : gap.not_judged) {
      runs.push_back(at.alone_in.empty() ? at.run : fmt::format("{} (alone in {})", at.run, join(at.alone_in)));
    }
    section.blocks.push_back(
        make_paragraph("Cannot be judged without what they alone say, and do not count: " + join(runs) + "."));
  }
  if (!gap.channels.empty()) section.blocks.push_back(make_channel_gaps(findings));
  return section;
}

Block make_balance(const Findings& findings) {
  Json rows = Json::array();
  for (const BalanceShare& share : findings.balance) {
    rows.push_back({{"label", share.name},
                    {"share", rounded(share.share_percent / 100.0)},
                    {"text", fmt::format("{:.0f} %", share.share_percent)}});
  }
  return {{"type", "shares"},
          {"caption", "Which equation needs a perturbation for the simulation to meet the measurement"},
          {"columns", {"equation", "share of the gap"}},
          {"rows", rows}};
}

Section make_next(const Findings& findings) {
  Section section{"What cannot be told apart, and the test that would"};
  if (!findings.causes.empty() && !findings.causes.front().indistinguishable_from.empty()) {
    const Cause& cause = findings.causes.front();
    const std::string others = join_effects(cause.indistinguishable_from);
    section.blocks.push_back(make_paragraph(
        cause.effects.size() == 1 ? fmt::format("This set cannot tell {} from {}.", join_effects(cause.effects), others)
                                  : fmt::format("This set cannot tell whether {} act together, or {} in place of one "
                                                "or more of them.",
                                                join_effects(cause.effects, " and "), others)));
  }
  section.blocks.push_back(make_paragraph(
      findings.not_excluded.empty()
          ? std::string("Not excluded: nothing; each effect at its usual size would have shown.")
          : "Not excluded, since this set need not show them: " + join_effects(findings.not_excluded) + "."));
  Table tests{"Next tests, the most telling first", {"test", "tells apart", "bits an hour", "hours"}, {}};
  for (const NextTest& next : findings.next_tests) {
    tests.rows.push_back({next.test, next.splits.empty() ? "-" : join_effects(next.splits),
                          fmt::format("{:.2f}", next.expected_bits_per_hour), fmt::format("{:.1f}", next.hours)});
  }
  if (!tests.rows.empty()) section.blocks.push_back(make_table(tests));
  Table sensors{"Sensors that the rig has not", {"sensor", "tells apart", "bits", "hours to fit"}, {}};
  for (const NextSensor& next : findings.next_sensors) {
    sensors.rows.push_back({next.sensor, next.splits.empty() ? "-" : join_effects(next.splits),
                            fmt::format("{:.2f}", next.expected_bits), fmt::format("{:.2g}", next.hours)});
  }
  if (!sensors.rows.empty()) section.blocks.push_back(make_table(sensors));
  return section;
}

Section make_explanations(const Findings& findings) {
  Section section{"The named cause: equation and source"};
  if (findings.verdict == Verdict::kNoGap || findings.causes.empty()) return section;
  const Cause& cause = findings.causes.front();
  std::vector<std::string> ids = cause.effects;
  ids.insert(ids.end(), cause.indistinguishable_from.begin(), cause.indistinguishable_from.end());
  for (const std::string& id : ids) {
    const diagnosis::Term* term = diagnosis::look_up_term(id);
    if (term != nullptr) section.blocks.push_back(make_explanation(term->info()));
  }
  return section;
}

}  // namespace rollrig::report
