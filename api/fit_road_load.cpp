#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "api/add_uncertainty.h"
#include "api/report_files.h"
#include "api/road_load_options.h"
#include "estimation/road_load/checked_road_load.h"
#include "estimation/road_load/road_load_report.h"
#include "estimation/road_load/road_load_uncertainty.h"
#include "report/fit_pages.h"
#include "rollrig/fit.h"
#include "sim/core/file_io.h"
#include "sim/core/text.h"

namespace rollrig {
namespace {

using estimation::CoastdownFile;
using estimation::RoadLoadChecks;
using estimation::RoadLoadFit;

std::string format_road_load(const std::string& path, const CoastdownFile& file, const RoadLoadFitOptions& options,
                             const RoadLoadFit& fit, const RoadLoadChecks& checks) {
  return wrap(
             fmt::format("fit road-load   {} ({})   {}, {}", path, file.is_trace ? "speed trace" : "times through bins",
                         format_count(file.data.runs.size(), "run"), format_count(fit.points.size(), "speed bin")),
             0) +
         format_tables(report::make_road_load_tables(options, fit, checks)) + format_warnings(fit.warnings);
}

/// Keeps the runs of the sessions that were asked for.
void select_sessions(const std::vector<std::string>& wanted, CoastdownFile& file) {
  if (wanted.empty()) return;
  std::vector<std::string> known;
  for (const estimation::CoastdownRun& run : file.data.runs) {
    if (std::find(known.begin(), known.end(), run.session) == known.end()) known.push_back(run.session);
  }
  for (const std::string& session : wanted) {
    if (std::find(known.begin(), known.end(), session) != known.end()) continue;
    InputProblem problem = unknown_name("session", session, known);
    problem.file = "command line";
    problem.key = "--session";
    throw InputError(problem);
  }
  auto& runs = file.data.runs;
  const auto unwanted = [&wanted](const estimation::CoastdownRun& run) {
    return std::find(wanted.begin(), wanted.end(), run.session) == wanted.end();
  };
  runs.erase(std::remove_if(runs.begin(), runs.end(), unwanted), runs.end());
}

bool is_run(const estimation::CoastdownRun& run, const std::string& name) {
  return run.id == name || run.session + "/" + run.id == name;
}

/// Takes out the runs that are not wanted.
void leave_out_runs(const std::vector<std::string>& unwanted, CoastdownFile& file) {
  auto& runs = file.data.runs;
  for (const std::string& name : unwanted) {
    const auto is_it = [&name](const estimation::CoastdownRun& run) { return is_run(run, name); };
    const auto first = std::remove_if(runs.begin(), runs.end(), is_it);
    if (first == runs.end()) {
      std::vector<std::string> known;
      for (const estimation::CoastdownRun& run : runs) known.push_back(run.id);
      InputProblem problem = unknown_name("run", name, known);
      problem.file = "command line";
      problem.key = "--leave-out";
      throw InputError(problem);
    }
    runs.erase(first, runs.end());
  }
}

/// The vehicle of a recording, where it is asked for.
RoadLoadFitOptions complete_options(const CoastdownFile& file, RoadLoadFitOptions options) {
  if (!options.recorded_vehicle) return options;
  if (!file.vehicle.has_value()) {
    throw InputError({"the mass is missing: a coastdown alone gives force per mass", "command line", 0, "--mass", "",
                      "--mass <kg>, the mass as tested; or --per-mass for A, B and C per unit of effective mass", ""});
  }
  options.mass_kg = file.vehicle->mass_kg;
  options.rotating_mass_kg = file.vehicle->rotating_mass_kg;
  if (!options.drag_area_m2.has_value()) options.drag_area_m2 = file.vehicle->drag_area_m2;
  return options;
}

/// The fit, its InputErrors with the file's name.
RoadLoadFit fit_file(const std::string& path, CoastdownFile& file, const RoadLoadFitOptions& options) {
  try {
    return estimation::fit_checked_road_load(file, options);
  } catch (const InputError& error) {
    InputProblem problem = error.problem();
    if (problem.file.empty()) problem.file = path;
    throw InputError(problem);
  }
}

std::string find_coastdown_role(const std::string& path) {
  return std::filesystem::path(path).extension() == ".csv" ? "coastdowns" : "other file";
}

}  // namespace

RoadLoad fit_road_load(const std::string& path, const RoadLoadFitOptions& given,
                       const std::vector<std::string>& sessions, BadRows bad_rows,
                       const UncertaintyOptions& uncertainty, const Progress& progress) {
  require_valid(given);
  check_uncertainty(uncertainty);
  const ReadRecorder recorder;
  const auto file = std::make_shared<CoastdownFile>(estimation::read_coastdowns(path, bad_rows));
  const RoadLoadFitOptions options = complete_options(*file, given);
  select_sessions(sessions, *file);
  leave_out_runs(options.leave_out, *file);
  const auto fit = std::make_shared<RoadLoadFit>(fit_file(path, *file, options));
  for (std::string& doubt : estimation::doubt_vehicle(*file, given.mass_kg, given.drag_area_m2)) {
    fit->warnings.push_back(std::move(doubt));
  }
  for (std::string& warning : estimation::list_reading_warnings(*file)) fit->warnings.push_back(std::move(warning));
  const RoadLoadChecks checks = estimation::check_road_load(file->data, *fit);
  RoadLoad result;
  result.coefficients = estimation::list_coefficients(*fit);
  result.warnings = fit->warnings;
  result.text = format_road_load(path, *file, options, *fit, checks);
  Json json = estimation::make_road_load_json(*file, options, *fit, checks);
  std::vector<Table> budgets;
  if (wants_uncertainty(uncertainty)) {
    budgets = add_uncertainty(estimation::make_road_load_model(file->data, options, *fit), uncertainty, progress, json);
    result.text += format_tables(budgets);
  }
  result.json = to_text(json);
  result.make_files = [file, fit, json = result.json] {
    return FolderFiles{{"road_load.json", json}, {"residuals.csv", estimation::write_road_load_residuals(*file, *fit)}};
  };
  result.make_page = [file, options, fit, checks, budgets] {
    return make_page_with_uncertainty(report::make_road_load_page(*file, options, *fit, checks), budgets);
  };
  result.make_test_report = [file, json = std::move(json), files = list_report_files(recorder, &find_coastdown_role)] {
    return report::make_report_html(report::make_road_load_report(*file, json, files), report::find_report_date());
  };
  return result;
}

}  // namespace rollrig
