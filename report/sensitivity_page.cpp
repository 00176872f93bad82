#include "report/sensitivity_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/replace.hpp>
#include <cmath>
#include <iterator>
#include <numeric>

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

Block make_index_bars(const Json& sensitivity) {
  const Json& factors = sensitivity["factors"];
  const std::string result = sensitivity["result"];
  Json names = Json::array();
  for (const Json& each : factors) names.push_back(plain_name(last_part(each["key"].get<std::string>())));
  if (factors.front().contains("total")) {
    return make_bars({"Share of the variance of " + comparison::label_result(result), "%"}, names,
                     Json::array({make_index_series(factors, "first", "alone", 100.0),
                                  make_index_series(factors, "total", "with interactions", 100.0)}),
                     "The factor with the largest share first. Whiskers: intervals of 95 %.");
  }
  return make_bars({"Size of the change of " + comparison::label_result(result), shown_unit(result)}, names,
                   Json::array({make_index_series(factors, "mean_size", "mean size", 1.0)}),
                   "As the factor goes up by half of its probability. Whiskers: intervals of 95 %.");
}

constexpr std::size_t kMostPoints = 1000;  // Assumed: more hide each other

Block make_factor_chart(const std::string& result, const FactorScatter& scatter) {
  ChartSeries points;
  for (std::size_t i = 0; i < std::min(scatter.values.size(), kMostPoints); ++i) {
    if (std::isfinite(scatter.results[i])) points.add(scatter.values[i], scatter.results[i]);
  }
  const std::string key = last_part(scatter.key);
  return make_curves({plain_name(key), shown_unit(key)}, {comparison::label_result(result), shown_unit(result)},
                     Json::array({points.finish("items")}));
}

constexpr std::size_t kMostRanges = 5;  // Assumed: of each factor of a map

/// The values of a factor in a few ranges, and in which of them each item lies.
struct Ranges {
  std::vector<std::string> names;
  std::vector<std::size_t> of_items;
};

/// Each value by itself where there are few, else ranges that hold equally many items.
Ranges make_ranges(const std::vector<double>& values) {
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

/// The mean result over two factors, each in a few ranges.
Block make_map(const std::string& result, const FactorScatter& across, const FactorScatter& down) {
  std::vector<double> x_values;
  std::vector<double> y_values;
  std::vector<double> results;
  for (std::size_t i = 0; i < across.results.size(); ++i) {
    if (!std::isfinite(across.results[i])) continue;
    x_values.push_back(across.values[i]);
    y_values.push_back(down.values[i]);
    results.push_back(across.results[i]);
  }
  const Ranges columns = make_ranges(x_values);
  const Ranges rows = make_ranges(y_values);
  struct Cell {
    double sum = 0.0;
    std::size_t count = 0;
    double mean() const { return sum / static_cast<double>(count); }
  };
  std::vector<std::vector<Cell>> cells(rows.names.size(), std::vector<Cell>(columns.names.size()));
  for (std::size_t i = 0; i < results.size(); ++i) {
    Cell& cell = cells[rows.of_items[i]][columns.of_items[i]];
    cell.sum += results[i];
    ++cell.count;
  }
  const double mean = std::accumulate(results.begin(), results.end(), 0.0) / static_cast<double>(results.size());
  double largest = 0.0;  // deviation of a cell, which has the strongest shade
  for (const std::vector<Cell>& row : cells) {
    for (const Cell& cell : row) {
      if (cell.count > 0) largest = std::max(largest, std::abs(cell.mean() - mean));
    }
  }
  const auto show = [&](const Cell& cell) -> Json {
    if (cell.count == 0) return nullptr;
    return {{"text", fmt::format("{:.4g}", cell.mean())},
            {"shade", largest > 0.0 ? std::lround(4.0 * (cell.mean() - mean) / largest) : 0},
            {"marked", ""},
            {"note", format_count(cell.count, "item")}};
  };
  Block block{{"type", "map"},
              {"caption", fmt::format("Mean of {} over {} and {}", with_unit(result, comparison::label_result(result)),
                                      plain_name(last_part(across.key)), plain_name(last_part(down.key)))},
              {"heads", {with_unit(down.key), ""}},
              {"columns", columns.names},
              {"rows", Json::array()},
              {"legend", fmt::format("Columns: {}. Shades: above and below the mean of all items, {:.4g}.",
                                     with_unit(across.key), mean)}};
  for (std::size_t row = 0; row < cells.size(); ++row) {
    block["rows"].push_back({{"group", ""}, {"label", rows.names[row]}, {"cells", make_list(cells[row], show)}});
  }
  return block;
}

}  // namespace

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
  page.add({"What the result depends on", explanation, {make_index_bars(sensitivity), make_table(table)}});
  const std::size_t items = scatters.empty() ? 0 : scatters.front().values.size();
  Section over{"Result over the factors",
               items > kMostPoints ? fmt::format("The first {} of {} items, a point each.", kMostPoints, items)
                                   : "Each point is one item of the campaign."};
  for (const FactorScatter& scatter : scatters) over.blocks.push_back(make_factor_chart(result, scatter));
  page.add(std::move(over));
  if (scatters.size() >= 2) {
    page.add({"Result over two factors", "", {make_map(result, scatters[0], scatters[1])}});
  }
  return page;
}

}  // namespace rollrig::report
