#include "cli/run_options.h"

#include <filesystem>

namespace fs = std::filesystem;

namespace rollrig::cli {
namespace {

bool is_file_name(const std::string& text) {
  return text.find('/') != std::string::npos || fs::path(text).extension() == ".toml";
}

/// A path given on the command line is relative to the working folder, whatever the run file's folder.
std::string absolute_if_path(const std::string& name) {
  return is_file_name(name) ? fs::absolute(name).string() : name;
}

void require_scenario(const std::string& name) {
  if (scenarios::find_scenario_if_any(name) != nullptr) return;
  InputProblem problem = unknown_name("scenario", name, scenarios::scenario_names());
  problem.file = "command line";
  problem.key = "scenario";
  problem.allowed += "; or a run file (.toml)";
  throw InputError(problem);
}

void set_text(ConfigTable& document, const std::string& key, const std::string& value) {
  if (!value.empty()) document.entries[key] = ConfigValue{value, {"command line", 0}, value};
}

}  // namespace

void RunOptions::add_to(CLI::App& command) {
  command.add_option("scenario", scenario_or_file, "Scenario name, or a run file (.toml)")->required();
  command.add_option("--tire", tire, "Name under assets/tires, or a path");
  command.add_option("--rig", rig, "Name under assets/rigs, or a path [the scenario's]");
  command.add_option("--vehicle", vehicle, "Name under assets/vehicles, or a path [source_car]");
  command.add_option("--fidelity", fidelity, "multibody or quasi_static [multibody]");
  command.add_option("--baseline", baseline, "combined or constant_rrc [combined]");
  command.add_option("--sensors", sensors, "Virtual sensors: a name under assets/sensors, a path, or none");
  command.add_option("--seed", seed, "Seed of the sensors' random numbers [1]");
  command
      .add_option("--set", assignments,
                  "key=value: a setting of the scenario, or tire.<table>.<key>, rig.<table>.<key>, "
                  "vehicle.<table>.<key>, effects.<id>.<parameter>; may be repeated")
      ->expected(1)
      ->take_all();
}

ConfigTable RunOptions::make_document() const {
  if (!is_file_name(scenario_or_file)) require_scenario(scenario_or_file);  // before what such a run would need
  ConfigTable document =
      is_file_name(scenario_or_file) ? read_config(scenario_or_file) : scenarios::make_run_document(scenario_or_file);
  set_text(document, "tire", absolute_if_path(tire));
  set_text(document, "rig", absolute_if_path(rig));
  set_text(document, "vehicle", absolute_if_path(vehicle));
  set_text(document, "fidelity", fidelity);
  set_text(document, "baseline", baseline);
  set_text(document, "sensors", absolute_if_path(sensors));
  if (!seed.empty()) set_config_value(document, "seed", seed, "--seed");
  for (const std::string& assignment : assignments) scenarios::set_run_value(document, assignment);
  if (document.find("tire") == nullptr) {
    throw InputError(
        {"no tire is given", "command line", 0, "--tire", "", "--tire <name or path>; see rollrig list", ""});
  }
  return document;
}

std::string RunOptions::base_folder() const {
  return is_file_name(scenario_or_file) ? fs::path(scenario_or_file).parent_path().string() : std::string();
}

}  // namespace rollrig::cli
