#include "report/sensitivity_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
  return page;
}

}  // namespace rollrig::report
