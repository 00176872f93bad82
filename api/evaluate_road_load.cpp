#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "api/add_uncertainty.h"
#include "api/report_files.h"
#include "api/road_load_options.h"
#include "estimation/road_load/checked_road_load.h"
#include "estimation/road_load/coastdown_units.h"
#include "estimation/road_load/default_road_load.h"
#include "estimation/road_load/procedure_uncertainty.h"
#include "estimation/road_load/road_load_procedure.h"
#include "estimation/road_load/road_load_report.h"
#include "report/blocks.h"
#include "report/road_load_procedure_page.h"
#include "rollrig/road_load.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig {
namespace {

using estimation::CoastdownFile;
using estimation::RoadLoadProcedure;

/// Runs of the wanted sessions without those that are left out.
void select_coastdowns(const std::vector<std::string>& sessions, const std::vector<std::string>& leave_out,
                       CoastdownFile& file) {
  auto& runs = file.data.runs;
  for (const std::string& session : sessions) {
    const bool known = std::any_of(runs.begin(), runs.end(), [&](const auto& run) { return run.session == session; });
    if (known) continue;
    std::vector<std::string> names;
    for (const auto& run : runs) names.push_back(run.session);
    InputProblem problem = unknown_name("session", session, names);
    problem.file = "command line";
    problem.key = "--session";
    throw InputError(problem);
  }
  for (const std::string& name : leave_out) {
    const auto is_it = [&name](const auto& run) { return name == run.id || name == run.session + "/" + run.id; };
    if (std::any_of(runs.begin(), runs.end(), is_it)) continue;
    std::vector<std::string> names;
    for (const auto& run : runs) names.push_back(run.id);
    InputProblem problem = unknown_name("run", name, names);
    problem.file = "command line";
    problem.key = "--leave-out";
    throw InputError(problem);
  }
  const auto is_out = [&](const auto& run) {
    const bool other = !sessions.empty() && std::find(sessions.begin(), sessions.end(), run.session) == sessions.end();
    return other || std::any_of(leave_out.begin(), leave_out.end(), [&run](const std::string& name) {
             return name == run.id || name == run.session + "/" + run.id;
           });
  };
  runs.erase(std::remove_if(runs.begin(), runs.end(), is_out), runs.end());
}

/// What speaks against runs: the same recording twice, labels, odd runs.
std::vector<estimation::RunDoubt> doubt_runs(const RoadLoadProcedureOptions& options, CoastdownFile& file) {
  RoadLoadFitOptions how;
  how.mass_kg = options.mass_kg;
  how.rotating_mass_kg = options.rotating_mass_kg;
  how.speed_from_m_s = options.speed_from_m_s;
  how.speed_to_m_s = options.speed_to_m_s;
  return estimation::check_coastdowns(file.data, how).doubts;
}

struct RunName {
  std::string session, id, shown;
};

std::vector<RunName> list_run_names(const estimation::CoastdownData& data) {
  std::vector<RunName> names;
  for (const estimation::CoastdownRun& run : data.runs) {
    names.push_back({run.session, run.id, estimation::name_of_run(run, data)});
  }
  return names;
}

/// Runs that are not in the data any more.
std::vector<std::string> list_dropped(const std::vector<RunName>& runs, const estimation::CoastdownData& data) {
  std::vector<std::string> dropped;
  for (const RunName& run : runs) {
    const auto is_it = [&run](const auto& other) { return other.session == run.session && other.id == run.id; };
    if (std::none_of(data.runs.begin(), data.runs.end(), is_it)) dropped.push_back(run.shown);
  }
  return dropped;
}

/// Evaluates what copies have left. An error about headings and pairs says which runs were dropped as copies.
RoadLoadProcedure evaluate_checked(const CoastdownFile& file, const RoadLoadProcedureOptions& options,
                                   const std::vector<std::string>& copies) {
  try {
    return options.kind == RoadLoadProcedureKind::kWltp ? estimation::evaluate_wltp_coastdowns(file, options)
                                                        : estimation::evaluate_traces(file, options);
  } catch (const InputError& error) {
    InputProblem problem = error.problem();
    if (copies.empty() || problem.key != "heading") throw;
    problem.what += fmt::format(". Dropped, since each is a copy of another run: {}", fmt::join(copies, ", "));
    throw InputError(problem);
  }
}

std::string find_recording_role(const std::string& path) {
  return std::filesystem::path(path).extension() == ".csv" ? "recording" : "other file";
}

RoadLoadProcedure evaluate_coastdowns(const std::string& path, RoadLoadProcedureOptions options,
                                      const std::vector<std::string>& sessions, BadRows bad_rows) {
  CoastdownFile file = estimation::read_coastdowns(path, bad_rows);
  select_coastdowns(sessions, options.leave_out, file);
  if (file.data.runs.empty()) {
    throw InputError({"all runs are left out", "command line", 0, "--leave-out", "", "runs that stay", ""});
  }
  const std::optional<double> given_mass_kg = options.mass_kg;
  if (!options.mass_kg.has_value() && file.vehicle.has_value()) {
    options.mass_kg = file.vehicle->mass_kg;
    options.rotating_mass_kg = file.vehicle->rotating_mass_kg;
  }
  const std::vector<RunName> runs = list_run_names(file.data);
  std::vector<estimation::RunDoubt> doubts = doubt_runs(options, file);
  RoadLoadProcedure procedure = evaluate_checked(file, options, list_dropped(runs, file.data));
  procedure.is_simulated = file.is_simulated;
  std::vector<std::string> texts = estimation::doubt_vehicle(file, given_mass_kg, std::nullopt);
  for (const estimation::RunDoubt& doubt : doubts) texts.push_back(doubt.text);
  procedure.warnings.insert(procedure.warnings.begin(), texts.begin(), texts.end());
  estimation::put_speed_unit_doubt(file.data, procedure.warnings);
  procedure.doubts = std::move(doubts);
  for (std::string& warning : estimation::list_reading_warnings(file)) procedure.warnings.push_back(std::move(warning));
  return procedure;
}

}  // namespace

