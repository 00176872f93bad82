#include "rigs/rig_file.h"

#include <map>

#include <fmt/format.h>

#include "rigs/toml_group.h"
#include "sim/core/error.h"

namespace rollrig::rigs {
namespace {

const std::map<std::string, RigKind> kKinds{
    {"drum", RigKind::kDrum}, {"dyno", RigKind::kDyno}, {"flat", RigKind::kFlat}};

const char* const kAllWheels = "all_wheels";
const char* const kDrivenWheels = "driven_wheels";

/// Reads table [name] into a visited group; an absent table is an error unless every field has a default.
template <class Group>
void read_table(TableReader& file, const std::string& name, Group& group, bool may_be_absent) {
  const ConfigTable* table = file.table(name);
  if (table == nullptr && !may_be_absent) {
    throw file.problem(name, fmt::format("missing table [{}]", name), fmt::format("a table [{}]", name));
  }
  const ConfigTable empty{{}, file.source().origin};
  TableReader reader(table != nullptr ? *table : empty, fmt::format("[{}]", name));
  read_fields(reader, group);
  reader.finish();
}

void read_parasitic(TableReader& file, RigFile& rig) {
  const ConfigTable* table = file.table("parasitic");
  if (table == nullptr) throw file.problem("parasitic", "missing table [parasitic]", "a table [parasitic]");
  TableReader reader(*table, "[parasitic]");
  read_fields(reader, rig.parasitic);
  read_standard_uncertainties(reader, rig.parasitic_uncertainties);
  reader.finish();
}

}  // namespace

RigFile read_rig(const ConfigTable& config) {
  RigFile rig;
  rig.path = config.origin.file;
  TableReader file(config, "");
  check_format(file, "rollrig-rig", 1);
  rig.name = file.text("name");
  rig.kind = kKinds.at(file.text("kind", {"drum", "dyno", "flat"}));
  if (rig.kind == RigKind::kDrum) read_table(file, "drum", rig.drum, false);
  if (rig.kind == RigKind::kDyno) {
    read_table(file, "roller", rig.drum, false);
    rig.driven_wheels_only = file.text_or("rollers_under", kAllWheels, {kAllWheels, kDrivenWheels}) == kDrivenWheels;
  }
  if (rig.kind != RigKind::kFlat) read_parasitic(file, rig);
  read_table(file, "environment", rig.environment, false);
  if (rig.kind == RigKind::kDrum) {
    read_table(file, "skim", rig.skim, false);
    read_table(file, "carriage", rig.carriage, true);
  } else if (file.has("skim")) {
    read_table(file, "skim", rig.skim, false);
  }
  if (rig.kind == RigKind::kDyno) read_table(file, "tie_down", rig.tie_down, true);
  if (rig.kind != RigKind::kFlat) read_table(file, "drive", rig.drive, true);
  file.finish();
  return rig;
}

std::string write_rig(const RigFile& rig) {
  std::string kind;
  for (const auto& [name, value] : kKinds) {
    if (value == rig.kind) kind = name;
  }
  std::string text = fmt::format("format = \"rollrig-rig/1\"\nname = \"{}\"\nkind = \"{}\"\n", rig.name, kind);
  if (rig.driven_wheels_only) text += fmt::format("rollers_under = \"{}\"\n", kDrivenWheels);
  if (rig.kind != RigKind::kFlat) {
    text += write_group(rig.kind == RigKind::kDrum ? "drum" : "roller", rig.drum);
    text += write_group("parasitic", rig.parasitic, &rig.parasitic_uncertainties);
  }
  text += write_group("environment", rig.environment);
  if (rig.skim.load_N > 0.0) text += write_group("skim", rig.skim);
  if (rig.kind == RigKind::kDrum) text += write_group("carriage", rig.carriage);
  if (rig.kind == RigKind::kDyno) text += write_group("tie_down", rig.tie_down);
  if (rig.kind != RigKind::kFlat) text += write_group("drive", rig.drive);
  return text;
}

const char* name_of_rolling_wheels(const RigFile& rig) { return rig.driven_wheels_only ? kDrivenWheels : kAllWheels; }

models::Context<double> make_context(const models::TireFile& tire, const RigFile& rig, models::Baseline baseline) {
  models::Context<double> context;
  context.tire = tire.parameters_on(rig.name, baseline);
  context.parasitic = rig.parasitic;
  context.rig_kind = rig.kind;
  if (rig.kind != RigKind::kFlat) {
    const double radius_m = rig.drum.diameter_m / 2.0;
    context.surface_curvature_per_m = 2.0 / rig.drum.diameter_m;
    context.machine_radius_m = radius_m;
    context.machine_mass_kg = rig.drum.inertia_kg_m2 / (radius_m * radius_m);
  }
  context.skim_load_N = rig.skim.load_N;
  return context;
}

}  // namespace rollrig::rigs
