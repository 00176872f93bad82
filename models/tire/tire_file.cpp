#include "models/tire/tire_file.h"

#include <algorithm>

#include <fmt/format.h>

#include "sim/core/error.h"

namespace rollrig::models {
namespace {

constexpr int kFormatVersion = 2;
constexpr const char* kFormat = "rollrig-tire";

template <class Group>
bool read_group(TableReader& file, const char* name, Group& values) {
  const ConfigTable* table = file.table(name);
  if (table == nullptr) return false;
  TableReader reader(*table, fmt::format("[{}]", name));
  read_fields(reader, values);
  reader.finish();
  return true;
}

template <class Group>
bool read_identified_group(TableReader& file, const char* name, Group& values, Group& uncertainties,
                           const std::vector<std::string>& other_keys = {}) {
  const ConfigTable* table = file.table(name);
  if (table == nullptr) return false;
  TableReader reader(*table, fmt::format("[{}]", name));
  read_fields(reader, values);
  read_standard_uncertainties(reader, uncertainties);
  for (const std::string& key : other_keys) reader.accept(key);
  reader.finish();
  return true;
}

/// A = A0 + A1 v must not be negative where it is used; A1 takes care of higher speeds as far as it is positive.
void check_loss(const ConfigTable& table, const char* header, const SpeedLines<double>& lines, double lowest_m_s) {
  const double least_A0_N = lowest_m_s > 0.0 ? -lines.A1_N_s_per_m * lowest_m_s : 0.0;
  if (lines.A0_N >= least_A0_N) return;
  throw TableReader(table, header)
      .problem("A0_N", "the loss would be negative at the lowest speed of the law",
               fmt::format(">= {:.5g}", least_A0_N));
}

void read_load_map(const ConfigTable& rolling_resistance, TireFile& tire) {
  TableReader reader(rolling_resistance, "[rolling_resistance]");
  for (const ConfigTable* entry_table : reader.tables("load_map")) {
    TableReader entry_reader(*entry_table, "[[rolling_resistance.load_map]]");
    LoadMapEntry<double> entry;
    LoadMapEntry<double> uncertainty;
    read_fields(entry_reader, entry);
    read_standard_uncertainties(entry_reader, uncertainty);
    entry_reader.finish();
    if (!tire.values.load_map.empty() && entry.load_N <= tire.values.load_map.back().load_N) {
      throw entry_reader.problem("load_N", "loads of the map must increase",
                                 fmt::format("more than {} N", tire.values.load_map.back().load_N));
    }
    check_loss(*entry_table, "[[rolling_resistance.load_map]]", entry, tire.values.rolling_resistance.lowest_speed_m_s);
    tire.values.load_map.push_back(entry);
    tire.standard_uncertainties.load_map.push_back(uncertainty);
  }
}

void read_rig_thermal(const ConfigTable& thermal, TireFile& tire) {
  TableReader reader(thermal, "[thermal]");
  const ConfigTable* rigs = reader.table("rig");
  if (rigs == nullptr) return;
  TableReader rigs_reader(*rigs, "[thermal.rig]");
  for (const std::string& rig : rigs->keys()) {
    TableReader own(*rigs_reader.table(rig), fmt::format("[thermal.rig.{}]", rig));
    read_fields(own, tire.rig_thermal[rig]);
    own.finish();
  }
}

void read_iso_reference(TableReader& file, TireFile& tire) {
  const ConfigTable* table = file.table("iso_28580");
  if (table == nullptr) return;
  TableReader reader(*table, "[iso_28580]");
  Iso28580Reference reference;
  reference.rrc = reader.number({"rrc_N_per_kN", positive(), ""});
  reference.load_N = reader.number({"load_N", positive(), ""});
  reference.pressure_Pa = reader.number({"pressure_kPa", positive(), ""});
  reader.finish();
  tire.iso_28580 = reference;
}

void read_sweep_loads(TableReader& file, TireFile& tire) {
  const ConfigTable* table = file.table("load_sweep");
  if (table == nullptr) return;
  TableReader reader(*table, "[load_sweep]");
  tire.sweep_loads_N = reader.numbers_or({"loads_N", positive(), ""}, {});
  reader.finish();
}

void check_geometry(const ConfigTable& table, const TireGeometry<double>& geometry) {
  if (geometry.rim_diameter_m < geometry.outer_diameter_m) return;
  throw TableReader(table, "[geometry]")
      .problem("rim_diameter_m", "the rim is larger than the tire",
               fmt::format("less than outer_diameter_m = {}", geometry.outer_diameter_m));
}

InputError missing_table(const TireFile& tire, const char* table, const std::string& needed_by) {
  InputProblem problem;
  problem.what = fmt::format("tire '{}' has no table [{}], which {} needs", tire.name, table, needed_by);
  problem.file = tire.path;
  problem.allowed = fmt::format("a table [{}]", table);
  return InputError(problem);
}

}  // namespace

TireFile read_tire(const ConfigTable& config) {
  TireFile tire;
  tire.path = config.origin.file;
  TableReader file(config, "");
  check_format(file, kFormat, kFormatVersion);
  tire.name = file.text("name");
  tire.designation = file.text_or("designation", tire.name);
  if (!read_group(file, "geometry", tire.values.geometry)) throw file.problem("geometry", "missing table [geometry]");
  check_geometry(*file.table("geometry"), tire.values.geometry);
  tire.has_stiffness = read_group(file, "stiffness", tire.values.stiffness);
  tire.has_rolling_resistance = read_identified_group(file, "rolling_resistance", tire.values.rolling_resistance,
                                                      tire.standard_uncertainties.rolling_resistance, {"load_map"});
  if (tire.has_rolling_resistance) {
    const ConfigTable& table = *file.table("rolling_resistance");
    check_loss(table, "[rolling_resistance]", tire.values.rolling_resistance,
               tire.values.rolling_resistance.lowest_speed_m_s);
    read_load_map(table, tire);
  }
  tire.has_thermal =
      read_identified_group(file, "thermal", tire.values.thermal, tire.standard_uncertainties.thermal, {"rig"});
  if (tire.has_thermal) read_rig_thermal(*file.table("thermal"), tire);
  tire.has_constant =
      read_identified_group(file, "constant", tire.values.constant, tire.standard_uncertainties.constant);
  read_iso_reference(file, tire);
  read_sweep_loads(file, tire);
  file.finish();
  return tire;
}

TireParameters<double> TireFile::parameters_on(const std::string& rig_name, Baseline baseline) const {
  const bool combined = baseline == Baseline::kCombined;
  const std::string needed_by = combined ? "the combined model" : "baseline constant_rrc";
  if (!has_stiffness) throw missing_table(*this, "stiffness", "a rig");
  if (combined && !has_rolling_resistance) throw missing_table(*this, "rolling_resistance", needed_by);
  if (!has_thermal) throw missing_table(*this, "thermal", "a rig");
  if (!combined && !has_constant) throw missing_table(*this, "constant", needed_by);
  TireParameters<double> on_rig = values;
  const auto it = rig_thermal.find(rig_name);
  if (it == rig_thermal.end()) return on_rig;
  auto& thermal = on_rig.thermal;
  thermal.rest_conductance_W_per_K = it->second.rest_conductance_W_per_K.value_or(thermal.rest_conductance_W_per_K);
  thermal.speed_conductance_W_s_per_m_K =
      it->second.speed_conductance_W_s_per_m_K.value_or(thermal.speed_conductance_W_s_per_m_K);
  return on_rig;
}

TireParameters<double> TireFile::parameters_with_class_values(double load_N, double pressure_Pa) const {
  if (!has_constant) throw missing_table(*this, "constant", "baseline constant_rrc");
  TireParameters<double> filled = values;
  if (!has_stiffness) filled.stiffness = {220e3, 300.0, 75e3, 0.3, 1.0};
  if (!has_thermal) {
    constexpr double kSpecificHeat_J_per_kg_K = 1640.0;
    filled.thermal = {kSpecificHeat_J_per_kg_K * values.geometry.mass_kg, 95.0, 4.0, 12.0, 0.5, 1.4};
  }
  if (!has_rolling_resistance) {
    auto& law = filled.rolling_resistance;
    law.A0_N = values.constant.rrc * load_N;
    law.reference_load_N = load_N;
    law.reference_pressure_Pa = pressure_Pa;
    law.reference_drum_diameter_m = 2.0;
    law.pressure_exponent = 0.4;
  }
  return filled;
}

namespace {

/// Builds TOML lines "key = value   # note".
class TomlText {
 public:
  explicit TomlText(const std::map<std::string, std::string>& notes) : notes_(notes) {}