RoadLoad evaluate_road_load(const std::string& file, const RoadLoadProcedureOptions& options,
                            const std::vector<std::string>& sessions, BadRows bad_rows,
                            const UncertaintyOptions& uncertainty, const Progress& progress) {
  require_valid(options);
  check_uncertainty(uncertainty);
  const ReadRecorder recorder;
  const auto procedure = std::make_shared<RoadLoadProcedure>();
  try {
    *procedure = options.kind == RoadLoadProcedureKind::kTorqueMeter
                     ? estimation::evaluate_torque_meter(file, options, sessions, bad_rows)
                     : evaluate_coastdowns(file, options, sessions, bad_rows);
  } catch (const InputError& error) {
    InputProblem problem = error.problem();
    if (problem.file.empty()) problem.file = file;
    throw InputError(problem);
  }
  RoadLoad result;
  result.coefficients = report::list_procedure_coefficients(*procedure);
  result.warnings = procedure->warnings;
  const std::string source = fmt::format("{}, {}", file, format_count(procedure->run_names.size(), "run"));
  result.text = wrap(fmt::format("fit road-load   {}   {}", source, report::title_of(procedure->kind)), 0) +
                format_tables(report::make_procedure_tables(*procedure)) + format_warnings(procedure->warnings);
  Json json = report::make_procedure_json(*procedure);
  std::vector<Table> budgets;
  if (wants_uncertainty(uncertainty)) {
    budgets = add_uncertainty(estimation::make_procedure_model(*procedure), uncertainty, progress, json);
    result.text += format_tables(budgets);
  }
  result.json = to_text(json);
  result.make_files = [procedure, json = result.json] {
    return FolderFiles{{"road_load.json", json}, {"points.csv", report::write_procedure_points(*procedure)}};
  };
  const std::string subtitle =
      fmt::format("{}, {}", last_part(file, '/'), format_count(procedure->run_names.size(), "run"));
  result.make_page = [procedure, subtitle, budgets] {
    return make_page_with_uncertainty(report::make_procedure_page(*procedure, subtitle), budgets);
  };
  result.make_test_report = [procedure, file, json = std::move(json),
                             files = list_report_files(recorder, &find_recording_role)] {
    return report::make_report_html(report::make_procedure_report(*procedure, file, json, files),
                                    report::find_report_date());
  };
  return result;
}

