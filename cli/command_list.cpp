#include <fmt/format.h>

#include <algorithm>
#include <iostream>

#include "cli/command.h"
#include "cli/print.h"
#include "scenarios/common/speed_trace.h"
#include "scenarios/run/run_spec.h"
#include "sim/core/assets.h"
#include "sim/core/file_io.h"
#include "sim/core/text.h"

namespace rollrig::cli {
namespace {

constexpr const char* kAssetFolders[]{"tires", "rigs", "vehicles", "cycles", "sensors"};

Json list_everything() {
  Json json = {{"scenarios", Json::array()}, {"effects", Json::array()}};
  for (const scenarios::Scenario* scenario : scenarios::all_scenarios()) {
    json["scenarios"].push_back({{"name", scenario->text.name}, {"summary", scenario->text.summary}});
  }
  for (const models::Effect* effect : models::all_effects()) {
    json["effects"].push_back({{"name", effect->info.id}, {"summary", effect->info.summary}});
  }
  for (const char* folder : kAssetFolders) json[folder] = list_assets(folder);
  return json;
}

int list_command(const std::string& json_file) {
  const Json all = list_everything();
  if (!json_file.empty()) write_output(json_file, all.dump(2) + "\n");
  if (json_file == "-") return kDone;
  for (const char* kind : {"scenarios", "effects"}) {
    std::cout << kind << '\n';
    for (const Json& item : all[kind]) {
      std::cout << "  " << item["name"].get<std::string>() << '\n' << wrap(item["summary"].get<std::string>(), 6);
    }
  }
  for (const char* kind : kAssetFolders) {
    std::cout << kind << '\n' << wrap(fmt::format("{}", fmt::join(all[kind].get<std::vector<std::string>>(), "  ")), 2);
  }
  return kDone;
}

void describe_scenario(const scenarios::Scenario& scenario) {
  std::cout << scenario.text.name << ": scenario\n" << wrap(scenario.text.summary, 2) << '\n';
  std::cout << "Procedure\n" << wrap(scenario.text.procedure, 2) << "Source\n" << wrap(scenario.text.source, 2);
  std::cout << "Settings (--set key=value)\n";
  for (const scenarios::SettingInfo& setting : scenario.settings) {
    const std::string range = setting.range.empty() ? "" : ", " + setting.range;
    std::cout << fmt::format("  {} [{}{}]\n", setting.key, setting.fallback, range) << wrap(setting.doc, 6);
  }
  std::cout << "Results\n";
  for (const scenarios::ResultInfo& result : scenario.results) {
    std::cout << "  " << result.key << '\n' << wrap(result.doc, 6);
  }
}

std::string join_or_none(const std::vector<std::string>& words) {
  return words.empty() ? "none" : fmt::format("{}", fmt::join(words, ", "));
}

void describe_effect(const models::EffectInfo& info) {
  std::cout << info.id << ": effect\n" << wrap(info.summary, 2) << '\n';
  std::cout << "Equation\n" << wrap(info.equation, 2) << "Source\n" << wrap(info.source, 2);
  std::cout << fmt::format("Parameters ([effects.{}])\n", info.id);
  for (const models::EffectParameter& parameter : info.parameters) {
    const std::string off = parameter.off.has_value() ? fmt::format(", off at {}", *parameter.off) : "";
    std::cout << fmt::format("  {} [{:.4g}; usual {:.4g} to {:.4g}{}; {}{}]\n", parameter.key, parameter.prior.center(),
                             parameter.prior.low, parameter.prior.high,
                             parameter.prior.either_sign ? ", either sign" : "", parameter.range.to_string(), off)
              << wrap(parameter.doc, 6);
  }
  std::cout << "Acts on\n" << wrap(join_or_none(rigs::list_machines(info.acts_on)), 2);
  if (info.only_against != nullptr) std::cout << "Acts only against\n  the baseline constant_rrc\n";
  const std::vector<std::string> faint = rigs::list_machines(info.faint_on);
  if (!faint.empty()) std::cout << "Too faint to be seen on\n" << wrap(join_or_none(faint), 2);
  std::cout << "Shows in\n" << wrap(join_or_none(rigs::list_visible(info)), 2);
  std::cout << "Leaves clean\n" << wrap(join_or_none(rigs::list_clean(info)), 2);
  std::cout << "Confused with\n" << wrap(join_or_none(info.confused_with), 2);
  std::cout << "Tests that split\n" << wrap(fmt::format("{}", fmt::join(info.splitting_tests, "; ")), 2);
}

/// Source comments of an asset are part of what it says: the file itself is shown.
void describe_file(const std::string& path) { std::cout << path << "\n\n" << read_text_file(path); }

/// A trace is read best in a plot; here what it comes to.
void describe_cycle(const std::string& path) {
  const scenarios::SpeedTrace trace = scenarios::read_speed_trace(path);
  double distance_m = 0.0;
  double standing_s = 0.0;
  for (std::size_t i = 1; i < trace.time_s.size(); ++i) {
    const double step_s = trace.time_s[i] - trace.time_s[i - 1];
    distance_m += 0.5 * (trace.speed_m_s[i] + trace.speed_m_s[i - 1]) * step_s;
    if (trace.speed_m_s[i] == 0.0 && trace.speed_m_s[i - 1] == 0.0) standing_s += step_s;
  }
  const double fastest_m_s = *std::max_element(trace.speed_m_s.begin(), trace.speed_m_s.end());
  std::cout << path << "\n\n"
            << fmt::format("{}: drive cycle, {}, {:.0f} s, {:.3f} km, at most {:.1f} km/h, {:.0f} s at standstill\n",
                           trace.name, format_count(trace.time_s.size(), "row"), trace.duration_s(), distance_m / 1e3,
                           3.6 * fastest_m_s, standing_s);
}

int describe_command(const std::string& name) {
  std::vector<std::string> known = scenarios::scenario_names();
  const auto is_asked = [&](const std::string& each) {
    known.push_back(each);
    return each == name;
  };
  if (const scenarios::Scenario* scenario = scenarios::find_scenario_if_any(name)) {
    describe_scenario(*scenario);
    return kDone;
  }
  for (const models::Effect* effect : models::all_effects()) {
    if (!is_asked(effect->info.id)) continue;
    describe_effect(effect->info);
    return kDone;
  }
  for (const std::string folder : kAssetFolders) {
    for (const std::string& asset : list_assets(folder)) {
      if (!is_asked(asset)) continue;
      const std::string path = find_asset(folder, name);
      folder == "cycles" ? describe_cycle(path) : describe_file(path);
      return kDone;
    }
  }
  throw InputError(unknown_name("scenario, effect or asset", name, known));
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
