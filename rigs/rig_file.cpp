#include "rigs/rig_file.h"

#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "rigs/toml_group.h"
#include "sim/core/error.h"

namespace rollrig::rigs {
namespace {

const char* const kAllWheels = "all_wheels";
const char* const kDrivenWheels = "driven_wheels";

using Presence = RigFile::Presence;

/// Reads table [name] into a visited group; parasitic loss and cooling of tires may have standard uncertainties
/// beside them.
template <class Group>
void read_table(TableReader& file, const std::string& name, Presence presence, Group& group, RigFile& rig) {
  const ConfigTable* table = file.table(name);
  if (table == nullptr && presence == Presence::kOptional) return;
  if (table == nullptr && presence == Presence::kRequired) {
    throw file.problem(name, fmt::format("missing table [{}]", name), fmt::format("a table [{}]", name));
  }
  const ConfigTable empty{{}, file.source().origin};
  TableReader reader(table != nullptr ? *table : empty, fmt::format("[{}]", name));
  read_fields(reader, group);
  if constexpr (std::is_same_v<Group, models::ParasiticParameters<double>>) {
    read_standard_uncertainties(reader, rig.parasitic_uncertainties);
  }
  if constexpr (std::is_same_v<Group, models::TireCooling>) {
    read_standard_uncertainties(reader, rig.tire_cooling_uncertainties);
  }
  reader.finish();
}

const MachineKind& read_kind(TableReader& file) {
  if (const MachineKind* kind = find_machine_kind_if_any(file.text("kind"))) return *kind;
  return find_machine_kind(file.text("kind", machine_words()));  // throws
}

/// Whether a table that may be left out was there.
template <class Group>
bool has_numbers(const Group& group) {
  bool has = false;
  Group::visit(group, [&has](const Field&, const double& value) { has = has || value != 0.0; });
  return has;
}

/// Whether the file says what the first format could not.
bool is_new_form(const RigFile& rig) {
  return !rig.conductances_of.empty() || rig.tire_cooling.is_given() || has_numbers(rig.skim_by_class) ||
         std::string(rig.kind->word) != rig.kind->former_word;
}

}  // namespace

RigFile read_rig(const ConfigTable& config) {
  RigFile rig;
  rig.path = config.origin.file;
  TableReader file(config, "");
  check_format(file, "rollrig-rig", 2);
  rig.name = file.text("name");
  rig.kind = &read_kind(file);
  rig.conductances_of = file.text_or("conductances_of", "");
  RigFile::visit_tables(
      rig, [&](const char* name, auto& table, Presence presence) { read_table(file, name, presence, table, rig); });
  if (is_tied_down(rig.kind->traits)) {
    rig.driven_wheels_only = file.text_or("rollers_under", kAllWheels, {kAllWheels, kDrivenWheels}) == kDrivenWheels;
  }
  file.finish();
  return rig;
}

std::string write_rig(const RigFile& rig) {
  std::string text = fmt::format("format = \"rollrig-rig/{}\"\nname = \"{}\"\nkind = \"{}\"\n",
                                 is_new_form(rig) ? 2 : 1, rig.name, rig.kind->word);
  if (!rig.conductances_of.empty()) text += fmt::format("conductances_of = \"{}\"\n", rig.conductances_of);
  if (rig.driven_wheels_only) text += fmt::format("rollers_under = \"{}\"\n", kDrivenWheels);
  RigFile::visit_tables(rig, [&](const char* name, const auto& table, Presence presence) {
    if (presence == Presence::kOptional && !has_numbers(table)) return;
    if constexpr (std::is_same_v<decltype(table), const models::ParasiticParameters<double>&>) {
      text += write_group(name, table, &rig.parasitic_uncertainties);
    } else if constexpr (std::is_same_v<decltype(table), const models::TireCooling&>) {
      text += write_group(name, table, &rig.tire_cooling_uncertainties);
    } else {
      text += write_group(name, table);
    }
  });
  return text;
}

void use_skim_load_of_class(RigFile& rig, const models::TireFile& tire) {
  const SkimByClassParameters loads = std::exchange(rig.skim_by_class, {});
  if (!tire.service.has_value() || tire.service->tire_class == models::TireClass::kC1) return;
  const double load_N = tire.service->tire_class == models::TireClass::kC2 ? loads.c2_load_N : loads.c3_load_N;
  if (load_N > 0.0) rig.skim.load_N = load_N;
}

const char* name_of_rolling_wheels(const RigFile& rig) { return rig.driven_wheels_only ? kDrivenWheels : kAllWheels; }

models::Context<double> make_context(const models::TireFile& tire, const RigFile& rig, models::Baseline baseline) {
  models::Context<double> context;
  context.tire = tire.parameters_on(rig.cooling_rig(), baseline);
  context.parasitic = rig.parasitic;
  context.machine = rig.kind->traits;
  if (is_indoors(context.machine)) {
    const double lever_m = rig.lever_m();
    context.surface_curvature_per_m = rig.curvature_per_m();
    context.machine_radius_m = lever_m;
    context.machine_mass_kg = rig.inertia() / (lever_m * lever_m);
  }
  context.skim_load_N = rig.skim.load_N;
  return context;
}

}  // namespace rollrig::rigs