namespace {

/// Of a default road load, which is for M1 and N1: what is said of any, and what does not fit the mass.
std::vector<std::string> list_default_warnings(const DefaultRoadLoadOptions& options) {
  constexpr double kMost_kg = 4250.0;        // N1 with an alternative fuel; 3500 otherwise
  constexpr double kLeastOfTruck_kg = 3500.0;  // N2 and M3 begin there
  std::vector<std::string> warnings{
      "a default road load is no measurement: it is meant to be above that of most vehicles of such a size"};
  if (options.mass_kg > kMost_kg) {
    warnings.push_back(fmt::format(
        "a test mass of {:g} kg: the WLTP and its default road load are for vehicles up to 3500 kg (M1, N1)",
        options.mass_kg));
  }
  if (options.tire_class == "C3" && options.mass_kg < kLeastOfTruck_kg) {
    warnings.push_back(fmt::format(
        "tires of class C3 are those of trucks and buses: are they on a vehicle of {:g} kg?", options.mass_kg));
  }
  return warnings;
}

}  // namespace

RoadLoad calc_default_road_load(const DefaultRoadLoadOptions& options) {
  require_valid(options);
  const Eigen::Vector3d load = estimation::calc_default_road_load(options.mass_kg, options.width_m, options.height_m);
  constexpr const char* kKeys[] = {"f0_N", "f1_N_per_km_h", "f2_N_per_km_h2"};
  constexpr const char* kUnits[] = {"N", "N/(km/h)", "N/(km/h)2"};
  RoadLoad result;
  Json json = {{"format", "rollrig-default-road-load/1"},
               {"mass_kg", options.mass_kg},
               {"width_m", options.width_m},
               {"height_m", options.height_m}};
  Table table{"Default road load of the WLTP", {"", "value", "unit", "lbf, mph"}, {}};
  for (int i = 0; i < 3; ++i) {
    const double value = estimation::road_load_in_file_unit(i, load(i));
    const double lbf = estimation::road_load_in_lbf_mph(i, load(i));
    result.coefficients.push_back({kKeys[i], value, 0.0, value, value, kUnits[i]});
    json[kKeys[i]] = value;
    json["lbf_mph"][estimation::road_load_lbf_key(i)] = lbf;
    table.rows.push_back({fmt::format("f{}", i), fmt::format("{:.5g}", value), kUnits[i], fmt::format("{:.5g}", lbf)});
  }
  Table rolling;
  result.warnings = list_default_warnings(options);
  if (!options.tire_class.empty()) {
    const estimation::RrcClass& at = estimation::find_rrc_class(options.tire_class, options.rrc_N_per_kN);
    const double force_N = 1e-3 * at.value_N_per_kN * kStandardGravity_m_s2 * options.mass_kg;
    rolling.rows.push_back({"former label class (EC 1222/2009), " + options.tire_class, std::string(1, at.label)});
    rolling.rows.push_back({"its value", fmt::format("{:.1f} N/kN", at.value_N_per_kN)});
    rolling.rows.push_back({"rolling resistance by that value", fmt::format("{:.1f} N", force_N)});
    json["rolling_resistance"] = {{"tire_class", options.tire_class},
                                  {"class", std::string(1, at.label)},
                                  {"class_value_N_per_kN", at.value_N_per_kN},
                                  {"force_N", force_N}};
  }
  json["warnings"] = result.warnings;
  std::vector<Table> tables{table};
  if (!rolling.rows.empty()) tables.push_back(rolling);
  result.make_page = [tables, warnings = result.warnings, json] {
    report::Page page{"fit default-road-load", "Default road load of the WLTP", "without a measurement"};
    page.add(report::make_section("Result", tables, warnings));
    page.add(report::make_document(json, "The result as JSON"));
    return report::make_html(page);
  };
  result.text = format_tables(tables) + format_warnings(result.warnings);
  result.json = to_text(json);
  result.make_files = [json = result.json] { return FolderFiles{{"road_load.json", json}}; };
  return result;
}

}  // namespace rollrig
