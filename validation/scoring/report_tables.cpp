#include <fmt/format.h>

#include <algorithm>

#include "diagnosis/output/diagnosis_json.h"
#include "sim/core/text.h"
#include "validation/scoring/report.h"

namespace rollrig::validation {
namespace {

constexpr char kFigures[] = "Figures";

std::string show_bar(const Figure& figure, const std::optional<double>& value) {
  if (!value.has_value()) return "";
  return fmt::format("{} {}", figure.more_is_better ? "at least" : "at most", format_value(figure, value));
}

/// "missed" where a figure misses its target, and its limit where it misses that as well.
std::string judge_figure(const Figure& figure) {
  if (!figure.value.has_value()) return figure.note;
  if (!figure.target.has_value()) return "";
  if (figure.meets(figure.target)) return "met";
  return figure.floor.has_value() && !figure.meets(figure.floor) ? "missed, limit too" : "missed";
}

std::string strip(const std::string& label) { return label.substr(label.find_first_not_of(' ')); }

Table make_figures(const Score& score) {
  Table table{
      kFigures, {"figure", "value", "95 %", "cases", "target", "limit", "", "best baseline", "ideal observer"}, {}};
  for (const Figure& figure : score.figures) {
    const bool is_share = figure.unit == Unit::kPercent && figure.value.has_value();
    std::string baseline = format_value(figure, figure.best_baseline);
    if (figure.best_baseline.has_value()) baseline += fmt::format(" ({})", figure.best_baseline_id);
    table.rows.push_back(
        {strip(figure.label), format_value(figure, figure.value) + (is_share ? " %" : ""),
         format_interval(figure.interval),
         figure.interval.has_value() ? fmt::format("{} of {}", figure.k, figure.n) : fmt::format("{}", figure.n),
         show_bar(figure, figure.target), show_bar(figure, figure.floor), judge_figure(figure), baseline,
         format_value(figure, figure.upper_bound)});
  }
  return table;
}

Table make_baseline_table(const Score& score) {
  Table table{"Baselines", {"figure"}, {}};
  for (const BaselineScore& baseline : score.baselines) table.columns.push_back(baseline.label);
  for (const Figure& figure : score.figures) {
    if (!figure.best_baseline.has_value()) continue;
    table.rows.push_back({strip(figure.label)});
    for (const BaselineScore& baseline : score.baselines) {
      table.rows.back().push_back(format_value(figure, find_value(baseline, figure)));
    }
  }
  return table;
}

std::vector<std::string> make_tally_row(const std::string& name, const Tally& tally) {
  const Interval interval = calc_wilson_95(tally.named, tally.cases);
  const auto count = [](std::size_t n) { return fmt::format("{}", n); };
  return {name,
          count(tally.cases),
          count(tally.named),
          fmt::format("{:.0f} to {:.0f}", 100.0 * interval.low, 100.0 * interval.high),
          count(tally.named_wrong),
          count(tally.no_gap),
          count(tally.unexplained),
          count(tally.failed),
          fmt::format("{}, {}", tally.right_above, tally.wrong_above),
          fmt::format("{:.2f}", tally.mean_named_set())};
}

Table make_tally_table(const char* title, const Tallies& tallies) {
  Table table{title,
              {"", "cases", "named", "95 %", "other cause", "no gap", "unexplained", "failed",
               "above 0.9: right, wrong", "mean set"},
              {}};
  for (const auto& [name, tally] : tallies) table.rows.push_back(make_tally_row(name, tally));
  return table;
}

Table make_confusion(const Confusion& confusion) {
  Table table{"Confusions", {"true", "said"}, {}};
  for (const auto& [truth, row] : confusion) {
    std::string said;
    for (const auto& [what, count] : row) said += fmt::format("{}{} {}", said.empty() ? "" : ", ", what, count);
    table.rows.push_back({truth, said});
  }
  return table;
}

Table make_reliability(const Reliability& reliability) {
  Table table{"Reliability", {"stated", "cases", "mean", "right", "95 %"}, {}};
  for (std::size_t i = 0; i < reliability.size(); ++i) {
    const ReliabilityBin& bin = reliability[i];
    if (bin.cases == 0) continue;
    table.rows.push_back({fmt::format("{} to {} %", 10 * i, 10 * (i + 1)), fmt::format("{}", bin.cases),
                          fmt::format("{:.1f} %", 100.0 * bin.mean_probability),
                          fmt::format("{:.1f} %", 100.0 * bin.right_share()),
                          format_interval(calc_wilson_95(bin.right, bin.cases))});
  }
  return table;
}

/// Answers by kind and verdict; a mean of what is stated that lies outside of the interval of what is right is marked.
Table make_reliability_by_kind(const std::vector<ReliabilityGroup>& groups) {
  Table table{"Reliability by kind and verdict", {"kind", "verdict", "cases", "mean stated", "right", "95 %", ""}, {}};
  for (const ReliabilityGroup& group : groups) {
    const ReliabilityBin& bin = group.bin;
    const Interval right = calc_wilson_95(bin.right, bin.cases);
    const char* mark = bin.mean_probability > right.high  ? "too sure"
                       : bin.mean_probability < right.low ? "too unsure"
                                                          : "";
    table.rows.push_back({group.kind, diagnosis::name_of(group.verdict), fmt::format("{}", bin.cases),
                          fmt::format("{:.1f} %", 100.0 * bin.mean_probability),
                          fmt::format("{:.1f} %", 100.0 * bin.right_share()), format_interval(right), mark});
  }
  return table;
}

/// "12 of 14 (60 to 96 %)"
std::string show_proportion(std::size_t k, std::size_t n) {
  const Interval interval = calc_wilson_95(k, n);
  return fmt::format("{} of {} ({:.0f} to {:.0f} %)", k, n, 100.0 * interval.low, 100.0 * interval.high);
}

Table make_location_table(const Score& score) {
  Table table{"Locations", {"kind", "where the gap is largest", "channel", "run", "phase", "all that are named"}, {}};
  const auto add = [&table](const std::string& kind, const LocationTally& tally) {
    table.rows.push_back({kind, show_proportion(tally.all_three, tally.answers),
                          show_proportion(tally.channel, tally.answers), show_proportion(tally.run, tally.answers),
                          show_proportion(tally.phase, tally.answers), show_proportion(tally.shifted, tally.named)});
  };
  for (const auto& [kind, tally] : score.locations) {
    if (kind != kAllKinds) add(kind, tally);
  }
  const auto all = score.locations.find(kAllKinds);
  if (all != score.locations.end()) add(all->first, all->second);
  return table;
}

Table make_missed_table(const Score& score) {
  Table table{"Missed", {"what the data are", "what was answered"}, {}};
  for (const Case& one : score.missed) table.rows.push_back({describe_truth(one), describe_answer(one)});
  return table;
}

/// Text in a cell of a table.
std::string cell(std::string text) {
  std::replace(text.begin(), text.end(), '|', '/');
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text + " |";
}

}  // namespace

std::vector<Table> make_score_tables(const Score& score) {
  std::vector<Table> tables{make_figures(score),
                            make_baseline_table(score),
                            make_tally_table("By effect", score.by_effect),
                            make_tally_table("By campaign", score.by_campaign),
                            make_tally_table("By size", score.by_size_class),
                            make_confusion(score.confusion),
                            make_reliability(score.reliability),
                            make_reliability_by_kind(score.reliability_groups),
                            make_location_table(score)};
  if (!score.by_effect.empty()) tables[2].rows.push_back(make_tally_row("all effects", score.all_effects));
  for (Table& table : make_follow_up_tables(score)) tables.push_back(std::move(table));
  tables.push_back(make_missed_table(score));
  tables.erase(std::remove_if(tables.begin(), tables.end(), [](const Table& table) { return table.rows.empty(); }),
               tables.end());
  return tables;
}

/// Figures in 80 columns, a note on what is missing below its line.
std::string format_figures(const Score& score) {
  constexpr char kRow[] = "{:<33}{:>7} {:>13} {:>7} {:>8} {:>7}\n";
  std::string text = '\n' + fmt::format(kRow, "figure", "value", "95 %", "cases", "target", "best b.");
  for (const Figure& figure : score.figures) {
    const std::string target = format_value(figure, figure.target);
    text += fmt::format(
        kRow, figure.label, format_value(figure, figure.value), format_interval(figure.interval),
        figure.interval.has_value() ? fmt::format("{}/{}", figure.k, figure.n) : fmt::format("{}", figure.n),
        target == "-" ? target : (figure.more_is_better ? ">= " : "<= ") + target,
        format_value(figure, figure.best_baseline));
    if (!figure.value.has_value()) text += wrap(figure.note, 4);
  }
  return text + "Shares in %. best b.: the best of the baselines, - where none was run.\n";
}

std::string format_score(const Score& score) {
  std::string text = fmt::format("{} cases. Intervals are Wilson's, 95 %.\n", score.cases);
  text += format_warnings(score.warnings) + format_figures(score);
  for (const Table& table : make_score_tables(score)) {
    if (table.title != kFigures) text += '\n' + format_table(table);
  }
  return text;
}

std::string format_score_markdown(const Score& score) {
  std::string text = fmt::format("{} cases. Intervals are Wilson's, 95 %.\n", score.cases);
  for (const std::string& warning : score.warnings) text += "\n* " + warning;
  if (!score.warnings.empty()) text += '\n';
  for (const Table& table : make_score_tables(score)) {
    text += fmt::format("\n### {}\n\n|", table.title);
    for (const std::string& column : table.columns) text += ' ' + cell(column);
    text += "\n|";
    for (std::size_t i = 0; i < table.columns.size(); ++i) text += "---|";
    text += '\n';
    for (const std::vector<std::string>& row : table.rows) {
      text += '|';
      for (const std::string& content : row) text += ' ' + cell(content);
      text += '\n';
    }
  }
  return text;
}

}  // namespace rollrig::validation
