#include "comparison/comparison_json.h"

#include <cmath>

#include "sim/core/csv.h"

namespace rollrig::comparison {
namespace {

Json to_json(const std::optional<double>& number) { return number.has_value() ? Json(*number) : Json(); }

Json make_difference_json(const Difference& difference) {
  Json json = {{"difference", to_json(difference.value)},
               {"percent", to_json(difference.percent)},
               {"sd", to_json(difference.sd)},
               {"ci95", nullptr}};
  if (difference.low_95.has_value()) {
    json["ci95"] = {*difference.low_95, *difference.high_95};
    json["half_width_95"] = *difference.high_95 - *difference.value;
  }
  if (!difference.why_no_interval.empty()) json["why_no_interval"] = difference.why_no_interval;
  return json;
}

Json make_value_json(const ComparedValue& value) {
  Json json = {{"name", value.name}};
  if (!value.place.empty()) json["place"] = value.place;
  json["label"] = value.label;
  json["unit"] = value.unit;
  json["values"] = make_list(value.values, &to_json);
  json["differences"] = make_list(value.differences, &make_difference_json);
  return json;
}

Json make_waterfall_json(const EnergyWaterfall& waterfall) {
  Json json = {{"compared", waterfall.compared},
               {"term", waterfall.term},
               {"start_J", waterfall.start_J},
               {"steps", make_list(waterfall.steps,
                                   [](const EnergyStep& step) {
                                     return Json{{"name", step.name}, {"energy_J", step.energy_J}};
                                   })},
               {"end_J", waterfall.end_J}};
  if (!waterfall.missing.empty()) json["missing"] = waterfall.missing;
  return json;
}

}  // namespace

const char* name_of(ComparedKind kind) {
  return kind == ComparedKind::kResults ? "results" : kind == ComparedKind::kSets ? "measurement sets" : "tires";
}

Json make_comparison_json(const Comparison& comparison) {
  Json json = {{"format", "rollrig-comparison/1"},
               {"kind", name_of(comparison.kind)},
               {"names", comparison.names},
               {"message", comparison.message},
               {"inputs", make_list(comparison.inputs,
                                    [](const DifferentInput& input) {
                                      return Json{{"name", input.name}, {"values", input.values}};
                                    })},
               {"values", make_list(comparison.values, &make_value_json)}};
  if (!comparison.waterfalls.empty()) json["waterfalls"] = make_list(comparison.waterfalls, &make_waterfall_json);
  json["method"] = comparison.method;
  if (!comparison.warnings.empty()) json["warnings"] = comparison.warnings;
  return json;
}

std::string make_differences_csv(const Comparison& comparison) {
  CsvWriter csv({"name", "place", "unit", "reference", "compared", "reference_value", "value", "difference", "percent",
                 "sd", "low_95", "high_95", "why_no_interval"});
  const auto add = [&csv](const std::optional<double>& number) {
    csv.add(CsvWriter::Rounded{number.value_or(std::nan("")), 12});
  };
  for (const ComparedValue& value : comparison.values) {
    for (std::size_t i = 1; i < comparison.names.size(); ++i) {
      const Difference& difference = value.differences[i - 1];
      for (const std::string& text :
           {value.name, value.place, value.unit, comparison.names.front(), comparison.names[i]}) {
        csv.add(text);
      }
      for (const std::optional<double>& number :
           {value.values.front(), value.values[i], difference.value, difference.percent, difference.sd,
            difference.low_95, difference.high_95}) {
        add(number);
      }
      csv.add(difference.why_no_interval);
      csv.end_row();
    }
  }
  return csv.take();
}

}  // namespace rollrig::comparison
