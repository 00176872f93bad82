#include "serve/shelf.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "api/data.h"
#include "rigs/vehicle_file.h"
#include "sim/core/assets.h"
#include "sim/core/error.h"
#include "sim/core/units.h"

namespace fs = std::filesystem;

namespace rollrig::serve {
namespace {

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

/// What a control needs of a number.
Json make_control(const std::string& key, const Range& range, const std::string& doc) {
  return {{"key", key},
          {"label", plain_name(key)},
          {"unit", unit_of_key(key).symbol},
          {"doc", doc},
          {"lower", number_or_null(range.lower)},
          {"upper", number_or_null(range.upper)}};
}

Json make_setting(const scenarios::SettingInfo& setting) {
  Json json = make_control(setting.key, setting.limits.value_or(Range{}), setting.doc);
  json["fallback"] = setting.fallback;
  if (!setting.choices.empty()) json["choices"] = setting.choices;
  return json;
}

/// From where the effect does nothing to somewhat beyond what is usual, within what is allowed.
std::pair<double, double> find_slider(const models::EffectParameter& parameter) {
  const models::Prior& prior = parameter.prior;
  constexpr double kBeyond = 1.5;  // Assumed: of the usual size
  const double zero = parameter.off.value_or(prior.either_sign ? 0.0 : prior.low);
  const double least = prior.either_sign ? -prior.high : std::min({zero, prior.low, prior.high});
  const double most = std::max({zero, prior.low, prior.high});
  const double from = zero + kBeyond * (least - zero);
  const double to = zero + kBeyond * (most - zero);
  return {std::max(from, parameter.range.lower), std::min(to, parameter.range.upper)};
}

Json make_effect_parameter(const models::EffectParameter& parameter) {
  Json json = make_control(parameter.key, parameter.range, parameter.doc);
  const auto [from, to] = find_slider(parameter);
  json["from"] = from;
  json["to"] = to;
  json["center"] = parameter.prior.center();
  if (parameter.off.has_value()) json["off"] = *parameter.off;
  return json;
}

Json make_effect(const models::EffectInfo& info) {
  return {{"id", info.id},
          {"label", plain_name(info.id)},
          {"summary", info.summary},
          {"parameters", make_list(info.parameters, &make_effect_parameter)}};
}

}  // namespace

bool is_offered(const scenarios::Scenario& scenario) {
  const auto& fidelities = scenario.fidelities;
  const bool is_quick =
      std::find(fidelities.begin(), fidelities.end(), scenarios::Fidelity::kQuasiStatic) != fidelities.end();
  return is_quick && std::none_of(scenario.settings.begin(), scenario.settings.end(),
                                  [](const auto& setting) { return setting.fallback == "required"; });
}

Shelf::Shelf(const ShelfFiles& files) {
  const auto fill = [this](const char* kind, const std::string& folder, const std::vector<std::string>& given,
                           auto&& describe) {
    std::vector<Item>& items = items_[kind];
    std::vector<std::string> names = list_assets(folder);
    names.insert(names.end(), given.begin(), given.end());
    for (const std::string& name : names) {
      Item item{name, absolute_if_path(name), "", nullptr};
      describe(read_config(find_asset(folder, item.path)), item);
      items.push_back(std::move(item));
    }
  };
  fill("tire", "tires", files.tires,
       [](const ConfigTable& config, Item& item) { item.note = models::read_tire(config).designation; });
  fill("rig", "rigs", files.rigs, [](const ConfigTable& config, Item& item) {
    item.machine = rigs::read_rig(config).kind;
    item.note = item.machine->word;
  });
  fill("vehicle", "vehicles", files.vehicles, [](const ConfigTable& config, Item& item) {
    item.note = fmt::format("{:.0f} kg", rigs::read_vehicle(config).body.mass_kg);
  });
}

const std::string& Shelf::find(const std::string& kind, const std::string& name) const {
  std::vector<std::string> known;
  for (const Item& item : items_of(kind)) {
    if (item.name == name) return item.path;
    known.push_back(item.name);
  }
  InputProblem problem = unknown_name(kind, name, known);
  problem.key = kind;
  throw InputError(problem);
}

Json Shelf::make_scenario(const scenarios::Scenario& scenario) const {
  Json settings = Json::array();
  for (const scenarios::SettingInfo& setting : scenario.settings) {
    if (setting.limits.has_value() || !setting.choices.empty()) settings.push_back(make_setting(setting));
  }
  Json rigs = Json::array();
  for (const Item& item : items_of("rig")) {
    if (scenario.has_rig() && scenario.runs_on(item.machine->traits)) rigs.push_back(item.name);
  }
  return {{"name", scenario.text.name},          {"summary", scenario.text.summary},
          {"rig", scenario.default_rig},         {"rigs", rigs},
          {"has_vehicle", scenario.has_vehicle}, {"settings", settings}};
}

Json Shelf::make_choices() const {
  const auto list = [this](const char* kind) {
    return make_list(items_of(kind), [](const Item& item) { return Json{{"name", item.name}, {"note", item.note}}; });
  };
  Json json{{"tires", list("tire")}, {"rigs", list("rig")}, {"vehicles", list("vehicle")}};
  json["scenarios"] = Json::array();
  for (const scenarios::Scenario* scenario : scenarios::all_scenarios()) {
    if (is_offered(*scenario)) json["scenarios"].push_back(make_scenario(*scenario));
  }
  json["effects"] =
      make_list(models::all_effects(), [](const models::Effect* effect) { return make_effect(effect->info); });
  return json;
}

}  // namespace rollrig::serve
