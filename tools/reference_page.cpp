#include <boost/algorithm/string/join.hpp>

#include "measurements/measurement_set.h"
#include "models/tire/tire_file.h"
#include "rigs/rig_file.h"
#include "rigs/vehicle_file.h"
#include "scenarios/run/scenario.h"
#include "tools/pages.h"

namespace rollrig::tools {
namespace {

std::string list_or_none(const std::vector<std::string>& words) {
  return words.empty() ? "none" : boost::algorithm::join(words, ", ");
}

std::string anchor_list(const std::vector<std::string>& names) {
  std::vector<std::string> links;
  for (const std::string& name : names) links.push_back(fmt::format("[`{0}`](#{0})", name));
  return boost::algorithm::join(links, ", ");
}

std::string describe(const scenarios::Scenario& scenario) {
  const scenarios::ScenarioText& about = scenario.text;
  std::string text = fmt::format("\n### {}\n\n{}\n\n*Procedure.* {}\n\n*Source.* {}\n", about.name, about.summary,
                                 about.procedure, about.source);
  text += "\n| setting | allowed | default | meaning |\n|---|---|---|---|\n";
  for (const scenarios::SettingInfo& setting : scenario.settings) {
    text += fmt::format("| `{}` | {} | {} | {} |\n", setting.key, escape_cell(setting.range), setting.fallback,
                        escape_cell(setting.doc));
  }
  text += "\n| result | meaning |\n|---|---|\n";
  for (const scenarios::ResultInfo& result : scenario.results) {
    text += fmt::format("| `{}` | {} |\n", result.key, escape_cell(result.doc));
  }
  return text;
}

std::string describe(const models::EffectInfo& effect) {
  std::string text = fmt::format("\n### {}\n\n{}\n\n*Equation.* {}\n\n*Source.* {}\n", effect.id, effect.summary,
                                 effect.equation, effect.source);
  text += "\n| parameter | allowed | usual | off at | meaning |\n|---|---|---|---|---|\n";
  for (const models::EffectParameter& parameter : effect.parameters) {
    text += fmt::format("| `{}` | {} | {:.4g} to {:.4g}{} | {} | {} |\n", parameter.key,
                        escape_cell(parameter.range.to_string()), parameter.prior.low, parameter.prior.high,
                        parameter.prior.either_sign ? ", either sign" : "",
                        parameter.off.has_value() ? fmt::format("{}", *parameter.off) : "", escape_cell(parameter.doc));
  }
  text += fmt::format("\n*Acts on* {}", list_or_none(rigs::list_machines(effect.acts_on)));
  if (effect.only_against != nullptr) text += ", only against the baseline `constant_rrc`";
  const std::vector<std::string> faint = rigs::list_machines(effect.faint_on);
  if (!faint.empty()) text += fmt::format(", too small to be seen on {}", list_or_none(faint));
  text += fmt::format(". *Visible in* {}. *Leaves unchanged* {}. *Confused with* {}. *Separated by:* {}.\n",
                      list_or_none(rigs::list_visible(effect)), list_or_none(rigs::list_clean(effect)),
                      list_or_none(effect.confused_with), boost::algorithm::join(effect.splitting_tests, "; "));
  return text;
}

std::string describe_keys(const std::vector<Field>& fields) {
  Rows rows{"| key | allowed | default | meaning |", "|---|---|---|---|"};
  for (const Field& field : fields) {
    rows.push_back(fmt::format("| `{}` | {} | {} | {} |", field.key, escape_cell(field.range.to_string()),
                               field.fallback.has_value() ? fmt::format("{:.6g}", *field.fallback) : "required",
                               escape_cell(field.doc)));
  }
  return join(rows);
}

template <class Group>
std::string describe_keys() {
  return describe_keys(list_fields<Group>());
}

/// The tire models, each with the table of its own numbers.
std::string describe_tire_models() {
  std::string text;
  for (const models::TireModel* model : models::all_tire_models()) {
    const models::TireModelInfo& info = model->info;
    text += fmt::format("\n<a name=\"{0}\"></a>`{0}`: {1}. Needs `[{2}]`.\n", info.id, info.summary,
                        boost::algorithm::join(info.tables, "]`, `["));
    std::vector<Field> fields;
    for (const models::TireModelParameter& own : info.parameters) fields.push_back(own.field);
    if (!fields.empty()) text += fmt::format("\n`[{}]`\n\n{}\n", info.id, describe_keys(fields));
  }
  return text;
}

}  // namespace

std::string make_reference_page() {
  using Tire = models::TireParameters<double>;
  using fmt::literals::operator""_a;
  std::string scenario_texts, effect_texts;
  std::vector<std::string> effect_ids;
  for (const scenarios::Scenario* scenario : scenarios::all_scenarios()) scenario_texts += describe(*scenario);
  for (const models::Effect* effect : models::all_effects()) {
    effect_ids.push_back(effect->info.id);
    effect_texts += describe(effect->info);
  }
  return fill_page(
      "reference", "scenario_links"_a = anchor_list(scenarios::scenario_names()), "scenarios"_a = scenario_texts,
      "effect_links"_a = anchor_list(effect_ids), "effects"_a = effect_texts,
      "default_tire_model"_a = models::default_tire_model().info.id, "tire_models"_a = describe_tire_models(),
      "geometry"_a = describe_keys<decltype(Tire::geometry)>(),
      "stiffness"_a = describe_keys<decltype(Tire::stiffness)>(),
      "rolling_resistance"_a = describe_keys<decltype(Tire::rolling_resistance)>(),
      "load_map"_a = describe_keys<models::LoadMapEntry<double>>(),
      "thermal"_a = describe_keys<decltype(Tire::thermal)>(), "constant"_a = describe_keys<decltype(Tire::constant)>(),
      "drum"_a = describe_keys<rigs::DrumParameters>(), "belt"_a = describe_keys<rigs::BeltParameters>(),
      "parasitic"_a = describe_keys<models::ParasiticParameters<double>>(),
      "environment"_a = describe_keys<rigs::RigEnvironment>(), "skim"_a = describe_keys<rigs::SkimParameters>(),
      "skim_by_class"_a = describe_keys<rigs::SkimByClassParameters>(),
      "carriage"_a = describe_keys<rigs::CarriageParameters>(), "drive"_a = describe_keys<rigs::DriveParameters>(),
      "tie_down"_a = describe_keys<rigs::TieDownParameters>(), "tire_cooling"_a = describe_keys<models::TireCooling>(),
      "body"_a = describe_keys<rigs::VehicleBody>(), "axle"_a = describe_keys<rigs::VehicleAxle>(),
      "suspension"_a = describe_keys<rigs::VehicleSuspension>(),
      "powertrain"_a = describe_keys<rigs::VehiclePowertrain>(), "battery"_a = describe_keys<rigs::VehicleBattery>(),
      "road_load"_a = describe_keys<models::RoadLoad<double>>(),
      "two_axle_geometry"_a = describe_keys<rigs::TwoAxleGeometry>(),
      "two_axle_brakes"_a = describe_keys<rigs::TwoAxleBrakes>(),
      "measured_channels"_a = list_or_none(list_headers(rigs::all_measured_channels())));
}

}  // namespace rollrig::tools
