#include "tools/reference_page.h"

#include <fmt/format.h>

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/replace.hpp>

#include "measurements/measurement_set.h"
#include "models/tire/tire_file.h"
#include "rigs/rig_file.h"
#include "rigs/vehicle_file.h"
#include "scenarios/run/scenario.h"

namespace rollrig::tools {
namespace {

constexpr const char* kIntroduction =
    "# Reference\n\n"
    "Every scenario, setting, result and effect, and the keys of tire, rig, vehicle and sensor files; those of other "
    "files are in\n[formats.md](formats.md). Written by `cmake --build build/release --target "
    "docs_pages`\nfrom the declarations in the code; a test holds it to them.\n";

/// A cell of a Markdown table.
std::string cell(const std::string& text) { return boost::algorithm::replace_all_copy(text, "|", "\\|"); }

std::string list_or_none(const std::vector<std::string>& words) {
  return words.empty() ? "none" : boost::algorithm::join(words, ", ");
}

std::string anchor_list(const std::vector<std::string>& names) {
  std::vector<std::string> links;
  for (const std::string& name : names) links.push_back(fmt::format("[`{0}`](#{0})", name));
  return boost::algorithm::join(links, ", ") + "\n";
}

std::string describe(const scenarios::Scenario& scenario) {
  const scenarios::ScenarioText& about = scenario.text;
  std::string text = fmt::format("\n### {}\n\n{}\n\n*Procedure.* {}\n\n*Source.* {}\n", about.name, about.summary,
                                 about.procedure, about.source);
  text += "\n| setting | allowed | default | meaning |\n|---|---|---|---|\n";
  for (const scenarios::SettingInfo& setting : scenario.settings) {
    text +=
        fmt::format("| `{}` | {} | {} | {} |\n", setting.key, cell(setting.range), setting.fallback, cell(setting.doc));
  }
  text += "\n| result | meaning |\n|---|---|\n";
  for (const scenarios::ResultInfo& result : scenario.results) {
    text += fmt::format("| `{}` | {} |\n", result.key, cell(result.doc));
  }
  return text;
}

std::string describe(const models::EffectInfo& effect) {
  std::string text = fmt::format("\n### {}\n\n{}\n\n*Equation.* {}\n\n*Source.* {}\n", effect.id, effect.summary,
                                 effect.equation, effect.source);
  text += "\n| parameter | allowed | usual | off at | meaning |\n|---|---|---|---|---|\n";
  for (const models::EffectParameter& parameter : effect.parameters) {
    text +=
        fmt::format("| `{}` | {} | {:.4g} to {:.4g}{} | {} | {} |\n", parameter.key, cell(parameter.range.to_string()),
                    parameter.prior.low, parameter.prior.high, parameter.prior.either_sign ? ", either sign" : "",
                    parameter.off.has_value() ? fmt::format("{}", *parameter.off) : "", cell(parameter.doc));
  }
  text += fmt::format("\n*Acts on* {}", list_or_none(rigs::list_machines(effect.acts_on)));
  if (effect.only_against != nullptr) text += ", only against the baseline `constant_rrc`";
  const std::vector<std::string> faint = rigs::list_machines(effect.faint_on);
  if (!faint.empty()) text += fmt::format(", too little to be seen on {}", list_or_none(faint));
  text += fmt::format(". *Shows in* {}. *Leaves clean* {}. *Confused with* {}. *Tests that split:* {}.\n",
                      list_or_none(rigs::list_visible(effect)), list_or_none(rigs::list_clean(effect)),
                      list_or_none(effect.confused_with), boost::algorithm::join(effect.splitting_tests, "; "));
  return text;
}

std::string describe_keys(const std::vector<Field>& fields) {
  std::string text = "\n| key | allowed | default | meaning |\n|---|---|---|---|\n";
  for (const Field& field : fields) {
    text +=
        fmt::format("| `{}` | {} | {} | {} |\n", field.key, cell(field.range.to_string()),
                    field.fallback.has_value() ? fmt::format("{:.6g}", *field.fallback) : "required", cell(field.doc));
  }
  return text;
}

template <class Group>
std::string describe_keys() {
  return describe_keys(list_fields<Group>());
}

template <class Group>
std::string describe_table(const std::string& name) {
  return fmt::format("\n`[{}]`\n", name) + describe_keys<Group>();
}

/// The tire models, each with the table of its own numbers.
std::string describe_tire_models() {
  std::string text = "\n`model`, by default `" + models::default_tire_model().info.id + "`:\n";
  for (const models::TireModel* model : models::all_tire_models()) {
    const models::TireModelInfo& info = model->info;
    text += fmt::format("\n<a name=\"{0}\"></a>`{0}`: {1}. Needs `[{2}]`.\n", info.id, info.summary,
                        boost::algorithm::join(info.tables, "]`, `["));
    std::vector<Field> fields;
    for (const models::TireModelParameter& own : info.parameters) fields.push_back(own.field);
    if (!fields.empty()) text += fmt::format("\n`[{}]`\n", info.id) + describe_keys(fields);
  }
  return text;
}

std::string describe_tire_file() {
  using Tire = models::TireParameters<double>;
  std::string text =
      "\n## Tire file\n\n`format = \"rollrig-tire/2\"`, `name`, `designation`, `model`, and the tables below. A "
      "number of `[rolling_resistance]`, `[thermal]`,\n`[constant]` and a model's own may have its standard "
      "uncertainty "
      "beside it, under its key with `_sd`.\n";
  text += describe_tire_models();
  text += describe_table<decltype(Tire::geometry)>("geometry");
  text += describe_table<decltype(Tire::stiffness)>("stiffness");
  text += describe_table<decltype(Tire::rolling_resistance)>("rolling_resistance");
  text += describe_table<models::LoadMapEntry<double>>("[rolling_resistance.load_map]");
  text += describe_table<decltype(Tire::thermal)>("thermal");
  text +=
      "\n`[thermal.rig.<rig name>]`: `conductance_at_rest_W_per_K` and `conductance_per_speed_W_s_per_m_K` as "
      "identified "
      "on that rig, in place of the above.\n";
  text += describe_table<decltype(Tire::constant)>("constant");
  text +=
      "\n`[iso_28580]` (`rrc_N_per_kN`, `load_N`, `pressure_kPa`): what the tire's own test says; load and pressure "
      "are the\ndefaults of scenarios. `[load_sweep]` (`loads_N`): the loads of its load sweep.\n";
  return text;
}

std::string describe_rig_file() {
  std::string text =
      "\n## Rig file\n\n`format = \"rollrig-rig/2\"`, `name`, `kind` (`drum`, `flat_belt`, `dyno` or `road`), "
      "`conductances_of` (a rig on which tires cool alike; default: its own name), and the tables below. A flat belt has "
      "`[belt]` in place of `[drum]`, a dyno `[roller]`, `[tie_down]`, and `rollers_under` (`all_wheels`, the "
      "default, or `driven_wheels`: the other axle stands still); `[skim]` and `[carriage]` belong to a\ndrum or "
      "belt, `[parasitic]` and `[drive]` to all but a road.\n";
  text += describe_table<rigs::DrumParameters>("drum");
  text += describe_table<rigs::BeltParameters>("belt");
  text += describe_table<models::ParasiticParameters<double>>("parasitic");
  text += describe_table<rigs::RigEnvironment>("environment");
  text += describe_table<rigs::SkimParameters>("skim");
  text += describe_table<rigs::CarriageParameters>("carriage");
  text += describe_table<rigs::DriveParameters>("drive");
  text += describe_table<rigs::TieDownParameters>("tie_down");
  return text;
}

std::string describe_vehicle_file() {
  std::string text =
      "\n## Vehicle file\n\n`format = \"rollrig-vehicle/2\"`, `name`, the keys of the first table, of which each may "
      "have "
      "its standard uncertainty beside it\nunder its key with `_sd`, `center_of_gravity_height_m` (above the road, "
      "default 0.6), an `[[axle]]` for each axle from the front, and the tables\n`[powertrain]` and `[road_load]`, "
      "which "
      "may be left out.\n";
  text += describe_keys<rigs::VehicleBody>();
  text +=
      "\n`[[axle]]`: `name` (default `front` and `rear` of two axles, else `axle_1` and so on), `tire` (a name or a "
      "path, default that of the run),\n`[axle.suspension]`, and the keys below. Each kind of share sums to 1 over all "
      "axles.\n";
  text += describe_keys<rigs::VehicleAxle>();
  text += describe_table<rigs::VehicleSuspension>("axle.suspension") + "\nOf one wheel.\n";
  text += describe_table<rigs::VehiclePowertrain>("powertrain");
  text += describe_table<models::RoadLoad<double>>("road_load");
  text +=
      "\nIn place of drag and tires on the road. Then `drag_area_m2` may be left out.\n\nFormat `rollrig-vehicle/1` is "
      "read as well: two axles, `front` and `rear`, with half of the `tires` (1 to 20) each. In place of\n`[[axle]]` "
      "it "
      "has `[suspension]`, `driven_axle` (`front`, `rear` (default) or `all`) in `[powertrain]`, and the tables "
      "below.\n";
  text += describe_table<rigs::TwoAxleGeometry>("geometry");
  return text + describe_table<rigs::TwoAxleBrakes>("brakes");
}

}  // namespace

std::string make_reference_page() {
  std::vector<std::string> effects;
  for (const models::Effect* effect : models::all_effects()) effects.push_back(effect->info.id);
  std::string text = kIntroduction;
  text += "\n## Scenarios\n\n" + anchor_list(scenarios::scenario_names());
  for (const scenarios::Scenario* scenario : scenarios::all_scenarios()) text += describe(*scenario);
  text += "\n## Effects\n\n" + anchor_list(effects);
  for (const models::Effect* effect : models::all_effects()) text += describe(effect->info);
  text += describe_tire_file() + describe_rig_file() + describe_vehicle_file();
  text += "\n## Sensors\n\nA sensor measures one of " + list_or_none(rigs::all_measured_channels()) +
          "\n(`[sensors.<channel>]` of a set or of a file `rollrig-sensors/1`, which has a `name` beside it: "
          "`offset_sd`, `drift_sd`, `drift_time_s`, `noise_sd`, `resolution`, each with the "
          "channel's unit).\n";
  return text;
}

}  // namespace rollrig::tools
