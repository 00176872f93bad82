#include "validation/scoring/decision_settings.h"

#include <fmt/format.h>

#include <algorithm>

#include "models/effect.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/parse_json.h"

namespace rollrig::validation {
namespace {

constexpr const char* kSettingsFormat = "rollrig-validation-settings/1";

Json describe(const models::Effect& effect) {
  const models::EffectInfo& info = effect.info;
  Json json = {{"law_share", info.law_error.law_share}, {"whole_share", info.law_error.whole_share}};
  for (const models::EffectParameter& parameter : info.parameters) {
    const models::Prior& prior = parameter.prior;
    json["parameters"][parameter.key] = {
        {"low", prior.low},
        {"high", prior.high},
        {"scale", prior.scale == models::Prior::Scale::kLog ? "log" : "linear"},
        {"either_sign", prior.either_sign},
        {"range",
         {fmt::format("{}", parameter.range.lower), fmt::format("{}", parameter.range.upper)}}};  // may be infinite
  }
  return json;
}

/// "effects/windage/law_share" of a JSON pointer, as a person reads it.
std::string name_of_setting(const std::string& pointer) {
  std::string name = pointer.substr(1);
  std::replace(name.begin(), name.end(), '/', ' ');
  return name;
}

}  // namespace

Json list_decision_settings() {
  Json settings = {{"format", kSettingsFormat}, {"thresholds", list_thresholds()}, {"effects", Json::object()}};
  for (const models::Effect* effect : models::all_effects()) settings["effects"][effect->info.id] = describe(*effect);
  return settings;
}

SettingsComparison compare_settings(const Json& recorded, const Json& now) {
  SettingsComparison comparison;
  Json known = now;
  for (const auto& [id, effect] : now.at("effects").items()) {
    if (recorded.at("effects").contains(id)) continue;
    comparison.new_effects.push_back(id);
    known["effects"].erase(id);
  }
  const Json before = recorded.flatten();
  const Json after = known.flatten();
  for (const auto& [pointer, value] : before.items()) {
    if (!after.contains(pointer)) {
      comparison.changes.push_back(fmt::format("{} was {}, and is gone", name_of_setting(pointer), value.dump()));
    } else if (after.at(pointer) != value) {
      comparison.changes.push_back(
          fmt::format("{} was {}, and is {}", name_of_setting(pointer), value.dump(), after.at(pointer).dump()));
    }
  }
  for (const auto& [pointer, value] : after.items()) {
    if (!before.contains(pointer)) {
      comparison.changes.push_back(fmt::format("{} is new: {}", name_of_setting(pointer), value.dump()));
    }
  }
  return comparison;
}

Json read_settings(const std::string& file) {
  try {
    Json settings = read_json(file);
    if (settings.at("format") == kSettingsFormat && settings.at("effects").is_object()) return settings;
  } catch (const Json::exception&) {  // said below
  }
  throw InputError({"no record of a validation set's settings", file, 0, "format", "", kSettingsFormat, ""});
}

}  // namespace rollrig::validation
