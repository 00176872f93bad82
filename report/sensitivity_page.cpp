#include "report/sensitivity_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/replace.hpp>
#include <cmath>
#include <iterator>
#include <numeric>
#include <set>

#include "comparison/compared.h"
#include "report/blocks.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

/// One index of each factor, in per cent of the variance, or in the unit of the result.
Json make_index_series(const Json& factors, const char* index, const char* name, double factor) {
  Json values = Json::array();
  Json low = Json::array();
  Json high = Json::array();
  for (const Json& each : factors) {
    values.push_back(rounded(factor * each[index]["value"].get<double>()));
    low.push_back(rounded(factor * each[index]["low_95"].get<double>()));
    high.push_back(rounded(factor * each[index]["high_95"].get<double>()));
  }
  return {{"name", name}, {"values", values}, {"low", low}, {"high", high}};
}

std::string name_factor(const Json& factor) { return plain_name(last_part(factor["key"].get<std::string>())); }

/// Of an elementary effect whether it has one sign in all trajectories: its mean is then its mean size, or less that.
bool has_one_sign(const Json& factor) {
  constexpr double kRounding = 1e-6;
  const double size = factor["mean_size"]["value"];
  return std::abs(std::abs(factor["mean"].get<double>()) - size) <= kRounding * size;
}

/// The change of the result as a factor goes up, with its sign; the mean size where it goes either way.
double find_change(const Json& factor) {
  return has_one_sign(factor) ? factor["mean"].get<double>() : factor["mean_size"]["value"].get<double>();
}

std::string show_change(const Json& factor) {
  return has_one_sign(factor) ? fmt::format("{:+.3g}", find_change(factor))
                              : fmt::format("{:.3g}", find_change(factor));
}

/// Changes with their signs, and their intervals.
Json make_change_series(const Json& factors) {
  Json values = Json::array(), low = Json::array(), high = Json::array();
  for (const Json& each : factors) {
    const double sign = has_one_sign(each) && each["mean"].get<double>() < 0.0 ? -1.0 : 1.0;
    const double a = sign * each["mean_size"]["low_95"].get<double>();
    const double b = sign * each["mean_size"]["high_95"].get<double>();
    values.push_back(rounded(find_change(each)));
    low.push_back(rounded(std::min(a, b)));
    high.push_back(rounded(std::max(a, b)));
  }
  return {{"name", "mean change"}, {"values", values}, {"low", low}, {"high", high}};
}

/// "by 5 °C" of a factor of elementary effects; empty where its steps are not known.
std::string describe_step(const std::string& key, const std::vector<FactorScatter>& scatters) {
  const auto own =
      std::find_if(scatters.begin(), scatters.end(), [&key](const FactorScatter& one) { return one.key == key; });
  const std::vector<double> steps = own == scatters.end() ? std::vector<double>() : list_factor_steps(*own);
  if (steps.empty()) return "";
  const std::string unit = shown_unit(last_part(key));
  const std::string least = fmt::format("{:.3g}", std::min(steps[0], steps[1]));
  const std::string most = fmt::format("{:.3g}", std::max(steps[0], steps[1]));
  return fmt::format("by {}{}{}{}", least, least == most ? "" : " or " + most, unit.empty() ? "" : " ", unit);
}

constexpr const char* kStepOfProbability = "from its 12.5 % to its 62.5 % quantile, or from 37.5 % to 87.5 %";

/// "-0.323 to -0.32": the interval of 95 % of a change, with its sign.
std::string show_change_limits(const Json& factor) {
  const double sign = find_change(factor) < 0.0 ? -1.0 : 1.0;
  const auto sizes = std::minmax({sign * factor["mean_size"]["low_95"].get<double>(),
                                  sign * factor["mean_size"]["high_95"].get<double>()});
  return fmt::format("{:.3g} to {:.3g}", sizes.first, sizes.second);
}