  void header(const std::string& header, const std::string& table) {
    text_ += fmt::format("\n{}\n", header);
    table_ = table;
  }
  void line(const std::string& key, const std::string& value) {
    const std::string assignment = fmt::format("{} = {}", key, value);
    const auto note = notes_.find(table_.empty() ? key : table_ + "." + key);
    text_ += note == notes_.end() ? assignment + "\n" : fmt::format("{:<36} # {}\n", assignment, note->second);
  }
  void number(const std::string& key, double si_value) {
    line(key, fmt::format("{:.10g}", unit_of_key(key).from_si(si_value)));
  }
  template <class Group>
  void group(const Group& values, const Group* uncertainties = nullptr) {
    std::vector<double> sd;
    if (uncertainties != nullptr)
      Group::visit(*uncertainties, [&sd](const Field&, const double& x) { sd.push_back(x); });
    std::size_t i = 0;
    Group::visit(values, [&](const Field& field, const double& value) {
      number(field.key, value);
      const std::string sd_key = std::string(field.key) + "_sd";
      if (i < sd.size() && sd[i] > 0.0) number(sd_key, sd[i]);
      ++i;
    });
  }
  std::string take() { return std::move(text_); }

 private:
  const std::map<std::string, std::string>& notes_;
  std::string text_;
  std::string table_;
};

void write_rig_thermal(TomlText& out, const std::map<std::string, RigThermal>& rigs) {
  for (const auto& [rig, at] : rigs) {
    const std::string table = "thermal.rig." + rig;
    out.header("[" + table + "]", table);
    RigThermal::visit(at, [&out](const Field& field, const std::optional<double>& value) {
      if (value.has_value()) out.number(field.key, *value);
    });
  }
}

}  // namespace

std::string write_tire(const TireFile& tire, const std::map<std::string, std::string>& notes) {
  TomlText out(notes);
  out.line("format", fmt::format("\"{}/{}\"", kFormat, kFormatVersion));
  out.line("name", "\"" + tire.name + "\"");
  out.line("designation", "\"" + tire.designation + "\"");
  out.header("[geometry]", "geometry");
  out.group(tire.values.geometry);
  if (tire.has_stiffness) {
    out.header("[stiffness]", "stiffness");
    out.group(tire.values.stiffness);
  }
  if (tire.has_rolling_resistance) {
    out.header("[rolling_resistance]", "rolling_resistance");
    out.group(tire.values.rolling_resistance, &tire.standard_uncertainties.rolling_resistance);
    for (std::size_t i = 0; i < tire.values.load_map.size(); ++i) {
      out.header("[[rolling_resistance.load_map]]", "rolling_resistance.load_map");
      out.group(tire.values.load_map[i], &tire.standard_uncertainties.load_map[i]);
    }
  }
  if (tire.has_thermal) {
    out.header("[thermal]", "thermal");
    out.group(tire.values.thermal, &tire.standard_uncertainties.thermal);
    write_rig_thermal(out, tire.rig_thermal);
  }
  if (tire.has_constant) {
    out.header("[constant]", "constant");
    out.group(tire.values.constant, &tire.standard_uncertainties.constant);
  }
  if (tire.iso_28580.has_value()) {
    out.header("[iso_28580]", "iso_28580");
    out.number("rrc_N_per_kN", tire.iso_28580->rrc);
    out.number("load_N", tire.iso_28580->load_N);
    out.number("pressure_kPa", tire.iso_28580->pressure_Pa);
  }
  if (!tire.sweep_loads_N.empty()) {
    out.header("[load_sweep]", "load_sweep");
    out.line("loads_N", fmt::format("[{:.10g}]", fmt::join(tire.sweep_loads_N, ", ")));
  }
  return out.take();
}

}  // namespace rollrig::models
