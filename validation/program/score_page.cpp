#include "validation/program/score_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/blocks.h"
#include "sim/core/text.h"
#include "validation/scoring/report.h"

namespace rollrig::validation {
namespace {

using report::Block;
using report::rounded;
using report::Section;

Block make_block(const Table& table) { return report::make_table({"", table.columns, table.rows}); }

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
  return report::make_bars({"Shares of cases", "%"}, names,
                           {{{"name", "share, 95 % interval"}, {"values", values}, {"low", low}, {"high", high}},
                            {{"name", "target"}, {"values", targets}}});
}

Block make_reliability(const Score& score) {
  Json x = Json::array(), y = Json::array(), low = Json::array(), high = Json::array();
  for (const ReliabilityBin& bin : score.reliability) {
    if (bin.cases == 0) continue;
    const Interval interval = calc_wilson_95(bin.right, bin.cases);
    x.push_back(rounded(bin.mean_probability));
    y.push_back(rounded(bin.right_share()));
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

Block make_lead(const Score& score) {
  constexpr std::size_t kFew = 100;  // Assumed: one case of fewer moves most shares by more than a target leaves
  const auto is_judged = [](const Figure& figure) { return figure.value.has_value() && figure.target.has_value(); };
  const auto judged = std::count_if(score.figures.begin(), score.figures.end(), is_judged);
  const auto met = std::count_if(score.figures.begin(), score.figures.end(), [&](const Figure& figure) {
    return is_judged(figure) && figure.meets(figure.target);
  });
  const bool is_few = score.cases < kFew;
  std::string text = fmt::format("{} of {} targets are met.", met, judged);
  if (is_few) text += fmt::format(" {} prove nothing: see the intervals.", format_count(score.cases, "case"));
  return report::make_lead(met == judged && !is_few ? "good" : "doubt", text);
}

}  // namespace

report::Page make_score_page(const Score& score, const std::string& set) {
  report::Page page{"score", "Score of a validation set",
                    fmt::format("Validation set {}, {}", set, format_count(score.cases, "case"))};
  const std::vector<Table> tables = make_score_tables(score);
  Section result{"Result", "", {make_lead(score)}};
  if (!score.warnings.empty()) result.blocks.push_back(report::make_warnings(score.warnings));
  result.blocks.push_back(make_block(tables.front()));
  result.blocks.push_back(make_shares(score));
  page.add(std::move(result));
  for (std::size_t i = 1; i < tables.size(); ++i) {
    Section section{tables[i].title, "", {make_block(tables[i])}};
    if (section.title == "Reliability") section.blocks.insert(section.blocks.begin(), make_reliability(score));
    if (section.title == "Missed") section.folded = format_count(tables[i].rows.size(), "case");
    page.add(std::move(section));
  }
  return page;
}

}  // namespace rollrig::validation