/// "66 to 100 %" of a share of the variance, within 0 to 100 %.
std::string show_share_limits(const Json& index) {
  const auto limit = [&index](const char* name) { return 100.0 * std::clamp(index[name].get<double>(), 0.0, 1.0); };
  return fmt::format("{:.0f} to {:.0f} %", limit("low_95"), limit("high_95"));
}

/// Shares beyond 0 and 100 %, which few points give, end there. Returns whether there are any.
bool clip_shares(Json& series) {
  bool is_clipped = false;
  for (Json& one : series) {
    for (const char* list : {"values", "low", "high"}) {
      for (Json& value : one[list]) {
        if (!value.is_number()) continue;
        const double share = value;
        if (share < 0.0 || share > 100.0) is_clipped = true;
        value = std::clamp(share, 0.0, 100.0);
      }
    }
  }
  return is_clipped;
}

Block make_index_bars(const Json& sensitivity) {
  const Json& factors = sensitivity["factors"];
  const std::string result = sensitivity["result"];
  Json names = Json::array();
  for (const Json& each : factors) names.push_back(plain_name(last_part(each["key"].get<std::string>())));
  if (factors.front().contains("total")) {
    Json series = Json::array({make_index_series(factors, "first", "alone", 100.0),
                               make_index_series(factors, "total", "with interactions", 100.0)});
    const char* note =
        clip_shares(series) ? " What reaches beyond 0 or 100 % ends there; the table below has it whole." : "";
    return make_bars({"Share of the variance of " + comparison::label_result(result), "%"}, names, series,
                     fmt::format("The factor with the largest share first. Whiskers: intervals of 95 %.{}", note));
  }
  const bool has_both = !std::all_of(factors.begin(), factors.end(), &has_one_sign);
  return make_bars({"Change of " + comparison::label_result(result), shown_unit(result)}, names,
                   Json::array({make_change_series(factors)}),
                   fmt::format("Mean change as the factor rises {}. Whiskers: intervals of 95 %.{}", kStepOfProbability,
                               has_both ? " A factor whose changes go either way has their mean size." : ""));
}

constexpr std::size_t kMostPoints = 1000;  // Assumed: more hide each other

/// The mean result of each word, with the least and the largest.
Block make_word_chart(const std::string& result, const FactorScatter& scatter) {
  std::vector<std::vector<double>> of_words(scatter.words.size());
  for (std::size_t i = 0; i < scatter.values.size(); ++i) {
    if (std::isfinite(scatter.results[i])) {
      of_words[static_cast<std::size_t>(scatter.values[i])].push_back(scatter.results[i]);
    }
  }
  Json names = Json::array(), means = Json::array(), low = Json::array(), high = Json::array();
  for (std::size_t word = 0; word < of_words.size(); ++word) {
    const std::vector<double>& results = of_words[word];
    if (results.empty()) continue;
    names.push_back(scatter.words[word]);
    means.push_back(
        rounded(std::accumulate(results.begin(), results.end(), 0.0) / static_cast<double>(results.size())));
    low.push_back(rounded(*std::min_element(results.begin(), results.end())));
    high.push_back(rounded(*std::max_element(results.begin(), results.end())));
  }
  return make_bars(
      {fmt::format("{} by {}", capitalized(comparison::label_result(result)), plain_name(last_part(scatter.key))),
       shown_unit(result)},
      names, Json::array({{{"name", "mean"}, {"values", means}, {"low", low}, {"high", high}}}),
      "Whiskers: the least and the largest of the items.");
}

Block make_factor_chart(const std::string& result, const FactorScatter& scatter) {
  ChartSeries points;
  for (std::size_t i = 0; i < std::min(scatter.values.size(), kMostPoints); ++i) {
    if (std::isfinite(scatter.results[i])) points.add(scatter.values[i], scatter.results[i]);
  }
  const std::string key = last_part(scatter.key);
  if (!scatter.words.empty()) return make_word_chart(result, scatter);
  return make_curves({plain_name(key), shown_unit(key)}, {comparison::label_result(result), shown_unit(result)},
                     Json::array({points.finish("items")}));
}

