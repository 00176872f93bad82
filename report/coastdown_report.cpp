// Test reports of coastdowns: of a simulated one (`run coastdown`), and of a fit of recorded ones (`fit road-load`).
#include <fmt/format.h>

#include <array>
#include <utility>

#include "report/blocks.h"
#include "report/fit_pages.h"
#include "report/run_reports.h"
#include "scenarios/run/results.h"
#include "sim/core/text.h"

namespace rollrig::report {
namespace {

using scenarios::show_number;

constexpr const char* kCoefficientNames[] = {"A, f0: force at standstill", "B, f1: rise with speed",
                                             "C, f2: rise with the square of speed"};

ReportSection make_coastdown_laboratory() {
  return {"Laboratory and track",
          {ReportForm{{make_blank("Laboratory"), make_blank("Applicant"), make_blank("Test report number"),
                       make_blank("Date and time of the test"), make_blank("Track, its surface and grade"),
                       make_blank("Driver"), make_blank("Comments")}}}};
}

/// What no file says of a vehicle.
void add_vehicle_blanks(ReportForm& form) {
  for (const char* blank : {"Manufacturer, model, model year", "Vehicle identification number", "Odometer",
                            "Tires: brand, size, tread depth", "Tire pressure, cold"}) {
    form.fields.push_back(make_blank(blank));
  }
}

/// A, B, C of a place of the JSON, with a column of what stands beside them.
ReportTable make_coefficient_report(const ReportValues& values, const std::string& title, const std::string& place,
                                    const std::array<const char*, 3>& keys, bool has_interval) {
  ReportTable table{title, {"coefficient", "value", "standard deviation", "unit"}, {}, 0};
  if (has_interval) table.columns = {"coefficient", "value", "standard deviation", "95 % from", "to", "unit"};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string own = place + "/" + keys[i];
    std::vector<ReportCell> row{{kCoefficientNames[i]},
                                values.number(own, ".5g"),
                                values.has(own + "_sd") ? values.number(own + "_sd", ".3g") : ReportCell{"-"}};
    if (has_interval) {
      for (const char* end : {"/0", "/1"}) row.push_back(values.number(place + "/ci95/" + keys[i] + end, ".5g"));
    }
    row.push_back({shown_unit(keys[i])});
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportSection make_run_conditions(const scenarios::RunSpec& spec, const scenarios::Outcome& outcome) {
  const auto setting = [&outcome](const char* key) { return outcome.settings[key].dump(); };
  ReportForm form{
      {make_field("Warm-up", fmt::format("{} min at {} km/h", setting("warm_up_min"), setting("warm_up_speed_km_h"))),
       make_field("Coastdowns", fmt::format("{} in each direction, from {} to {} km/h", setting("pairs"),
                                            setting("from_km_h"), setting("to_km_h"))),
       make_field("Ambient temperature", fmt::format("{} °C", setting("ambient_degC"))),
       make_field("Ambient pressure", show_number("pressure_kPa", ".2f", spec.rig.environment.ambient_pressure_Pa)),
       make_field("Wind along the road", fmt::format("{} m/s", setting("wind_m_s"))),
       make_field("Slope of the road", fmt::format("{} %", setting("slope_percent")))}};
  if (!is_on_road(spec.rig.kind->traits)) {
    form.fields.resize(form.fields.size() - 2);
    form.fields.push_back(make_field("Machine", fmt::format("rollers (rig file '{}')", spec.rig.name)));
  }
  return {"Test", {form}};
}

ReportSection make_run_vehicle(const scenarios::RunSpec& spec) {
  const rigs::VehicleFile& vehicle = *spec.vehicle;
  ReportForm form{{make_field("Vehicle file", vehicle.name)}};
  add_vehicle_blanks(form);
  form.fields.push_back(make_field("Test mass", show_number("mass_kg", ".1f", vehicle.body.mass_kg)));
  form.fields.push_back(make_field("Rotating mass", show_number("mass_kg", ".1f", vehicle.body.rotating_mass_kg)));
  form.fields.push_back(make_field("Tire file", fmt::format("{} ({})", spec.tire.name, spec.tire.designation)));
  return {"Vehicle", {form}};
}

}  // namespace

TestReport make_coastdown_report(const scenarios::RunSpec& spec, const scenarios::Outcome& outcome,
                                 const ReportValues& values) {
  TestReport report;
  report.title = "Test report: road load by coastdown";
  report.standard =
      "Road load A + B v + C v^2 as 40 CFR 1066, subpart D asks for it, by SAE J2263 (not read; as cited by 40 CFR "
      "1066.301). The fields are those that such a test needs; neither text has a form.";
  report.subject = fmt::format("Vehicle {}, tire {} ({})", spec.vehicle->name, spec.tire.name, spec.tire.designation);
  const std::string at = is_on_road(spec.rig.kind->traits) ? "At reference conditions: 20 °C, 98.21 kPa, still air"
                                                           : "Rollers and vehicle together, as tested";
  report.sections = {make_coastdown_laboratory(),
                     make_run_vehicle(spec),
                     make_run_conditions(spec, outcome),
                     {"Results",
                      {make_coefficient_report(values, at, "/result", {"A_N", "B_N_per_km_h", "C_N_per_km_h2"}, false),
                       make_json_table(values, "Force", "/result/force_N",
                                       {{"speed_km_h", "speed, km/h"}, {"force_N", "force, N"}}, ".1f"),
                       make_json_table(values, "Coastdowns", "/result/coastdowns",
                                       {{"name", "coastdown"}, {"duration_s", "time, s"}}, ".2f")}}};
  return report;
}

TestReport make_road_load_report(const estimation::CoastdownFile& file, const Json& result,
                                 const std::vector<ReportFile>& files) {
  const ReportValues values(result);
  const bool per_mass = values.has("/A_m_s2");
  TestReport report;
  report.title = "Test report: road load by coastdown";
  report.standard =
      "Road load A + B v + C v^2 as 40 CFR 1066, subpart D asks for it, by SAE J2263 (not read; as cited by 40 CFR "
      "1066.301). The fields are those that such a test needs; neither text has a form.";
  report.subject = file.path;
  report.is_simulated = file.is_simulated;
  for (const Json& warning : result["warnings"]) report.warnings.push_back(warning.get<std::string>());
  ReportForm vehicle;
  add_vehicle_blanks(vehicle);
  vehicle.fields.push_back(values.has("/options/mass_kg") ? values.field("Mass as tested", "/options/mass_kg", ".1f")
                                                          : make_blank("Mass as tested"));
  vehicle.fields.push_back(values.has("/options/effective_mass_kg")
                               ? values.field("Effective mass", "/options/effective_mass_kg", ".1f")
                               : make_blank("Effective mass"));
  ReportForm test{{make_field("Recording", file.is_trace ? "speed over time" : "times through speed bins"),
                   make_field("Coastdowns", format_count(file.data.runs.size(), "run")),
                   values.field("Lowest speed used", "/options/speed_from_km_h", ".1f"),
                   values.field("Reference temperature", "/options/reference_temperature_degC", ".1f"),
                   values.field("Reference pressure", "/options/reference_pressure_kPa", ".2f"),
                   values.field("Corrected for the temperature of the air", "/corrected/ambient"),
                   values.field("Corrected for measured wind", "/corrected/measured_wind"),
                   values.field("Fall of A and B with temperature", "/options/rolling_fall_per_K", ".4g")}};
  if (!values.json()["corrected"]["ambient"].get<bool>()) {
    test.fields.push_back(make_blank("Ambient temperature and pressure"));
    test.fields.push_back(make_blank("Wind"));
  }
  const std::array<const char*, 3> keys =
      per_mass ? std::array<const char*, 3>{"A_m_s2", "B_m_s2_per_km_h", "C_m_s2_per_km_h2"}
               : std::array<const char*, 3>{"A_N", "B_N_per_km_h", "C_N_per_km_h2"};
  ReportSection results{"Results", {make_coefficient_report(values, "At reference conditions", "", keys, true)}};
  if (values.has("/lbf_mph")) {
    results.parts.push_back(make_coefficient_report(values, "In lbf and mph", "/lbf_mph",
                                                    {"A_lbf", "B_lbf_per_mph", "C_lbf_per_mph2"}, true));
  }
  ReportSection checks{
      "Checks of the standards",
      {make_json_table(
          values, "", "/checks",
          {{"name", "check"}, {"status", "status"}, {"found", "found"}, {"limit", "limit"}, {"clause", "clause"}},
          ".4g")}};
  report.sections = {make_coastdown_laboratory(), {"Vehicle", {vehicle}}, {"Test", {test}}, results, checks};
  for (ReportSection& section : make_uncertainty_sections(values)) report.sections.push_back(std::move(section));
  report.files = files;
  return report;
}

}  // namespace rollrig::report
