// The report of a road load by a procedure. Neither UN GTR 15 nor SAE J2263 could be read as a whole: the fields are
// those that a reader needs to judge the road load, and to repeat it.
#include <fmt/format.h>

#include <utility>

#include "report/road_load_procedure_page.h"
#include "sim/core/text.h"

namespace rollrig::report {
namespace {

using estimation::RoadLoadProcedure;

ReportSection make_procedure_laboratory() {
  return {
      "Laboratory and track",
      {ReportForm{{make_blank("Laboratory"), make_blank("Applicant"), make_blank("Test report number"),
                   make_blank("Date and time of the test"), make_blank("Track, its surface and grade"),
                   make_blank("Driver"), make_blank("Last calibration of the instruments"), make_blank("Comments")}}}};
}

ReportSection make_procedure_vehicle(const ReportValues& values, const RoadLoadProcedure& procedure) {
  ReportForm form;
  for (const char* blank : {"Manufacturer, model, model year", "Vehicle identification number", "Odometer",
                            "Tires: brand, size, tread depth, class of rolling resistance", "Tire pressure, cold",
                            "Warm-up and its length"}) {
    form.fields.push_back(make_blank(blank));
  }
  form.fields.push_back(values.field("Mass as tested", "/mass_kg", ".1f"));
  form.fields.push_back(values.field("Mass to which it is corrected", "/corrected_to_mass_kg", ".1f"));
  form.fields.push_back(
      values.field(procedure.rotating_mass_assumed ? "Rotating mass, 3 % of the mass (assumed)" : "Rotating mass",
                   "/rotating_mass_kg", ".1f"));
  if (values.has("/wheel_radius_m")) form.fields.push_back(values.field("Dynamic radius", "/wheel_radius_m", ".4f"));
  return {"Vehicle", {form}};
}

ReportSection make_procedure_test(const ReportValues& values, const RoadLoadProcedure& procedure) {
  ReportForm form{{make_field("Runs", fmt::format("{}", procedure.run_names.size()))}};
  const auto add = [&](const char* name, const char* place, const char* digits, const char* blank) {
    form.fields.push_back(values.has(place) && !values.json().at(Json::json_pointer(place)).is_null()
                              ? values.field(name, place, digits)
                              : make_blank(blank));
  };
  add("Air temperature, mean", "/ambient_degC", ".1f", "Air temperature");
  add("Air pressure, mean", "/ambient_pressure_kPa", ".2f", "Air pressure");
  constexpr const char* kWind = "Wind along the road that both headings have";
  form.fields.push_back(procedure.wind_m_s.has_value() ? values.field(kWind, "/wind_m_s", ".2f")
                                                       : make_field(kWind, "not measured"));
  form.fields.push_back(values.field("Reference temperature", "/reference_temperature_degC", ".1f"));
  form.fields.push_back(values.field("Reference pressure", "/reference_pressure_kPa", ".2f"));
  return {"Test", {form}};
}

ReportTable make_procedure_results(const ReportValues& values) {
  ReportTable table{"At reference conditions",
                    {"coefficient", "value", "standard deviation", "95 % from", "to", "of the runs alone", "unit"},
                    {},
                    0};
  constexpr std::pair<const char*, const char*> kRows[] = {
      {"f0_N", "N"}, {"f1_N_per_km_h", "N/(km/h)"}, {"f2_N_per_km_h2", "N/(km/h)²"}};
  for (const auto& [key, unit] : kRows) {
    const std::string own = std::string("/") + key;
    table.rows.push_back({{std::string(key).substr(0, 2)},
                          values.number(own, ".5g"),
                          values.number(own + "_sd", ".2g"),
                          values.number("/ci95" + own + "/0", ".5g"),
                          values.number("/ci95" + own + "/1", ".5g"),
                          values.number("/sd_of_runs" + own, ".2g"),
                          {unit}});
  }
  return table;
}

}  // namespace

TestReport make_procedure_report(const RoadLoadProcedure& procedure, const std::string& source, const Json& json,
                                 const std::vector<ReportFile>& files) {
  const ReportValues values(json);
  TestReport report;
  report.title = "Test report: road load, " + title_of(procedure.kind);
  report.standard =
      "rollrig knows only parts of the standards (docs/road_load_procedures.md), and these parts prescribe no form. "
      "The fields are those that a reader needs to judge and repeat the test.";
  report.subject = fmt::format("{}, {}", source, format_count(procedure.run_names.size(), "run"));
  report.is_simulated = procedure.is_simulated;
  report.warnings = procedure.warnings;
  ReportSection results{"Results", {make_procedure_results(values)}};
  if (!json["reference_speeds"].empty()) {
    const bool is_torque = json["reference_speeds"][0].contains("torque_Nm");
    results.parts.push_back(make_json_table(values, "Reference speeds", "/reference_speeds",
                                            {{"speed_km_h", "speed, km/h"},
                                             {"pairs", "pairs"},
                                             {is_torque ? "torque_Nm" : "time_s", is_torque ? "torque, Nm" : "time, s"},
                                             {"precision_percent", "precision, %"},
                                             {is_torque ? "mean_Nm" : "force_N", is_torque ? "mean, Nm" : "force, N"}},
                                            ".4g"));
  }
  const ReportSection checks{
      "Checks of the procedure",
      {make_json_table(
          values, "", "/checks",
          {{"name", "check"}, {"status", "status"}, {"found", "found"}, {"limit", "limit"}, {"clause", "clause"}},
          ".4g")}};
  report.sections = {make_procedure_laboratory(), make_procedure_vehicle(values, procedure),
                     make_procedure_test(values, procedure), results, checks};
  for (ReportSection& section : make_uncertainty_sections(values)) report.sections.push_back(std::move(section));
  report.files = files;
  return report;
}

}  // namespace rollrig::report
