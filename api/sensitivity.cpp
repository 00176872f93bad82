#include "api/sensitivity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rollrig {
namespace {

/// "0.31 (0.27 to 0.35)"
std::string show(const campaigns::Index& index) {
  return fmt::format("{:.3g} ({:.3g} to {:.3g})", index.value, index.low_95, index.high_95);
}

Json write_index(const campaigns::Index& index) {
  return {{"value", index.value}, {"low_95", index.low_95}, {"high_95", index.high_95}};
}

/// Factors by the size of an index, the largest first.
std::vector<std::size_t> order_by(const std::vector<campaigns::Index>& indices) {
  std::vector<std::size_t> order(indices.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&indices](std::size_t a, std::size_t b) { return indices[a].value > indices[b].value; });
  return order;
}

/// Of a design's points, those that do not count.
std::string describe_left_out(std::size_t left_out, const campaigns::DesignInput& design) {
  if (left_out == 0) return "";
  return fmt::format(
      " {} of {} points are left out, because an item of each failed, lacks this result or is not done: if "
      "these are no accidents, the numbers hold for a part of the range only.",
      left_out, design.points);
}

}  // namespace

Sensitivity describe_indices(const std::string& result, const campaigns::DesignInput& design,
                             const campaigns::SobolIndices& indices) {
  const std::size_t left_out = design.points - indices.points;
  Json json{{"format", "rollrig-sensitivity/1"},
            {"result", result},
            {"design", design.name},
            {"points", indices.points},
            {"points_left_out", left_out},
            {"mean", indices.mean},
            {"sd", std::sqrt(indices.variance)},
            {"factors", Json::array()}};
  Table table{fmt::format("Sobol' indices of {}", result), {"factor", "alone", "with interactions"}, {}};
  const std::vector<std::size_t> order = order_by(indices.total);
  for (const std::size_t f : order) {
    json["factors"].push_back({{"key", design.factors[f].key},
                               {"first", write_index(indices.first[f])},
                               {"total", write_index(indices.total[f])}});
    table.rows.push_back({design.factors[f].key, show(indices.first[f]), show(indices.total[f])});
  }
  return {json, table,
          fmt::format("Shares of the variance of {}, with intervals of 95 % from {} points. Mean {:.5g}, standard "
                      "deviation {:.3g}.{}",
                      result, indices.points, indices.mean, std::sqrt(indices.variance),
                      describe_left_out(left_out, design)),
          order};
}

Sensitivity describe_effects(const std::string& result, const campaigns::DesignInput& design,
                             const campaigns::MorrisMeasures& measures) {
  const std::size_t left_out = design.points - measures.points;
  Json json{{"format", "rollrig-sensitivity/1"},
            {"result", result},
            {"design", design.name},
            {"points", measures.points},
            {"points_left_out", left_out},
            {"factors", Json::array()}};
  Table table{fmt::format("Elementary effects on {}", result), {"factor", "mean size", "mean", "sd"}, {}};
  const std::vector<std::size_t> order = order_by(measures.mean_size);
  for (const std::size_t f : order) {
    json["factors"].push_back({{"key", design.factors[f].key},
                               {"mean_size", write_index(measures.mean_size[f])},
                               {"mean", measures.mean[f]},
                               {"sd", measures.deviation[f]}});
    table.rows.push_back({design.factors[f].key, show(measures.mean_size[f]), fmt::format("{:+.3g}", measures.mean[f]),
                          fmt::format("{:.3g}", measures.deviation[f])});
  }
  return {json, table,
          fmt::format("Change of {} as a factor goes from its 12.5 % to its 62.5 % quantile, or from 37.5 % to 87.5 %: "
                      "the mean of {} trajectories.{}",
                      result, measures.points, describe_left_out(left_out, design)),
          order};
}

}  // namespace rollrig
