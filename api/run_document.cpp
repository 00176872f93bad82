#include <filesystem>

#include "api/data.h"

namespace fs = std::filesystem;

namespace rollrig {

bool is_file_name(const std::string& text) {
  return text.find('/') != std::string::npos || fs::path(text).extension() == ".toml";
}

std::string absolute_if_path(const std::string& name) {
  return is_file_name(name) ? fs::absolute(name).string() : name;
}

namespace {

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

/// The run document: the file's, or an empty one for a scenario, with the rest put in.
ConfigTable make_document(const RunInput& input, bool is_file) {
  if (!is_file) require_scenario(input.scenario_or_file);  // before what such a run would need
  ConfigTable document =
      is_file ? read_config(input.scenario_or_file) : scenarios::make_run_document(input.scenario_or_file);
  set_text(document, "tire", absolute_if_path(input.tire));
  set_text(document, "rig", absolute_if_path(input.rig));
  set_text(document, "vehicle", absolute_if_path(input.vehicle));
  set_text(document, "fidelity", input.fidelity);
  set_text(document, "baseline", input.baseline);
  set_text(document, "sensors", absolute_if_path(input.sensors));
  if (!input.seed.empty()) set_config_value(document, "seed", input.seed, "--seed");
  for (const std::string& assignment : input.settings) scenarios::set_run_value(document, assignment);
  if (document.find("tire") == nullptr) {
    throw InputError(
        {"no tire is given", "command line", 0, "--tire", "", "--tire <name or path>; see rollrig list", ""});
  }
  return document;
}

}  // namespace

scenarios::RunSpec read_run(const RunInput& input) {
  const bool is_file = is_file_name(input.scenario_or_file);
  return scenarios::read_run_spec(make_document(input, is_file),
                                  is_file ? fs::path(input.scenario_or_file).parent_path().string() : std::string());
}

}  // namespace rollrig