constexpr std::size_t kMostRanges = 5;  // Assumed: of each factor of a map

/// The values of a factor in a few ranges, and in which of them each item lies.
struct Ranges {
  std::vector<std::string> names;
  std::vector<std::size_t> of_items;
};

/// Each value by itself where there are few, and each word, else ranges that hold equally many items.
Ranges make_ranges(const std::vector<double>& values, const std::vector<std::string>& words) {
  if (!words.empty()) {
    Ranges ranges{words, {}};
    for (const double value : values) ranges.of_items.push_back(static_cast<std::size_t>(value));
    return ranges;
  }
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> distinct;
  std::unique_copy(sorted.begin(), sorted.end(), std::back_inserter(distinct));
  Ranges ranges;
  std::vector<double> starts;  // of all ranges but the first
  if (distinct.size() <= kMostRanges) {
    for (const double value : distinct) ranges.names.push_back(fmt::format("{:.4g}", value));
    starts.assign(distinct.begin() + 1, distinct.end());
  } else {
    const auto limit = [&sorted](std::size_t i) { return sorted[i * (sorted.size() - 1) / kMostRanges]; };
    for (std::size_t i = 0; i < kMostRanges; ++i) {
      ranges.names.push_back(fmt::format("{:.4g} to {:.4g}", limit(i), limit(i + 1)));
      if (i > 0) starts.push_back(limit(i));
    }
  }
  for (const double value : values) {
    const auto above = std::upper_bound(starts.begin(), starts.end(), value);
    ranges.of_items.push_back(static_cast<std::size_t>(above - starts.begin()));
  }
  return ranges;
}

std::string with_unit(const std::string& key, const std::string& name) {
  const std::string unit = shown_unit(last_part(key));
  return name + (unit.empty() ? "" : " in " + unit);
}

std::string with_unit(const std::string& key) { return with_unit(key, plain_name(last_part(key))); }

/// The map of `over_two_factors` of the document.
Block make_map(const std::string& result, const Json& means) {
  const std::string across = means["across"]["key"], down = means["down"]["key"];
  const double mean = means["mean"];
  double largest = 0.0;  // deviation of a cell, which has the strongest shade
  for (const Json& row : means["means"]) {
    for (const Json& cell : row) {
      if (cell.is_number()) largest = std::max(largest, std::abs(cell.get<double>() - mean));
    }
  }
  Block block{{"type", "map"},
              {"caption", fmt::format("Mean of {} over {} and {}", with_unit(result, comparison::label_result(result)),
                                      plain_name(last_part(across)), plain_name(last_part(down)))},
              {"heads", {with_unit(down), ""}},
              {"columns", means["across"]["ranges"]},
              {"rows", Json::array()},
              {"legend", fmt::format("Columns: {}. Shades: above and below the mean of all items, {:.4g}.",
                                     with_unit(across), mean)}};
  for (std::size_t row = 0; row < means["means"].size(); ++row) {
    Json cells = Json::array();
    for (std::size_t column = 0; column < means["means"][row].size(); ++column) {
      const Json& cell = means["means"][row][column];
      if (cell.is_null()) {
        cells.push_back(nullptr);
        continue;
      }
      const double value = cell;
      cells.push_back({{"text", fmt::format("{:.4g}", value)},
                       {"shade", largest > 0.0 ? std::lround(4.0 * (value - mean) / largest) : 0},
                       {"marked", ""},
                       {"note", format_count(means["items"][row][column].get<std::size_t>(), "item")}});
    }
    block["rows"].push_back({{"group", ""}, {"label", means["down"]["ranges"][row]}, {"cells", cells}});
  }
  return block;
}

/// "97 %" of 0.97, kept within 0 to 100 %.
std::string show_variance_share(double share) {
  const double percent = 100.0 * std::clamp(share, 0.0, 1.0);  // an estimate of few points may lie beyond
  return fmt::format("{:.{}f} %", percent, percent < 10.0 ? 1 : 0);
}

