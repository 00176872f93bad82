// The reports of laws of rolling resistance. The forms of SAE J2452 and SAE J1269 could not be read: the fields are
// those that a reader needs to judge the law, and to repeat it.
#include <fmt/format.h>

#include "report/rolling_law_page.h"
#include "sim/core/text.h"

namespace rollrig::report {
namespace {

ReportSection make_law_laboratory() {
  return {"Laboratory",
          {ReportForm{{make_blank("Laboratory"), make_blank("Applicant"), make_blank("Test report number"),
                       make_blank("Date of the test"), make_blank("Test machine, its drum and surface"),
                       make_blank("Measurement method (force or torque)"),
                       make_blank("Last calibration of the machine"), make_blank("Comments")}}}};
}

ReportSection make_law_tire(const estimation::RollingTest& test) {
  return {"Test tire",
          {ReportForm{{test.tire.empty() ? make_blank("Tire") : make_field("Tire", test.tire),
                       make_blank("Brand and trade description"), make_blank("Size and service description"),
                       make_blank("Serial number or date code"), make_blank("Rim width and material"),
                       make_blank("Break-in, conditioning and ambient temperature")}}}};
}

ReportSection make_law_points(const ReportValues& values) {
  ReportTable table{"", {"speed, km/h", "load, N", "pressure, kPa", "measured, N", "law, N"}, {}, 0};
  for (std::size_t i = 0; i < values.json()["points"].size(); ++i) {
    const std::string point = fmt::format("/points/{}", i);
    table.rows.push_back({values.number(point + "/speed_km_h", ".1f"), values.number(point + "/load_N", ".0f"),
                          values.number(point + "/pressure_kPa", ".1f"),
                          values.number(point + "/rolling_resistance_N", ".2f"),
                          values.number(point + "/fitted_N", ".2f")});
  }
  return {"Points", {table}};
}

ReportTable make_law_coefficients(const ReportValues& values) {
  ReportTable table{"Coefficients", {"", "value", "standard deviation", "95 % from", "to", "unit"}, {}, 0};
  for (const auto& coefficient : values.json()["coefficients"].items()) {
    const std::string place = "/coefficients/" + coefficient.key();
    const std::string unit = coefficient.value()["unit"].get<std::string>();
    table.rows.push_back({{coefficient.key()},
                          values.number(place + "/value", ".5g"),
                          values.number(place + "/sd", ".2g"),
                          values.number(place + "/ci95/0", ".5g"),
                          values.number(place + "/ci95/1", ".5g"),
                          {unit.empty() ? "-" : unit}});
  }
  return table;
}

ReportForm make_law_residuals(const ReportValues& values) {
  ReportForm form{
      {values.field("Degrees of freedom", "/statistics/degrees_of_freedom"),
       values.field("Standard deviation of the residuals", "/statistics/residual_sd_N", ".3g"),
       values.field("Largest residual, share of the force", "/statistics/largest_residual_percent", ".2g")}};
  if (values.has("/statistics/lack_of_fit")) {
    form.fields.push_back(
        {"Lack of fit: F and p",
         {values.number("/statistics/lack_of_fit/F", ".3g"), values.number("/statistics/lack_of_fit/p", ".2g")}});
  } else {
    const int repeated_points = values.json()["statistics"]["repeated_points"].get<int>();
    form.fields.push_back(make_field("Lack of fit", estimation::explain_no_lack_of_fit(repeated_points)));
  }
  return form;
}

/// One force of the reference condition with its interval.
std::vector<ReportCell> make_force_row(const ReportValues& values, const std::string& name, const std::string& key) {
  const std::string place = "/reference/" + key;
  return {{name},
          values.number(place + "/value_N", ".2f"),
          values.number(place + "/sd_N", ".2g"),
          values.number(place + "/ci95_N/0", ".2f"),
          values.number(place + "/ci95_N/1", ".2f")};
}

ReportSection make_law_reference(const ReportValues& values) {
  if (!values.has("/reference")) {
    return {"Standard reference condition",
            {ReportForm{{make_blank("Maximum load and base pressure of the tire"),
                         make_field("Forces at the reference condition",
                                    "not computed: maximum load or base pressure is not known")}}}};
  }
  ReportForm form{{values.field("Load", "/reference/load_N", ".0f"),
                   values.field("Pressure (gauge)", "/reference/pressure_kPa", ".1f")}};
  if (values.has("/reference/speed_km_h")) {
    form.fields.push_back(values.field("Speed", "/reference/speed_km_h", ".1f"));
  }
  form.fields.push_back(values.field("Coefficient of rolling resistance", "/reference/rrc_N_per_kN", ".3f"));
  ReportTable forces{"Forces, N", {"", "value", "standard deviation", "95 % from", "to"}, {}, 0};
  forces.rows.push_back(make_force_row(values, "rolling resistance", "rolling_resistance"));
  if (values.has("/reference/smerf")) {
    const auto cycle = [&values](const char* key) {
      return values.json()["reference"][key]["cycle"].get<std::string>();
    };
    forces.rows.push_back(make_force_row(values, "MERF, mean over " + cycle("merf_urban"), "merf_urban"));
    forces.rows.push_back(make_force_row(values, "MERF, mean over " + cycle("merf_highway"), "merf_highway"));
    forces.rows.push_back(make_force_row(values, "SMERF, 0.55 and 0.45 of these", "smerf"));
  }
  return {"Standard reference condition", {form, forces}};
}

/// What the report of a fit without a budget says in its place, and the blanks of every one.
ReportSection make_law_instruments(bool has_budget) {
  return {
      has_budget ? "Instruments" : "Uncertainty",
      {ReportText{has_budget ? "The intervals of the coefficients and forces above hold what the points scatter about "
                               "the law. The uncertainty budgets also hold errors that all points share."
                             : "The intervals hold what the points scatter about the law. An error that all points "
                               "share is not in them: add it from the certificates of the instruments."},
       ReportForm{{make_blank("Calibration of force or torque"), make_blank("Calibration of load"),
                   make_blank("Calibration of pressure"), make_blank("Alignment to a reference machine")}}}};
}

}  // namespace

TestReport make_rolling_law_report(const estimation::RollingTest& test, const Json& json,
                                   const std::vector<ReportFile>& files) {
  const ReportValues values(json);
  const bool is_j2452 = json["format"] == "rollrig-j2452-fit/1";
  TestReport report;
  report.title = fmt::format("Test report: rolling resistance of a tire, SAE {}", is_j2452 ? "J2452" : "J1269");
  report.standard =
      fmt::format("SAE {} was not read. The fields are those that the law needs to be judged and repeated.",
                  is_j2452 ? "J2452" : "J1269");
  report.subject = fmt::format("{}{}", test.tire.empty() ? "" : "Tire " + test.tire + ", ",
                               format_count(json["points"].size(), "point"));
  report.is_simulated = test.is_simulated;
  if (json.contains("warnings")) report.warnings = json["warnings"].get<std::vector<std::string>>();
  report.sections = {
      make_law_laboratory(),
      make_law_tire(test),
      {"Law",
       {ReportText{fmt::format("{}, in N, kPa{}.", json["law"].get<std::string>(), is_j2452 ? " and km/h" : "")},
        make_law_coefficients(values), make_law_residuals(values)}},
      make_law_reference(values),
      make_law_instruments(values.has("/uncertainty"))};
  for (ReportSection& section : make_uncertainty_sections(values)) report.sections.push_back(std::move(section));
  report.sections.push_back(make_law_points(values));
  report.files = files;
  return report;
}

}  // namespace rollrig::report
