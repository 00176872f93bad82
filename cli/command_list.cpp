#include <fmt/format.h>

#include <iostream>

#include "cli/command.h"
#include "cli/output_files.h"
#include "rollrig/assets.h"
#include "sim/core/text.h"

namespace rollrig::cli {
namespace {

Json list_everything() {
  Json json;
  const auto add = [&json](const char* kind, const std::vector<Listed>& all) {
    json[kind] = Json::array();
    for (const Listed& one : all) json[kind].push_back({{"name", one.name}, {"summary", one.summary}});
  };
  add("scenarios", list_scenarios());
  add("effects", list_effects());
  for (const std::string& folder : asset_folders()) json[folder] = list_assets(folder);
  return json;
}

int list_command(const std::string& json_file) {
  const Json all = list_everything();
  if (!json_file.empty()) write_output(json_file, to_text(all));
  if (json_file == "-") return kDone;
  for (const char* kind : {"scenarios", "effects"}) {
    std::cout << kind << '\n';
    for (const Json& item : all[kind]) {
      std::cout << "  " << item["name"].get<std::string>() << '\n' << wrap(item["summary"].get<std::string>(), 6);
    }
  }
  for (const std::string& kind : asset_folders()) {
    std::cout << kind << '\n' << wrap(fmt::format("{}", fmt::join(all[kind].get<std::vector<std::string>>(), "  ")), 2);
  }
  return kDone;
}

int describe_command(const std::string& name) {
  std::cout << describe(name);
  return kDone;
}

}  // namespace

void add_list_command(CLI::App& app, Action& action) {
  const auto [command, json] = add_command<std::string>(
      app, action, "list", "List scenarios, effects, tires, rigs, vehicles, cycles, sensors", &list_command);
  command->add_option("--json", *json, "File for the list, - for standard output");
}

void add_describe_command(CLI::App& app, Action& action) {
  const auto [command, name] = add_command<std::string>(
      app, action, "describe", "Explain a scenario, an effect, a tire, a rig, a vehicle or sensors", &describe_command);
  command->add_option("name", *name, "Scenario, effect or asset")->required();
}

}  // namespace rollrig::cli
