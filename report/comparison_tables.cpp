#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "comparison/compared.h"
#include "report/blocks.h"
#include "report/comparison_page.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

std::string show_number_or_dash(const std::optional<double>& value, const char* digits = "{:.5g}") {
  return value.has_value() ? fmt::format(fmt::runtime(digits), *value) : "-";
}

std::string show_half_width(const Difference& difference) {
  return difference.sd.has_value() ? fmt::format("{:.2g}", *difference.high_95 - *difference.value) : "-";
}

std::string name_with_unit(const ComparedValue& value) {
  return capitalized(value.label) + (value.unit.empty() ? "" : ", " + value.unit);
}

/// Whether two values are the same but for rounding.
bool is_same_value(const ComparedValue& value, std::size_t other) {
  constexpr double kRounding = 1e-9;
  const std::optional<double>& difference = value.differences[other - 1].value;
  const std::optional<double>& reference = value.values.front();
  return difference.has_value() && std::abs(*difference) <= kRounding * std::max(1e-3, std::abs(*reference));
}

/// Differences of one from the reference, of one place. Values that are the same are counted.
Table make_difference_table(const Comparison& comparison, std::size_t other, const std::string& place) {
  const std::string title = fmt::format("{}{} minus {}", place.empty() ? "" : comparison::label_place(place) + ": ",
                                        comparison.names[other], comparison.names.front());
  Table table{title, {"name", comparison.names.front(), comparison.names[other], "difference", "+- (95 %)", "%"}, {}};
  std::size_t same = 0;
  for (const ComparedValue& value : comparison.values) {
    if (value.place != place) continue;
    if (is_same_value(value, other)) {
      ++same;
      continue;
    }
    const Difference& difference = value.differences[other - 1];
    table.rows.push_back({name_with_unit(value), show_number_or_dash(value.values.front()),
                          show_number_or_dash(value.values[other]), show_number_or_dash(difference.value, "{:+.4g}"),
                          show_half_width(difference), show_number_or_dash(difference.percent, "{:+.2f}")});
  }
  if (same > 0) table.rows.push_back({fmt::format("{} more, the same in both", same), "", "", "", "", ""});
  return table;
}

std::vector<std::string> list_places(const Comparison& comparison) {
  std::vector<std::string> places;
  for (const ComparedValue& value : comparison.values) {
    if (std::find(places.begin(), places.end(), value.place) == places.end()) places.push_back(value.place);
  }
  return places;
}

Table make_waterfall_table(const Comparison& comparison, const EnergyWaterfall& waterfall) {
  const auto show_kJ = [](double energy_J, const char* digits) {
    return fmt::format(fmt::runtime(digits), energy_J * 1e-3);
  };
  Table table{fmt::format("Energy in kJ: {} of {} to that of {}", plain_name(waterfall.term), comparison.names.front(),
                          waterfall.compared),
              {"term", "kJ"},
              {{comparison.names.front(), show_kJ(waterfall.start_J, "{:.3f}")}}};
  for (const EnergyStep& step : list_shown_steps(waterfall)) {
    table.rows.push_back({step.name, show_kJ(step.energy_J, "{:+.3f}")});
  }
  table.rows.push_back({waterfall.compared, show_kJ(waterfall.end_J, "{:.3f}")});
  return table;
}

}  // namespace

Table make_comparison_input_table(const Comparison& comparison) {
  Table table{"What differs in the inputs", {"input"}, {}};
  table.columns.insert(table.columns.end(), comparison.names.begin(), comparison.names.end());
  for (const DifferentInput& input : comparison.inputs) {
    table.rows.push_back({input.name});
    for (const std::string& value : input.values) table.rows.back().push_back(value.empty() ? "-" : value);
  }
  if (table.rows.empty()) table = {table.title, {}, {{"nothing", "all inputs are the same"}}};
  return table;
}

std::vector<Table> make_comparison_difference_tables(const Comparison& comparison) {
  std::vector<Table> tables;
  for (std::size_t other = 1; other < comparison.names.size(); ++other) {
    for (const std::string& place : list_places(comparison)) {
      tables.push_back(make_difference_table(comparison, other, place));
    }
  }
  return tables;
}

std::vector<EnergyStep> list_shown_steps(const EnergyWaterfall& waterfall) {
  constexpr double kSmall = 1e-3;     // of the largest step
  constexpr double kRounding = 1e-9;  // of the energies at the ends
  double most_J = 0.0;
  for (const EnergyStep& step : waterfall.steps) most_J = std::max(most_J, std::abs(step.energy_J));
  std::vector<EnergyStep> shown;
  double others_J = 0.0;
  for (const EnergyStep& step : waterfall.steps) {
    if (std::abs(step.energy_J) >= kSmall * most_J) {
      shown.push_back({plain_name(step.name), step.energy_J});
    } else {
      others_J += step.energy_J;
    }
  }
  if (std::abs(others_J) > kRounding * (std::abs(waterfall.start_J) + std::abs(waterfall.end_J))) {
    shown.push_back({"other terms", others_J});
  }
  return shown;
}

std::vector<Table> make_comparison_tables(const Comparison& comparison) {
  std::vector<Table> tables{make_comparison_input_table(comparison)};
  for (Table& table : make_comparison_difference_tables(comparison)) tables.push_back(std::move(table));
  for (const EnergyWaterfall& waterfall : comparison.waterfalls) {
    tables.push_back(make_waterfall_table(comparison, waterfall));
  }
  return tables;
}

std::vector<std::string> list_interval_reasons(const Comparison& comparison) {
  std::vector<std::pair<std::string, std::size_t>> counts;
  for (const ComparedValue& value : comparison.values) {
    for (const Difference& difference : value.differences) {
      if (difference.why_no_interval.empty()) continue;
      const auto known = std::find_if(counts.begin(), counts.end(),
                                      [&](const auto& count) { return count.first == difference.why_no_interval; });
      if (known == counts.end()) {
        counts.emplace_back(difference.why_no_interval, 1);
      } else {
        ++known->second;
      }
    }
  }
  std::vector<std::string> reasons;
  for (const auto& [why, count] : counts) {
    reasons.push_back(fmt::format("{} without an interval: {}", format_count(count, "difference"), why));
  }
  return reasons;
}

}  // namespace rollrig::report