/// Which factors matter, and by how much, in a sentence.
std::string describe_sensitivity(const Json& sensitivity, const std::vector<FactorScatter>& scatters) {
  const Json& factors = sensitivity["factors"];
  const std::string result = sensitivity["result"];
  const std::string unit = shown_unit(result);
  const bool is_sobol = factors.front().contains("total");
  constexpr std::size_t kMost = 4;
  std::vector<std::string> others;
  std::string text =
      fmt::format("{} depends most on {}: ", capitalized(comparison::label_result(result)), name_factor(factors[0]));
  const auto size = [&](const Json& factor) {
    if (is_sobol) return show_variance_share(factor["total"]["value"].get<double>());
    const std::string step = describe_step(factor["key"], scatters);
    return fmt::format("{} {}{}{}", show_change(factor), unit, has_one_sign(factor) ? "" : " up or down",
                       step.empty() ? "" : " as it rises " + step);
  };
  text += is_sobol ? fmt::format("it accounts for {} of the variance (95 % interval {})", size(factors[0]),
                                 show_share_limits(factors[0]["total"]))
                   : "on average, " + size(factors[0]);
  for (std::size_t i = 1; i < std::min(kMost, factors.size()); ++i) {
    others.push_back(fmt::format("{} {}", name_factor(factors[i]), size(factors[i])));
  }
  if (!others.empty())
    text += fmt::format("; {}{}", fmt::join(others, ", "), factors.size() > kMost ? ", the others less" : "");
  return text + (is_sobol ? ", with interactions." : ".");
}

Block make_sensitivity_tiles(const Json& sensitivity, const std::vector<FactorScatter>& scatters) {
  constexpr std::size_t kMost = 4;
  const Json& factors = sensitivity["factors"];
  const std::string result = sensitivity["result"];
  std::vector<Tile> tiles;
  for (std::size_t i = 0; i < std::min(kMost, factors.size()); ++i) {
    const Json& factor = factors[i];
    const std::string place = fmt::format("/factors/{}/", i);
    const std::string name = capitalized(name_factor(factor));
    if (factor.contains("total")) {
      tiles.push_back({name,
                       fmt::format("{:.1f} %", 100.0 * std::clamp(factor["total"]["value"].get<double>(), 0.0, 1.0)),
                       "",
                       fmt::format("of the variance with interactions (95 %: {}); alone {:.1f} %",
                                   show_share_limits(factor["total"]), 100.0 * factor["first"]["value"].get<double>()),
                       "",
                       {place + "total/value"}});
    } else {
      const std::string step = describe_step(factor["key"], scatters);
      tiles.push_back(
          {name,
           show_change(factor),
           shown_unit(result),
           fmt::format("{} as it rises {} (95 %: {})", has_one_sign(factor) ? "mean change" : "mean size of the change",
                       step.empty() ? kStepOfProbability : step, show_change_limits(factor)),
           "",
           {place + (has_one_sign(factor) ? "mean" : "mean_size/value")}});
    }
  }
  if (sensitivity.contains("mean") && sensitivity.contains("sd")) {
    tiles.push_back(
        {capitalized(comparison::label_result(result)),
         fmt::format("{:.4g} +- {:.2g}", sensitivity["mean"].get<double>(), sensitivity["sd"].get<double>()),
         shown_unit(result),
         "mean and standard deviation over all items",
         "",
         {"/mean", "/sd"}});
  }
  return make_tiles(tiles);
}

}  // namespace

FactorScatter make_factor_scatter(const std::string& key, const std::vector<std::string>& values,
                                  const std::vector<double>& results) {
  FactorScatter scatter{key, {}, results};
  for (const std::string& value : values) {
    if (const auto number = parse_number(value)) scatter.values.push_back(*number);
  }
  if (scatter.values.size() == values.size()) return scatter;
  const std::set<std::string> words(values.begin(), values.end());
  scatter.words.assign(words.begin(), words.end());
  scatter.values.clear();
  for (const std::string& value : values) {
    scatter.values.push_back(static_cast<double>(std::distance(words.begin(), words.find(value))));
  }
  return scatter;
}

