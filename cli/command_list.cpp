#include <fmt/format.h>

#include <algorithm>
#include <iostream>

#include "cli/command.h"
#include "cli/output_files.h"
#include "rollrig/assets.h"
#include "sim/core/columns.h"
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

/// Throws InputError where there are no assets of any kind, as where ROLLRIG_ASSETS names another folder.
void require_assets(const Json& all) {
  const auto has_some = [&all](const std::string& folder) { return !all.at(folder).empty(); };
  if (std::any_of(asset_folders().begin(), asset_folders().end(), has_some)) return;
  const std::string folder = find_assets_folder();
  throw InputError({fmt::format("there are no assets in '{}'", folder), folder, 0, "", "",
                    "a folder that has tires/*.toml, rigs/*.toml and so on. The variable ROLLRIG_ASSETS names it; "
                    "where the variable is not set, rollrig looks beside the program",
                    ""});
}

struct ListOptions {
  std::string kind;  // all where empty
  std::string json;
};

int list_command(const ListOptions& options) {
  Json all = list_everything();
  if (!options.kind.empty()) {
    if (!all.contains(options.kind)) throw InputError(unknown_name("kind to list", options.kind, list_kinds()));
    if (options.kind != "scenarios" && options.kind != "effects") require_assets(all);
    all = Json{{options.kind, all[options.kind]}};
  }
  if (options.kind.empty()) require_assets(all);
  if (!options.json.empty()) write_output(options.json, to_text(all));
  if (options.json == "-") return kDone;
  for (const auto& [kind, items] : all.items()) {
    std::cout << kind << '\n';
    if (items.empty() || items.front().is_string()) {
      std::cout << wrap(fmt::format("{}", fmt::join(items.get<std::vector<std::string>>(), " ")), 2,
                        terminal_columns());
      continue;
    }
    std::vector<std::vector<std::string>> rows;
    for (const Json& item : items) rows.push_back({item["name"], item["summary"]});
    std::cout << text_columns(rows);
  }
  return kDone;
}

int describe_command(const std::string& name) {
  std::cout << describe(name);
  return kDone;
}

}  // namespace

std::vector<std::string> list_kinds() {
  std::vector<std::string> kinds{"scenarios", "effects"};
  kinds.insert(kinds.end(), asset_folders().begin(), asset_folders().end());
  return kinds;
}

void add_list_command(CLI::App& app, Action& action) {
  const auto [command, options] = add_command<ListOptions>(
      app, action, "list", "List scenarios, effects, tires, rigs, vehicles, cycles, sensors", &list_command);
  command->add_option("kind", options->kind, "What to list: scenarios, effects, tires, ... [all]");
  add_output_option(*command, "--json", options->json, "File for the list, - for standard output");
}

void add_describe_command(CLI::App& app, Action& action) {
  const auto [command, name] = add_command<std::string>(
      app, action, "describe", "Explain a scenario, an effect, a tire, a rig, a vehicle or sensors", &describe_command);
  command->add_option("name", *name, "Scenario, effect or asset, or a path of a file")->required();
}

}  // namespace rollrig::cli
