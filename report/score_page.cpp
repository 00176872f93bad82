#include "report/score_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/blocks.h"
#include "sim/core/text.h"
#include "validation/scoring/report.h"

namespace rollrig::report {
namespace {

using proof::Figure;
using proof::Score;
using proof::Tallies;
using proof::Tally;

std::string judge(const Figure& figure) {
  if (!figure.value.has_value()) return figure.note;
  if (!figure.target.has_value()) return "";
  if (figure.meets(figure.target)) return "met";
  return figure.floor.has_value() && !figure.meets(figure.floor) ? "missed, floor too" : "missed";
}

std::string show_bar(const Figure& figure, const std::optional<double>& bar) {
  if (!bar.has_value()) return "-";
  return fmt::format("{} {}", figure.more_is_better ? "≥" : "≤", proof::format_value(figure, bar));
}

Block make_figures(const Score& score) {
  scenarios::ResultTable table{
      "Figures and targets; shares in %",
      {"figure", "value", "95 % from", "to", "cases", "target", "", "best baseline", "ideal observer"},
      {}};
  for (const Figure& figure : score.figures) {
    const auto percent = [&](double share) { return fmt::format("{:.1f}", 100.0 * share); };
    const bool has_interval = figure.interval.has_value();
    table.rows.push_back(
        {figure.label, proof::format_value(figure, figure.value), has_interval ? percent(figure.interval->low) : "",
         has_interval ? percent(figure.interval->high) : "",
         has_interval ? fmt::format("{}/{}", figure.k, figure.n) : fmt::format("{}", figure.n),
         show_bar(figure, figure.target), judge(figure), proof::format_value(figure, figure.best_baseline),
         proof::format_value(figure, figure.ceiling)});
  }
  return make_table(table);
}

/// Shares with their intervals, beside target and best baseline.
Block make_shares(const Score& score) {
  Json names = Json::array(), values = Json::array(), low = Json::array(), high = Json::array(),
       targets = Json::array();
  for (const Figure& figure : score.figures) {
    if (!figure.value.has_value() || !figure.interval.has_value()) continue;
    names.push_back(figure.label);
    values.push_back(rounded(100.0 * *figure.value));
    low.push_back(rounded(100.0 * figure.interval->low));
    high.push_back(rounded(100.0 * figure.interval->high));
    targets.push_back(figure.target.has_value() ? rounded(100.0 * *figure.target) : Json(nullptr));
  }
  return {{"type", "bars"},
          {"label", "Shares of cases"},
          {"unit", "%"},
          {"categories", names},
          {"series",
           {{{"name", "share, 95 % interval"}, {"values", values}, {"low", low}, {"high", high}},
            {{"name", "target"}, {"values", targets}}}}};
}

Block make_reliability(const Score& score) {
  Json x = Json::array(), y = Json::array(), low = Json::array(), high = Json::array();
  for (const proof::ReliabilityBin& bin : score.reliability) {
    if (bin.cases == 0) continue;
    const proof::Interval interval = proof::calc_wilson_95(bin.right, bin.cases);
    x.push_back(rounded(bin.mean_probability));
    y.push_back(rounded(static_cast<double>(bin.right) / static_cast<double>(bin.cases)));
    low.push_back(rounded(interval.low));
    high.push_back(rounded(interval.high));
  }
  return {{"type", "curves"},
          {"x", {{"label", "Stated probability"}, {"unit", ""}, {"from_zero", true}}},
          {"y", {{"label", "Share that was right"}, {"unit", ""}, {"from_zero", true}}},
          {"diagonal", 1.0},
          {"series",
           Json::array({{{"name", "cases"}, {"kind", "points"}, {"x", x}, {"y", y}, {"low", low}, {"high", high}}})},
          {"caption", "On the dashed line a stated probability is what it says. Whiskers: 95 % intervals."}};
}

std::vector<std::string> make_row(const std::string& name, const Tally& tally) {
  const double share =
      tally.sets > 0 ? 100.0 * static_cast<double>(tally.named) / static_cast<double>(tally.sets) : 0.0;
  const auto count = [](std::size_t n) { return fmt::format("{}", n); };
  return {name,
          count(tally.sets),
          count(tally.named),
          fmt::format("{:.1f}", share),
          count(tally.named_wrong),
          count(tally.no_gap),
          count(tally.unexplained),
          count(tally.failed),
          count(tally.right_above),
          count(tally.wrong_above),
          fmt::format("{:.2f}", tally.mean_named_set())};
}

Block make_tallies(const std::string& title, const Tallies& tallies) {
  scenarios::ResultTable table{title,
                               {"", "sets", "named", "named %", "other cause", "no gap", "unexplained", "failed",
                                "right above 0.9", "wrong above 0.9", "mean named set"},
                               {}};
  for (const auto& [name, tally] : tallies) table.rows.push_back(make_row(name, tally));
  return make_table(table);
}

Block make_confusion(const proof::Confusion& confusion) {
  scenarios::ResultTable table{"What was said where it was something else", {"truth", "said", "sets"}, {}};
  for (const auto& [truth, row] : confusion) {
    for (const auto& [said, count] : row) {
      const bool is_right = said == truth || (truth == "none" && said == "no gap");
      if (!is_right) table.rows.push_back({truth, said, fmt::format("{}", count)});
    }
  }
  return make_table(table);
}

Section make_missed(const Score& score) {
  Section section{"Missed"};
  scenarios::ResultTable table{"", {"what the data are", "what was answered"}, {}};
  for (const proof::Case& one : score.missed) {
    table.rows.push_back({proof::describe_truth(one), proof::describe_answer(one)});
  }
  if (!table.rows.empty()) section.blocks.push_back(make_table(table));
  if (!table.rows.empty()) section.folded = format_count(table.rows.size(), "set");
  return section;
}

}  // namespace

Page make_score_page(const Score& score, const std::string& bank) {
  Page page{"blind score",
            "Score of the blind proof",
            fmt::format("Bank {}, {}", bank, format_count(score.sets, "set")),
            {},
            false,
            {}};
  std::size_t missed = 0;
  std::size_t judged = 0;
  for (const Figure& figure : score.figures) {
    if (!figure.value.has_value() || !figure.target.has_value()) continue;
    ++judged;
    if (!figure.meets(figure.target)) ++missed;
  }
  Section result{"Result"};
  constexpr std::size_t kFew = 100;  // Assumed: one case of fewer moves most shares by more than a target leaves
  const bool is_few = score.sets < kFew;
  const std::string few =
      is_few ? fmt::format(" {} prove nothing: see the intervals.", format_count(score.sets, "set")) : "";
  result.blocks.push_back(make_lead(missed == 0 && !is_few ? "good" : "doubt",
                                    fmt::format("{} of {} targets are met.{}", judged - missed, judged, few)));
  if (!score.warnings.empty()) result.blocks.push_back(make_warnings(score.warnings));
  result.blocks.push_back(make_figures(score));
  result.blocks.push_back(make_shares(score));
  page.add(std::move(result));
  const bool is_stated = std::any_of(score.reliability.begin(), score.reliability.end(),
                                     [](const proof::ReliabilityBin& bin) { return bin.cases > 0; });
  if (is_stated) page.add({"Reliability", "", {make_reliability(score)}});
  Section tallies{"By effect, campaign and size"};
  tallies.blocks.push_back(make_tallies("Effects", score.by_effect));
  tallies.blocks.push_back(make_tallies("Campaigns", score.by_campaign));
  if (!score.by_size_class.empty()) tallies.blocks.push_back(make_tallies("Sizes", score.by_size_class));
  page.add(std::move(tallies));
  page.add({"Confusions", "", {make_confusion(score.confusion)}});
  page.add(make_missed(score));
  return page;
}

}  // namespace rollrig::report
