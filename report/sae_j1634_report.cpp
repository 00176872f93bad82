// The test report of the SAE J1634 multi-cycle test.
#include <fmt/format.h>

#include <array>
#include <vector>

#include "report/blocks.h"
#include "report/run_reports.h"
#include "scenarios/run/results.h"
#include "scenarios/run/tire_validity.h"

namespace rollrig::report {
namespace {

using scenarios::show_number;

ReportSection make_j1634_laboratory() {
  return {"Laboratory",
          {ReportForm{{make_blank("Laboratory"), make_blank("Applicant"), make_blank("Test report number"),
                       make_blank("Date of the test"), make_blank("Dynamometer and its last calibration"),
                       make_blank("Instrument for DC energy, and where it is connected"), make_blank("Comments")}}}};
}

ReportSection make_j1634_vehicle(const scenarios::RunSpec& spec) {
  ReportForm form{{make_field("Vehicle file", spec.vehicle->name)}};
  for (const char* blank : {"Manufacturer, model, model year", "Vehicle identification number", "Odometer",
                            "Battery: type and rated capacity"}) {
    form.fields.push_back(make_blank(blank));
  }
  form.fields.push_back(make_field("Test mass", show_number("mass_kg", ".1f", spec.vehicle->body.mass_kg)));
  form.fields.push_back(make_field("Tire file", fmt::format("{} ({})", spec.tire.name, spec.tire.designation)));
  return {"Vehicle", {form}};
}

ReportSection make_j1634_test(const scenarios::RunSpec& spec, const scenarios::Outcome& outcome) {
  const auto setting = [&outcome](const char* key, const char* digits) {
    const Json& value = outcome.settings[key];
    return value.is_number() ? show_number(key, digits, unit_of_key(key).to_si(value.get<double>())) : std::string("-");
  };
  ReportForm form{{make_field("Order of the sections", outcome.settings["variant"].get<std::string>()),
                   make_field("Machine", fmt::format("{} (rig file '{}')", spec.rig.kind->word, spec.rig.name)),
                   make_field("Dynamometer setting A", setting("set_A_N", ".3f")),
                   make_field("Dynamometer setting B", setting("set_B_N_per_km_h", ".5f")),
                   make_field("Dynamometer setting C", setting("set_C_N_per_km_h2", ".6f")),
                   make_field("Ambient temperature", setting("ambient_degC", ".1f")),
                   make_field("Tire pressure, cold", setting("pressure_kPa", ".1f")),
                   make_field("Soak after each highway section", setting("soak_min", ".1f"))}};
  for (const char* blank :
       {"Charge at the start and at the end", "AC energy of the recharge", "Voltage and current record"}) {
    form.fields.push_back(make_blank(blank));
  }
  return {"Test", {form}};
}

/// Key, heading and digits of the columns; of those, what the result has.
ReportTable make_sections_table(const ReportValues& values, const std::string& list, const std::string& title,
                                const std::vector<std::array<const char*, 3>>& columns) {
  ReportTable table{title, {}, {}, 0};
  const Json& records = values.json().at(Json::json_pointer(list));
  for (std::size_t i = 0; i < records.size(); ++i) {
    table.rows.emplace_back();
    for (const auto& [key, heading, digits] : columns) {
      if (!records[0].contains(key)) continue;
      if (i == 0) table.columns.push_back(heading);
      const std::string place = fmt::format("{}/{}/{}", list, i, key);
      table.rows.back().push_back(values.has(place) ? values.number(place, digits) : ReportCell{"-"});
    }
  }
  return table;
}

/// Consumption and range by cycle, and combined.
ReportTable make_economy_table(const ReportValues& values, bool is_label) {
  if (is_label) {
    return make_sections_table(values, "/result/economy", "By the recharge, and values of the label",
                               {{"name", "cycle", ""},
                                {"ac_consumption_Wh_per_km", "AC, Wh/km", ".1f"},
                                {"ac_mi_per_kWh", "AC, mi/kWh", ".3f"},
                                {"mpge", "MPGe", ".1f"},
                                {"label_mpge", "label, MPGe", ".1f"},
                                {"label_range_mi", "label range, mi", ".1f"}});
  }
  return make_sections_table(values, "/result/economy", "DC energy from the battery, and range",
                             {{"name", "cycle", ""},
                              {"dc_consumption_Wh_per_km", "Wh/km", ".1f"},
                              {"dc_mi_per_kWh", "mi/kWh", ".3f"},
                              {"range_km", "range, km", ".1f"},
                              {"range_mi", "range, mi", ".1f"}});
}

/// Every single result, with what the scenario says of it.
ReportForm make_single_results(const scenarios::RunSpec& spec, const ReportValues& values) {
  ReportForm form;
  for (const auto& [key, value] : values.json()["result"].items()) {
    if (value.is_structured() || value.is_null()) continue;
    ReportField field = values.field(capitalized(plain_name(key)), "/result/" + key, ".5g");
    for (const scenarios::ResultInfo& info : spec.scenario->results) {
      if (info.key == key) field.note = info.doc;
    }
    form.fields.push_back(std::move(field));
  }
  return form;
}

ReportSection make_j1634_results(const scenarios::RunSpec& spec, const ReportValues& values) {
  ReportSection results{"Results", {}};
  ReportForm single = make_single_results(spec, values);
  if (!single.fields.empty()) results.parts.push_back(std::move(single));
  results.parts.push_back(make_sections_table(values, "/result/sections", "DC energy of the vehicle",
                                              {{"name", "section", ""},
                                               {"distance_km", "distance, km", ".3f"},
                                               {"wheel_energy_Wh", "hubs, Wh", ".1f"},
                                               {"recuperated_Wh", "recuperated, Wh", ".1f"},
                                               {"battery_energy_Wh", "battery, Wh", ".1f"}}));
  if (values.has("/result/economy")) {
    results.parts.push_back(make_economy_table(values, false));
    if (values.has("/result/economy/0/ac_consumption_Wh_per_km")) {
      results.parts.push_back(make_economy_table(values, true));
    }
  }
  if (!scenarios::has_tire_loss(spec)) {
    results.parts.push_back(ReportText{
        "Rolling resistance is not simulated separately: the measured A, B, C of the vehicle include the tires."});
    return results;
  }
  results.parts.push_back(make_sections_table(values, "/result/sections", "Rolling resistance",
                                              {{"name", "section", ""},
                                               {"vehicle_rr_energy_Wh", "all tires, Wh", ".1f"},
                                               {"rr_energy_Wh", "one tire, Wh", ".1f"},
                                               {"rr_energy_iso_Wh", "by ISO, Wh", ".1f"},
                                               {"mean_rrc_N_per_kN", "RRc, N/kN", ".2f"},
                                               {"temperature_start_degC", "liner from, °C", ".1f"},
                                               {"temperature_end_degC", "to, °C", ".1f"}}));
  return results;
}

}  // namespace

TestReport make_sae_j1634_report(const scenarios::RunSpec& spec, const scenarios::Outcome& outcome,
                                 const ReportValues& values) {
  TestReport report;
  report.title = "Test report: energy of an electric vehicle, SAE J1634";
  report.standard =
      "Multi-cycle test by SAE J1634, section 8 (not read), as 40 CFR 600.116-12(a) fixes it. The fields are those "
      "that such a test needs; 40 CFR 600.116-12 has no form.";
  report.subject = fmt::format("Vehicle {}, tire {} ({})", spec.vehicle->name, spec.tire.name, spec.tire.designation);
  report.sections = {make_j1634_laboratory(), make_j1634_vehicle(spec), make_j1634_test(spec, outcome),
                     make_j1634_results(spec, values)};
  return report;
}

}  // namespace rollrig::report