std::vector<double> list_factor_steps(const FactorScatter& scatter) {
  if (!scatter.words.empty()) return {};
  std::vector<double> levels = scatter.values;
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  if (levels.size() != 4) return {};
  return {levels[2] - levels[0], levels[3] - levels[1]};
}

Json make_factor_means(const std::vector<FactorScatter>& scatters) {
  if (scatters.size() < 2) return nullptr;
  const FactorScatter& across = scatters[0];
  const FactorScatter& down = scatters[1];
  std::vector<double> x_values;
  std::vector<double> y_values;
  std::vector<double> results;
  for (std::size_t i = 0; i < across.results.size(); ++i) {
    if (!std::isfinite(across.results[i])) continue;
    x_values.push_back(across.values[i]);
    y_values.push_back(down.values[i]);
    results.push_back(across.results[i]);
  }
  if (results.empty()) return nullptr;
  const Ranges columns = make_ranges(x_values, across.words);
  const Ranges rows = make_ranges(y_values, down.words);
  std::vector<std::vector<double>> sums(rows.names.size(), std::vector<double>(columns.names.size(), 0.0));
  std::vector<std::vector<std::size_t>> counts(rows.names.size(), std::vector<std::size_t>(columns.names.size(), 0));
  for (std::size_t i = 0; i < results.size(); ++i) {
    sums[rows.of_items[i]][columns.of_items[i]] += results[i];
    ++counts[rows.of_items[i]][columns.of_items[i]];
  }
  Json means = Json::array();
  for (std::size_t row = 0; row < sums.size(); ++row) {
    Json cells = Json::array();
    for (std::size_t column = 0; column < sums[row].size(); ++column) {
      const std::size_t count = counts[row][column];
      cells.push_back(count > 0 ? Json(sums[row][column] / static_cast<double>(count)) : Json());
    }
    means.push_back(std::move(cells));
  }
  return {{"across", {{"key", across.key}, {"ranges", columns.names}}},
          {"down", {{"key", down.key}, {"ranges", rows.names}}},
          {"mean", std::accumulate(results.begin(), results.end(), 0.0) / static_cast<double>(results.size())},
          {"means", means},
          {"items", counts}};
}

Page make_sensitivity_page(const Json& sensitivity, const Table& of_terminal, const std::string& said,
                           const std::vector<FactorScatter>& scatters) {
  const std::string result = sensitivity["result"];
  Table table = of_terminal;
  std::string explanation = said;
  // The terminal names what options take, the page says what it is.
  for (std::string* text : {&table.title, &explanation}) {
    boost::algorithm::replace_first(*text, result, comparison::label_result(result));
  }
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    table.rows[i].front() = plain_name(last_part(sensitivity["factors"][i]["key"].get<std::string>()));
  }
  Page page{"campaign sensitivity", "Sensitivity of " + comparison::label_result(result),
            format_count(sensitivity["factors"].size(), "factor")};
  page.add({"What the result depends on",
            "",
            {make_lead("", describe_sensitivity(sensitivity, scatters)), make_sensitivity_tiles(sensitivity, scatters),
             make_index_bars(sensitivity), make_paragraph(explanation), make_table(table)}});
  const std::size_t items = scatters.empty() ? 0 : scatters.front().values.size();
  Section over{"Result over the factors",
               items > kMostPoints ? fmt::format("The first {} of {} items, a point each.", kMostPoints, items)
                                   : "Each point is one item of the campaign; of names, bars show the mean."};
  for (const FactorScatter& scatter : scatters) over.blocks.push_back(make_factor_chart(result, scatter));
  page.add(std::move(over));
  const Json means = sensitivity.value("over_two_factors", Json());
  if (!means.is_null()) page.add({"Result over two factors", "", {make_map(result, means)}});
  return page;
}

}  // namespace rollrig::report
