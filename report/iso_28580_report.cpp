// The test report of ISO 28580. Fields: UN Regulation No. 117, Annex 6, Appendix 3 as Regulation (EU) 2017/2400, Annex
// X, Appendix 2, section II repeats them (read at legislation.gov.uk/eur/2017/2400/annex/X/appendix/2).
#include <fmt/format.h>

#include <optional>

#include "report/run_reports.h"
#include "scenarios/common/readings.h"
#include "scenarios/run/results.h"

namespace rollrig::report {
namespace {

using scenarios::RunSpec;
using scenarios::show_number;

ReportSection make_iso_laboratory() {
  return {"Laboratory",
          {ReportForm{{make_blank("Laboratory or technical service"), make_blank("Applicant"),
                       make_blank("Test report number"), make_blank("Date of the test"), make_blank("Comments")}}}};
}

std::string describe_machine(const RunSpec& spec) {
  return fmt::format("{} (rig file '{}')", spec.rig.kind->word, spec.rig.name);
}

ReportSection make_iso_machine(const RunSpec& spec, const ReportValues& values) {
  const bool is_drum = reads_torque(spec.rig.kind->traits);
  ReportForm form{{make_field("Test machine", describe_machine(spec))}};
  form.fields.push_back(make_field(
      "Drum diameter", is_drum ? show_number("diameter_m", ".3f", spec.rig.drum.diameter_m) : "none: a flat belt"));
  form.fields.push_back(make_blank("Surface of the drum (smooth steel or textured)"));
  form.fields.push_back(is_drum ? values.field("Measurement method", "/result/method")
                                : make_field("Measurement method", "force at the belt"));
  form.fields.push_back(make_field("Skim test load", show_number("load_N", ".0f", spec.rig.skim.load_N)));
  form.fields.push_back(make_blank("Identification and last calibration of the machine"));
  return {"Test machine", {form}};
}

/// Class, load index and speed symbol, which the sidewall says.
void add_service_description(const std::optional<models::ServiceDescription>& service, ReportForm& form) {
  if (!service.has_value()) {
    form.fields.push_back(make_blank("Tire class (C1, C2, C3)"));
    form.fields.push_back(make_blank("Load index and speed symbol"));
    return;
  }
  form.fields.push_back(make_field("Tire class", name_of(service->tire_class)));
  form.fields.push_back(service->speed_symbol.empty()
                            ? make_field("Load index", std::to_string(service->load_index))
                            : make_field("Load index and speed symbol",
                                         fmt::format("{} {}", service->load_index, service->speed_symbol)));
}

ReportSection make_iso_tire(const RunSpec& spec) {
  ReportForm form{{make_field("Tire file", spec.tire.name)}};
  form.fields.push_back(spec.tire.designation.empty() ? make_blank("Size designation")
                                                      : make_field("Size designation", spec.tire.designation));
  add_service_description(spec.tire.service, form);
  for (const char* blank : {"Brand and trade description", "Reference inflation pressure", "Serial number or date code",
                            "Rim width and material"}) {
    form.fields.push_back(make_blank(blank));
  }
  return {"Test tire", {form}};
}

ReportSection make_iso_conditions(const RunSpec& spec, const scenarios::Outcome& outcome, const ReportValues& values) {
  ReportForm form{
      {values.field("Test speed", "/result/speed_km_h", ".1f"),
       values.field("Test load", "/result/load_N", ".0f"),
       {"Inflation pressure, set / verified / warm (gauge)",
        {values.number("/result/pressure_set_kPa", ".1f"), values.number("/result/pressure_verified_kPa", ".1f"),
         values.value("/result/cavity_pressure_kPa", ".1f")}},
       make_field("Ambient temperature as set", fmt::format("{} °C", outcome.settings["ambient_degC"].dump())),
       make_field("Thermal conditioning", fmt::format("{} h", outcome.settings["soak_h"].dump())),
       make_field("Warm-up", fmt::format("{} min", outcome.settings["warm_up_min"].dump())),
       values.field("Temperature of the liner", "/result/liner_temperature_degC", ".1f")}};
  const double loaded_radius_m =
      calc_loaded_radius_m(spec.tire.values, values.json()["result"]["load_N"].get<double>());
  form.fields.push_back(make_field("Distance from tire axis to drum surface, by the tire's stiffness",
                                   show_number("radius_m", ".4f", loaded_radius_m)));
  return {"Test data", {form}};
}

ReportTable make_iso_cycles(const ReportValues& values) {
  ReportTable table{
      "Every cycle", {"", "load, N", "speed, km/h", "skim, N", "F_r, N", "RRc, N/kN", "liner, °C"}, {}, 0};
  for (std::size_t i = 0; i < values.json()["result"]["cycles"].size(); ++i) {
    const std::string cycle = fmt::format("/result/cycles/{}", i);
    table.rows.push_back({{std::to_string(i + 1)},
                          values.number(cycle + "/load_N", ".0f"),
                          values.number(cycle + "/speed_km_h", ".1f"),
                          values.number(cycle + "/parasitic_N", ".2f"),
                          values.number(cycle + "/rolling_resistance_N", ".2f"),
                          values.number(cycle + "/rrc_N_per_kN", ".3f"),
                          values.number(cycle + "/liner_temperature_degC", ".1f")});
  }
  return table;
}

/// F_r by each method that the run allows; nothing where there is one alone.
std::optional<ReportTable> make_iso_methods(const ReportValues& values) {
  const std::size_t methods = values.has("/result/methods") ? values.json()["result"]["methods"].size() : 0;
  if (methods < 2) return std::nullopt;
  ReportTable table{"Methods of the standard",
                    {"method", "skim, N", "F_r, N", "RRc, N/kN", "at 25 °C and 2 m, N/kN", "differs, %"},
                    {},
                    0};
  for (std::size_t i = 0; i < methods; ++i) {
    const std::string method = fmt::format("/result/methods/{}", i);
    table.rows.push_back({values.value(method + "/name"), values.number(method + "/parasitic_N", ".2f"),
                          values.number(method + "/rolling_resistance_N", ".2f"),
                          values.number(method + "/rrc_N_per_kN", ".3f"),
                          values.number(method + "/rrc_25degC_2m_N_per_kN", ".3f"),
                          values.number(method + "/difference_percent", "+.2f")});
  }
  return table;
}

ReportSection make_iso_results(const RunSpec& spec, const ReportValues& values) {
  const double coefficient_per_K = scenarios::find_ambient_coefficient_per_K(spec);
  const std::size_t cycles = values.has("/result/cycles") ? values.json()["result"]["cycles"].size() : 0;
  ReportForm form{{make_field("Number of measurements", std::to_string(std::max<std::size_t>(1, cycles))),
                   values.field("Method of the standard", "/result/method"),
                   values.field("Parasitic loss, by the skim test", "/result/parasitic_N", ".2f"),
                   values.field("Rolling resistance", "/result/rolling_resistance_N", ".2f"),
                   values.field("Coefficient as measured", "/result/rrc_N_per_kN", ".3f"),
                   values.field("Coefficient at 25 °C and on the 2 m drum", "/result/rrc_25degC_2m_N_per_kN", ".3f"),
                   make_field("  temperature coefficient K_t", fmt::format("{:.4g} 1/°C", coefficient_per_K))}};
  if (cycles > 1) {
    form.fields.push_back(
        values.field("Mean of the cycles after the first", "/result/rrc_cycles_mean_N_per_kN", ".3f"));
    if (values.has("/result/rrc_cycles_sd_N_per_kN")) {
      form.fields.push_back(values.field("  their standard deviation", "/result/rrc_cycles_sd_N_per_kN", ".3f"));
    }
  }
  if (values.has("/uncertainty")) {
    form.fields.push_back({"Expanded uncertainty (95 %) at 25 °C and on the 2 m drum",
                           {values.number("/uncertainty/budgets/0/expanded_uncertainty", ".3f")},
                           "N/kN, by the budget below"});
  }
  if (values.has("/result/rrc_uncertainty_N_per_kN")) {
    form.fields.push_back(values.field("  from noise and drift of torque or force alone (k = 2)",
                                       "/result/rrc_uncertainty_N_per_kN", ".3f"));
  }
  form.fields.push_back(make_blank("Alignment equation of the laboratory"));
  form.fields.push_back(make_blank("Aligned coefficient, N/kN"));
  if (values.has("/result/label_class")) {
    form.fields.push_back(values.field("EU label class of this value, not aligned", "/result/label_class"));
    form.fields.push_back(values.field("  probability of this class", "/result/label_probability", ".3f"));
  }
  ReportSection section{"Results", {form}};
  if (const auto methods = make_iso_methods(values)) section.parts.push_back(*methods);
  if (cycles > 1) section.parts.push_back(make_iso_cycles(values));
  return section;
}

}  // namespace

TestReport make_iso_28580_report(const RunSpec& spec, const scenarios::Outcome& outcome, const ReportValues& values) {
  TestReport report;
  report.title = "Test report: rolling resistance of a tire, ISO 28580";
  report.standard =
      "Fields by UN Regulation No. 117, Annex 6, as Regulation (EU) 2017/2400, Annex X, Appendix 2, section II repeats "
      "them.";
  report.subject = fmt::format("Tire {} ({})", spec.tire.name, spec.tire.designation);
  report.sections = {make_iso_laboratory(), make_iso_machine(spec, values), make_iso_tire(spec),
                     make_iso_conditions(spec, outcome, values), make_iso_results(spec, values)};
  return report;
}

}  // namespace rollrig::report
