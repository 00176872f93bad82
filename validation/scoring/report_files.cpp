#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/scoring/report.h"

namespace rollrig::proof {
namespace {

Json number(const std::optional<double>& value) {
  return value.has_value() && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

const char* name_of(Unit unit) {
  switch (unit) {
    case Unit::kPercent:
      return "share";
    case Unit::kSeconds:
      return "s";
    case Unit::kNumber:
      break;
  }
  return "1";
}

Json make_figure(const Figure& figure) {
  const auto& interval = figure.interval;
  return {{"id", figure.id},
          {"label", figure.label},
          {"value", number(figure.value)},
          {"low_95", interval ? number(interval->low) : Json(nullptr)},
          {"high_95", interval ? number(interval->high) : Json(nullptr)},
          {"k", interval ? Json(figure.k) : Json(nullptr)},
          {"n", figure.n},
          {"unit", name_of(figure.unit)},
          {"target", number(figure.target)},
          {"floor", number(figure.floor)},
          {"more_is_better", figure.more_is_better},
          {"best_baseline", number(figure.best_baseline)},
          {"best_baseline_id", figure.best_baseline_id.empty() ? Json(nullptr) : Json(figure.best_baseline_id)},
          {"ceiling", number(figure.ceiling)},
          {"note", figure.note}};
}

Json make_tallies(const Tallies& tallies) {
  Json json = Json::object();
  for (const auto& [name, tally] : tallies) {
    json[name] = {{"sets", tally.sets},
                  {"named", tally.named},
                  {"other_cause", tally.named_wrong},
                  {"no_gap", tally.no_gap},
                  {"unexplained", tally.unexplained},
                  {"failed", tally.failed},
                  {"right_above", tally.right_above},
                  {"wrong_above", tally.wrong_above},
                  {"mean_named_set", tally.mean_named_set()}};
  }
  return json;
}

Json make_missed(const Case& one) {
  Json effects = Json::array();
  for (const TrueEffect& effect : one.truth.effects) {
    effects.push_back(
        {{"id", effect.id}, {"size", number(effect.size)}, {"unit", effect.unit}, {"size_class", effect.size_class}});
  }
  return {{"set", one.truth.set},         {"campaign", one.truth.campaign},           {"effects", effects},
          {"outside", one.truth.outside}, {"signal_floors", one.truth.signal_floors}, {"d_prime", number(one.d_prime)},
          {"said", one.said()},           {"answer", make_answer_json(one.answer)}};
}

std::string bar(const Figure& figure, const std::optional<double>& value) {
  if (!value.has_value()) return "";
  return fmt::format("{} {}", figure.more_is_better ? "at least" : "at most", format_value(figure, value));
}

/// "missed" where a figure misses its target, and its floor where it misses that as well.
std::string judge(const Figure& figure) {
  if (!figure.value.has_value()) return figure.note;
  if (!figure.target.has_value()) return "";
  if (figure.meets(figure.target)) return "met";
  return figure.floor.has_value() && !figure.meets(figure.floor) ? "**missed, floor too**" : "**missed**";
}

std::string format_best_baseline(const Figure& figure) {
  if (!figure.best_baseline.has_value()) return "-";
  return fmt::format("{} (`{}`)", format_value(figure, figure.best_baseline), figure.best_baseline_id);
}

std::string write_figures(const Score& score) {
  std::string text =
      "| figure | value | 95 % | cases | target | floor | | best baseline | ideal observer |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  for (const Figure& figure : score.figures) {
    const bool is_share = figure.interval.has_value();
    text += fmt::format(
        "| {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", figure.label.substr(figure.label.find_first_not_of(' ')),
        format_value(figure, figure.value) + (figure.unit == Unit::kPercent && figure.value ? " %" : ""),
        is_share ? fmt::format("{:.1f} to {:.1f}", 100.0 * figure.interval->low, 100.0 * figure.interval->high) : "",
        is_share ? fmt::format("{} of {}", figure.k, figure.n) : fmt::format("{}", figure.n),
        bar(figure, figure.target), bar(figure, figure.floor), judge(figure), format_best_baseline(figure),
        format_value(figure, figure.ceiling));
  }
  return text;
}

std::string write_baselines(const Score& score) {
  if (score.baselines.empty()) return "";
  std::string text = "\n| baselines |";
  std::string line = "|---|";
  for (const BaselineScore& baseline : score.baselines) {
    text += fmt::format(" {} |", baseline.label);
    line += "---|";
  }
  text += '\n' + line + '\n';
  for (const Figure& figure : score.figures) {
    if (!figure.best_baseline.has_value()) continue;
    text += fmt::format("| {} |", figure.label.substr(figure.label.find_first_not_of(' ')));
    for (const BaselineScore& baseline : score.baselines) {
      text += fmt::format(" {} |", format_value(figure, find_value(baseline, figure)));
    }
    text += '\n';
  }
  return text;
}

Json make_baselines(const Score& score) {
  Json json = Json::object();
  for (const BaselineScore& baseline : score.baselines) json[baseline.id] = baseline.values;
  return json;
}

std::string write_tallies(const char* title, const Tallies& tallies) {
  if (tallies.empty()) return "";
  std::string text = fmt::format(
      "\n| {} | sets | named | 95 % | other cause | no gap | unexplained | failed | above 0.9: right, wrong | mean set "
      "|\n",
      title);
  text += "|---|---|---|---|---|---|---|---|---|---|\n";
  for (const auto& [name, tally] : tallies) {
    const Interval interval = calc_wilson_95(tally.named, tally.sets);
    text +=
        fmt::format("| `{}` | {} | {} | {:.0f} to {:.0f} | {} | {} | {} | {} | {}, {} | {:.2f} |\n", name, tally.sets,
                    tally.named, 100.0 * interval.low, 100.0 * interval.high, tally.named_wrong, tally.no_gap,
                    tally.unexplained, tally.failed, tally.right_above, tally.wrong_above, tally.mean_named_set());
  }
  return text;
}

std::string write_confusion(const Confusion& confusion) {
  std::string text = "\n| true | said |\n|---|---|\n";
  for (const auto& [truth, row] : confusion) {
    std::string said;
    for (const auto& [what, count] : row) said += fmt::format("{}{} {}", said.empty() ? "" : ", ", what, count);
    text += fmt::format("| `{}` | {} |\n", truth, said);
  }
  return text;
}

std::string write_reliability(const Reliability& reliability) {
  std::string text = "\n| stated | cases | mean | right | 95 % |\n|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < reliability.size(); ++i) {
    const ReliabilityBin& bin = reliability[i];
    if (bin.cases == 0) continue;
    const Interval interval = calc_wilson_95(bin.right, bin.cases);
    text += fmt::format("| {} to {} % | {} | {:.1f} % | {:.1f} % | {:.1f} to {:.1f} |\n", 10 * i, 10 * (i + 1),
                        bin.cases, 100.0 * bin.mean_probability,
                        100.0 * static_cast<double>(bin.right) / static_cast<double>(bin.cases), 100.0 * interval.low,
                        100.0 * interval.high);
  }
  return text;
}

/// Text in a cell of a table.
std::string cell(std::string text) {
  std::replace(text.begin(), text.end(), '|', '/');
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace

std::string format_score_markdown(const Score& score) {
  std::string text = fmt::format("{} sets. Intervals are Wilson's, 95 %.\n\n", score.sets) + write_figures(score);
  text += write_baselines(score);
  for (const std::string& warning : score.warnings) text += "\n* " + warning;
  text += (score.warnings.empty() ? "" : "\n") + write_tallies("effect", score.by_effect);
  text += write_tallies("campaign", score.by_campaign) + write_tallies("size", score.by_size_class);
  text += write_confusion(score.confusion) + write_reliability(score.reliability) + write_follow_ups(score);
  text += "\n| missed set | answer |\n|---|---|\n";
  for (const Case& one : score.missed) {
    text += fmt::format("| {} | {} |\n", cell(describe_truth(one)), cell(describe_answer(one)));
  }
  return text;
}

Json make_score_json(const Score& score) {
  Json figures = Json::array();
  for (const Figure& figure : score.figures) figures.push_back(make_figure(figure));
  Json reliability = Json::array();
  for (const ReliabilityBin& bin : score.reliability) {
    reliability.push_back(
        {{"cases", bin.cases}, {"right", bin.right}, {"mean_probability", number(bin.mean_probability)}});
  }
  Json confusion = Json::object();
  for (const auto& [truth, row] : score.confusion) confusion[truth] = row;
  Json missed = Json::array();
  for (const Case& one : score.missed) missed.push_back(make_missed(one));
  return {{"format", "rollrig-blind-score/1"},
          {"sets", score.sets},
          {"figures", figures},
          {"baselines", make_baselines(score)},
          {"by_effect", make_tallies(score.by_effect)},
          {"by_campaign", make_tallies(score.by_campaign)},
          {"by_size_class", make_tallies(score.by_size_class)},
          {"all_effects", make_tallies({{"all", score.all_effects}}).at("all")},
          {"confusion", confusion},
          {"reliability", reliability},
          {"next_tests", make_follow_ups_json(score)},
          {"missed", missed},
          {"warnings", score.warnings}};
}

}  // namespace rollrig::proof
