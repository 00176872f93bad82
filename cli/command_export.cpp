#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <utility>
#include <vector>

#include "cli/coefficient_outputs.h"
#include "cli/command.h"
#include "cli/output_files.h"
#include "rollrig/export.h"
#include "rollrig/fmu.h"
#include "rollrig/rolling_law.h"
#include "rollrig/vecto.h"
#include "sim/core/columns.h"

namespace rollrig::cli {
namespace {

struct ExportOptions {
  std::string source;
  std::string mat;
  std::string hdf5;
  CoefficientOutputs coefficients;
  std::string vecto;
  VectoTireInput tire;
  BadRows bad_rows = BadRows::kRefuse;
  bool quiet = false;
};

/// The source is a tire, for VECTO.
int export_tire(const ExportOptions& options) {
  if (!options.mat.empty() || !options.hdf5.empty() || !options.coefficients.are_empty()) {
    throw usage_error("a tire for VECTO is written alone", "--vecto", options.vecto,
                      "--vecto without --mat, --hdf5 and others, whose source is a result, a set or a fit");
  }
  const OutputFiles files({{"--vecto", options.vecto}});
  VectoTireInput input = options.tire;
  input.tire = options.source;
  const VectoTireFile made = make_vecto_tire(input);
  files.require_no_input();
  std::vector<StagedOutput> staged;
  staged.emplace_back(options.vecto, made.xml);
  commit_all(staged);
  if (options.quiet || options.vecto == "-") return kDone;
  std::cout << format_warnings(made.warnings);
  std::cout << fmt::format("RRCDeclared {:.4f}, FzISO {} N, written to {}\n", made.rrc, made.load_N, options.vecto);
  return kDone;
}

/// Paths and contents of the files, all made before one is written.
std::vector<std::pair<std::string, std::string>> make_exports(const ExportOptions& options, std::string& warnings) {
  std::vector<std::pair<std::string, std::string>> files = options.coefficients.make(options.source);
  if (!options.coefficients.are_empty()) warnings = format_warnings(list_fit_warnings(options.source));
  if (options.mat.empty() && options.hdf5.empty()) return files;
  const Export made = read_export(options.source, options.bad_rows);
  warnings += format_warnings(made.warnings);
  if (!options.mat.empty()) files.emplace_back(options.mat, made.make_mat());
  if (!options.hdf5.empty()) files.emplace_back(options.hdf5, made.make_hdf5());
  return files;
}

int export_command(const ExportOptions& options) {
  if (options.source.empty()) {
    throw usage_error("no source is given", "", "", "a folder, a set, a recording, a fit or a tire; or export fmu");
  }
  if (!options.vecto.empty()) return export_tire(options);
  if (options.mat.empty() && options.hdf5.empty() && options.coefficients.are_empty()) {
    throw usage_error("no file to write is given", "", "",
                      "--mat FILE, --hdf5 FILE, or both; of a fit of J2452 --tydex, --tir, --simscape, --fastsim, "
                      "--co2mpas; of a tire --vecto");
  }
  std::vector<OutputFile> outputs = options.coefficients.list_files();
  outputs.insert(outputs.begin(), {{"--mat", options.mat}, {"--hdf5", options.hdf5}});
  const OutputFiles output_files(outputs);
  std::string warnings;
  const auto files = make_exports(options, warnings);
  output_files.require_no_input();
  std::vector<StagedOutput> staged;
  for (const auto& [path, content] : files) staged.emplace_back(path, content);
  commit_all(staged);
  const bool is_taken = std::any_of(files.begin(), files.end(), [](const auto& file) { return file.first == "-"; });
  if (options.quiet || is_taken) return kDone;
  std::cout << warnings;
  for (const auto& file : files) std::cout << fmt::format("written to {}\n", file.first);
  return kDone;
}

struct FmuOptions {
  FmuInput input;
  std::string out;
  bool quiet = false;
};

/// What make_fmu() refuses by the name of its member is refused by the name of the option.
std::string make_fmu_of_options(const FmuInput& input) {
  try {
    return make_fmu(input);
  } catch (const InputError& error) {
    const InputProblem& problem = error.problem();
    if (problem.key != "fmi_version" && problem.key != "effects") throw;
    throw usage_error(problem.what, problem.key == "effects" ? "--effects" : "--fmi", problem.value, problem.allowed);
  }
}

int export_fmu_command(const FmuOptions& options) {
  const OutputFiles files({{"--out", options.out}});
  const std::string fmu = make_fmu_of_options(options.input);
  files.require_no_input();
  std::vector<StagedOutput> staged;
  staged.emplace_back(options.out, fmu);
  commit_all(staged);
  if (!options.quiet && options.out != "-") std::cout << fmt::format("written to {}\n", options.out);
  return kDone;
}

void add_export_fmu(CLI::App& parent, Action& action) {
  const auto [command, options] = add_command<FmuOptions>(
      parent, action, "fmu", "Write a warm tire on its wheel for other simulators (FMI)", &export_fmu_command);
  command->add_option("--tire", options->input.tire, "Tire under assets/tires, or a path")->required();
  command->add_option("--rig", options->input.rig, "What it rolls on: rig under assets/rigs, or a path")
      ->capture_default_str();
  split_names(
      command->add_option("--effects", options->input.effects, "Effects that are on; their sizes are parameters"));
  command->add_option("--fmi", options->input.fmi_version, "Version of FMI, 2 or 3")
      ->capture_default_str()
      ->transform([](const std::string& version) { return version.substr(0, version.find(".0")); });
  add_output_option(*command, "--out", options->out, "File for the FMU, - for standard output")->required();
  command->add_flag("--quiet", options->quiet, "Print nothing but errors");
}

}  // namespace

void add_export_command(CLI::App& app, Action& action) {
  const auto [command, options] = add_command<ExportOptions>(
      app, action, "export",
      "Write a result, a measurement set or a recording for MATLAB (.mat) or as HDF5, a fit's coefficients, or a tire "
      "for VECTO",
      &export_command);
  add_export_fmu(*command, action);
  const Action write_source = [options = options] { return export_command(*options); };
  command->callback([command = command, write_source, &action] {
    if (command->get_subcommands().empty()) action = write_source;
  });
  command->add_option(
      "source", options->source,
      "Folder that run --out or --write-set wrote, a measurement set, a recording.csv, or fit.json of fit "
      "j2452; of --vecto a tire: name under assets/tires, or a path");
  add_output_option(*command, "--mat", options->mat, "File for MATLAB, version 5; - for standard output");
  add_output_option(*command, "--hdf5", options->hdf5, "File in HDF5; - for standard output");
  options->coefficients.add_to(*command);
  add_output_option(*command, "--vecto", options->vecto, "File for VECTO, the tire as XML; - for standard output");
  VectoTireInput& tire = options->tire;
  const auto add_vecto = [command = command](const char* option, auto& member, const char* doc) {
    command->add_option(option, member, doc)->needs("--vecto");
  };
  add_vecto("--rrc", tire.rrc_N_per_kN, "RRc to declare in N/kN [of the simulated test of ISO 28580]");
  add_vecto("--manufacturer", tire.manufacturer, "Manufacturer of the tire [simulated]");
  add_vecto("--model", tire.model, "Model of the tire [its name]");
  add_vecto("--certification-number", tire.certification_number, "Certification number [simulated, not certified]");
  add_vecto("--date", tire.date, "Date and time in UTC [2017-01-01T00:00:00Z]");
  add_vecto("--dimension", tire.dimension, "Size as VECTO writes it [designation of the tire]");
  add_skip_bad_rows(*command, options->bad_rows);
  command->add_flag("--quiet", options->quiet, "Print nothing but errors");
}

}  // namespace rollrig::cli
