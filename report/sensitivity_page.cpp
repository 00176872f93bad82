#include "report/sensitivity_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "report/blocks.h"
#include "sim/core/text.h"

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
    return make_bars({"Share of the variance of " + plain_name(result), "%"}, names,
                     Json::array({make_index_series(factors, "first", "alone", 100.0),
                                  make_index_series(factors, "total", "with interactions", 100.0)}),
                     "The factor with the largest share first. Whiskers: intervals of 95 %.");
  }
  return make_bars({"Size of the change of " + plain_name(result), shown_unit(result)}, names,
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
  return make_curves({plain_name(key), shown_unit(key)}, {plain_name(result), shown_unit(result)},
                     Json::array({points.finish("items")}));
}

constexpr std::size_t kBins = 5;  // Assumed: of each factor of a map

/// The bin of each value, of bins that hold equally many: kBins where it is not finite.
std::vector<std::size_t> sort_into_bins(const std::vector<double>& values, std::vector<double>& limits) {
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  limits.clear();
  for (std::size_t bin = 0; bin <= kBins; ++bin) limits.push_back(sorted[bin * (sorted.size() - 1) / kBins]);
  std::vector<std::size_t> bins;
  for (const double value : values) {
    const auto above = std::upper_bound(limits.begin() + 1, limits.end() - 1, value);
    bins.push_back(static_cast<std::size_t>(above - limits.begin()) - 1);
  }
  return bins;
}

std::string name_bin(const std::vector<double>& limits, std::size_t bin) {
  return fmt::format("{:.4g} to {:.4g}", limits[bin], limits[bin + 1]);
}

std::string with_unit(const std::string& key) {
  const std::string unit = shown_unit(last_part(key));
  return plain_name(last_part(key)) + (unit.empty() ? "" : " in " + unit);
}

/// The mean result over two factors, each in bins that hold equally many items.
Block make_map(const std::string& result, const FactorScatter& across, const FactorScatter& down) {
  FactorScatter x{across.key, {}, {}};
  std::vector<double> y_values;
  for (std::size_t i = 0; i < across.results.size(); ++i) {
    if (!std::isfinite(across.results[i])) continue;
    x.values.push_back(across.values[i]);
    x.results.push_back(across.results[i]);
    y_values.push_back(down.values[i]);
  }
  std::vector<double> x_limits;
  std::vector<double> y_limits;
  const std::vector<std::size_t> x_bins = sort_into_bins(x.values, x_limits);
  const std::vector<std::size_t> y_bins = sort_into_bins(y_values, y_limits);
  std::vector<std::vector<double>> sums(kBins, std::vector<double>(kBins));
  std::vector<std::vector<std::size_t>> counts(kBins, std::vector<std::size_t>(kBins));
  for (std::size_t i = 0; i < x.results.size(); ++i) {
    sums[y_bins[i]][x_bins[i]] += x.results[i];
    ++counts[y_bins[i]][x_bins[i]];
  }
  const double count = static_cast<double>(x.results.size());
  const double mean = std::accumulate(x.results.begin(), x.results.end(), 0.0) / count;
  double largest = 0.0;  // deviation of a cell, to which the strongest shade belongs
  const auto mean_of = [&](std::size_t row, std::size_t column) {
    return sums[row][column] / static_cast<double>(counts[row][column]);
  };
  const auto visit = [&](const auto& take) {
    for (std::size_t row = 0; row < kBins; ++row) {
      for (std::size_t column = 0; column < kBins; ++column) {
        if (counts[row][column] > 0) take(row, column);
      }
    }
  };
  visit(
      [&](std::size_t row, std::size_t column) { largest = std::max(largest, std::abs(mean_of(row, column) - mean)); });
  Block block{{"type", "map"},
              {"caption", fmt::format("Mean of {} over the two factors that matter most", with_unit(result))},
              {"heads", {with_unit(down.key), ""}},
              {"columns", Json::array()},
              {"rows", Json::array()},
              {"legend", fmt::format("Columns: {}. Of each factor, every range holds equally many items. Shades: above "
                                     "and below the mean of all items, {:.4g}.",
                                     with_unit(across.key), mean)}};
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    block["columns"].push_back(name_bin(x_limits, bin));
    block["rows"].push_back({{"group", ""},
                             {"label", name_bin(y_limits, bin)},
                             {"cells", Json::array({nullptr, nullptr, nullptr, nullptr, nullptr})}});
  }
  visit([&](std::size_t row, std::size_t column) {
    const double deviation = mean_of(row, column) - mean;
    block["rows"][row]["cells"][column] = {{"text", fmt::format("{:.4g}", mean_of(row, column))},
                                           {"shade", largest > 0.0 ? std::lround(4.0 * deviation / largest) : 0},
                                           {"marked", ""},
                                           {"note", format_count(counts[row][column], "item")}};
  });
  return block;
}

}  // namespace

Page make_sensitivity_page(const Json& sensitivity, const Table& table, const std::string& explanation,
                           const std::vector<FactorScatter>& scatters) {
  const std::string result = sensitivity["result"];
  Page page{"campaign sensitivity", "Sensitivity of " + plain_name(result),
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
