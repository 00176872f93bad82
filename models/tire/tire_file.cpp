#include "models/tire/tire_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cmath>

#include "models/tire/label_class.h"
#include "models/tire/tire_model.h"
#include "sim/core/error.h"
#include "sim/core/limits.h"

namespace rollrig::models {
namespace {

/// Reads a table; false where it is absent. Beside the values stand uncertainties where there is a place for them.
template <class Group>
bool read_group(TableReader& file, const std::string& name, Group& values, Group* uncertainties = nullptr,
                const char* other_key = "") {
  const ConfigTable* table = file.table(name);
  if (table == nullptr) return false;
  TableReader reader(*table, fmt::format("[{}]", name));
  read_fields(reader, values);
  if (uncertainties != nullptr) read_standard_uncertainties(reader, *uncertainties);
  reader.accept(other_key);
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

/// Both conductances, or neither, so that the rig's cooling gives them.
void check_conductances(const ConfigTable& thermal) {
  const std::vector<std::string> keys = thermal.keys();
  const auto has = [&keys](const char* key, const char* old_key) {
    return std::count(keys.begin(), keys.end(), key) + std::count(keys.begin(), keys.end(), old_key) > 0;
  };
  const bool at_rest = has("conductance_at_rest_W_per_K", "z_W_per_K");
  if (at_rest == has("conductance_per_speed_W_s_per_m_K", "f_W_s_per_m_K")) return;
  const char* missing = at_rest ? "conductance_per_speed_W_s_per_m_K" : "conductance_at_rest_W_per_K";
  throw TableReader(thermal, "[thermal]")
      .problem(missing, "missing key: one conductance stands without the other",
               "both, or neither where [tire_cooling] of the rig gives them");
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

/// The model and the table of its own numbers.
void read_model(TableReader& file, TireFile& tire) {
  const TireModel& model =
      find_tire_model(file.text_or("model", default_tire_model().info.id, list_ids(all_tire_models())));
  const std::string& table = model.info.id;
  for (OwnParameters<double>* own : {&tire.values.own, &tire.standard_uncertainties.own}) {
    *own = {&model, std::vector<double>(model.info.parameters.size())};
  }
  if (model.info.parameters.empty()) return;
  if (!read_group(file, table, tire.values.own, &tire.standard_uncertainties.own)) {
    throw file.problem(table, fmt::format("missing table [{0}], which model \"{0}\" needs", table));
  }
  if (model.info.find_mistake == nullptr) return;
  if (const auto mistake = model.info.find_mistake(tire.values.own)) {
    throw TableReader(*file.table(table), fmt::format("[{}]", table))
        .problem(mistake->key, mistake->what, mistake->allowed);
  }
}

TireBasis read_basis(TableReader& file) {
  const std::string word = file.text_or("basis", "", {"measured", "class"});
  if (word.empty()) return TireBasis::kUnknown;
  return word == "measured" ? TireBasis::kMeasured : TireBasis::kClass;
}

void read_validity(TableReader& file, TireFile& tire) {
  TireValidity validity;
  if (!read_group(file, "validity", validity)) return;
  const auto check = [&](const char* highest_key, double lowest, double highest, const char* lowest_key) {
    if (highest > lowest) return;
    throw TableReader(*file.table("validity"), "[validity]")
        .problem(highest_key, "the range is empty", fmt::format("more than {}", lowest_key));
  };
  check("highest_load_N", validity.lowest_load_N, validity.highest_load_N, "lowest_load_N");
  check("highest_temperature_degC", validity.lowest_K, validity.highest_K, "lowest_temperature_degC");
  tire.validity = validity;
}

/// [iso_28580]; what is absent there is that of the class, where the file has one.
void read_iso_28580(TableReader& file, TireFile& tire) {
  const ConfigTable* table = file.table("iso_28580");
  if (table == nullptr) return;
  TableReader reader(*table, "[iso_28580]");
  Iso28580Reference iso;
  if (tire.service.has_value()) {
    const IsoTestOfClass of_class = find_iso_test(*tire.service, tire.values.geometry.rim_diameter_m);
    const double missing = std::nan("");
    iso = {missing,
           of_class.load_N,
           of_class.pressure_Pa.value_or(missing),
           of_class.warm_up_s,
           of_class.ambient_coefficient_per_K,
           of_class.speed_m_s,
           of_class.soak_s};
    if (!of_class.pressure_Pa.has_value() && !reader.has("pressure_kPa")) {
      throw reader.problem("pressure_kPa",
                           fmt::format("missing key: the pressure of the test of a tire of class {} is that of its "
                                       "maximum load",
                                       name_of(tire.service->tire_class)),
                           "pressure_kPa here, or maximum_load_pressure_kPa in [service_description]");
    }
    Iso28580Reference::visit(iso, [&](const Field& field, double& member) {
      member = std::isnan(member) ? reader.number(field) : reader.number_or_none(field).value_or(member);
    });
  } else {
    read_fields(reader, iso);
  }
  reader.finish();
  if (const auto mistake = find_rrc_mistake(iso.rrc)) {
    throw reader.problem("rrc_N_per_kN", mistake->what, mistake->allowed);
  }
  tire.iso_28580 = iso;
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
  return InputError({fmt::format("tire '{}' has no table [{}], which {} needs", tire.name, table, needed_by), tire.path,
                     0, "", "", fmt::format("a table [{}]", table), ""});
}

bool gives_conductances(const TireThermalParameters<double>& thermal) {
  return thermal.rest_conductance_W_per_K > 0.0 || thermal.speed_conductance_W_s_per_m_K > 0.0;
}

InputError no_conductances(const TireFile& tire, const std::string& rig) {
  const std::string where = rig.empty() ? "the road" : fmt::format("rig '{}'", rig);
  return InputError(
      {fmt::format("tire '{}' has no conductance above 0, and {} has no [tire_cooling] that is used", tire.name, where),
       tire.path, 0, "[thermal] conductance_at_rest_W_per_K", "",
       "a conductance above 0, or none in the tire file and a table [tire_cooling] in the rig file", ""});
}

}  // namespace

TireFile read_tire(const ConfigTable& config) {
  TireFile tire;
  tire.path = config.origin.file;
  TableReader file(config, "");
  check_format(file, kTireFormat, kTireFormatVersion);
  tire.name = file.text("name");
  tire.designation = file.text_or("designation", tire.name);
  tire.basis = read_basis(file);
  read_model(file, tire);
  if (!read_group(file, "geometry", tire.values.geometry)) throw file.problem("geometry", "missing table [geometry]");
  check_geometry(*file.table("geometry"), tire.values.geometry);
  tire.has_stiffness = read_group(file, "stiffness", tire.values.stiffness);
  TireParameters<double>& sd = tire.standard_uncertainties;
  const bool has_lines = tire.values.model().info.has_speed_lines;
  if (has_lines) {
    tire.has_rolling_resistance =
        read_group(file, "rolling_resistance", tire.values.rolling_resistance, &sd.rolling_resistance, "load_map");
  } else {
    LossReference<double>& reference = tire.values.rolling_resistance;
    LossReference<double>& reference_sd = sd.rolling_resistance;
    tire.has_rolling_resistance = read_group(file, "rolling_resistance", reference, &reference_sd);
  }
  if (tire.has_rolling_resistance && has_lines) {
    const ConfigTable& table = *file.table("rolling_resistance");
    check_loss(table, "[rolling_resistance]", tire.values.rolling_resistance,
               tire.values.rolling_resistance.lowest_speed_m_s);
    read_load_map(table, tire);
  }
  tire.has_thermal = read_group(file, "thermal", tire.values.thermal, &sd.thermal, "rig");
  if (tire.has_thermal) {
    check_conductances(*file.table("thermal"));
    read_rig_thermal(*file.table("thermal"), tire);
  }
  tire.has_constant = read_group(file, "constant", tire.values.constant, &sd.constant);
  if (const ConfigTable* service = file.table("service_description")) tire.service = read_service_description(*service);
  read_iso_28580(file, tire);
  read_validity(file, tire);
  read_sweep_loads(file, tire);
  tire.correlation = read_correlation(file, tire);
  file.finish();
  return tire;
}

const TireModel& TireFile::model(Baseline baseline) const {
  return baseline == Baseline::kConstantRrc ? find_tire_model(kConstantModel) : values.model();
}

double calc_outer_area_m2(const TireGeometry<double>& geometry) {
  using boost::math::constants::pi;
  const double outer_m = geometry.outer_diameter_m;
  const double rim_m = geometry.rim_diameter_m;
  return pi<double>() * (0.5 * (outer_m * outer_m - rim_m * rim_m) + outer_m * geometry.section_width_m);
}

TireParameters<double> TireFile::parameters_on(const CoolingRig& rig, Baseline baseline) const {
  const TireModelInfo& info = model(baseline).info;
  if (!has_stiffness) throw missing_table(*this, "stiffness", "a rig");
  for (const auto& [table, is_there] : {std::pair{"rolling_resistance", has_rolling_resistance},
                                        std::pair{"thermal", has_thermal}, std::pair{"constant", has_constant}}) {
    if (info.uses(table) && !is_there) throw missing_table(*this, table, fmt::format("tire model {}", info.id));
  }
  TireParameters<double> on_rig = values;
  if (baseline == Baseline::kConstantRrc) on_rig.own = {&model(baseline), {}};
  auto& thermal = on_rig.thermal;
  const auto found = rig_thermal.find(rig.name);
  const RigThermal own = found != rig_thermal.end() ? found->second : RigThermal{};
  if (info.uses("thermal") && !gives_conductances(thermal) && rig.cooling.is_given()) {
    const double area_m2 = calc_outer_area_m2(values.geometry);
    thermal.rest_conductance_W_per_K = area_m2 * rig.cooling.at_rest_W_per_m2_K;
    thermal.speed_conductance_W_s_per_m_K = area_m2 * rig.cooling.per_speed_W_s_per_m3_K;
  }
  thermal.rest_conductance_W_per_K = own.rest_conductance_W_per_K.value_or(thermal.rest_conductance_W_per_K);
  thermal.speed_conductance_W_s_per_m_K =
      own.speed_conductance_W_s_per_m_K.value_or(thermal.speed_conductance_W_s_per_m_K);
  if (info.uses("thermal") && !gives_conductances(thermal)) throw no_conductances(*this, rig.name);
  return on_rig;
}

TireParameters<double> TireFile::standard_uncertainties_on(const CoolingRig& rig) const {
  TireParameters<double> sd = standard_uncertainties;
  if (!gives_conductances(values.thermal)) {
    const double area_m2 = calc_outer_area_m2(values.geometry);
    sd.thermal.rest_conductance_W_per_K = area_m2 * rig.cooling_sd.at_rest_W_per_m2_K;
    sd.thermal.speed_conductance_W_s_per_m_K = area_m2 * rig.cooling_sd.per_speed_W_s_per_m3_K;
  }
  const auto found = rig_thermal.find(rig.name);
  if (found == rig_thermal.end()) return sd;
  const RigThermal& own = found->second;
  if (own.rest_conductance_W_per_K.has_value()) {
    sd.thermal.rest_conductance_W_per_K = own.rest_conductance_sd_W_per_K.value_or(sd.thermal.rest_conductance_W_per_K);
  }
  if (own.speed_conductance_W_s_per_m_K.has_value()) {
    sd.thermal.speed_conductance_W_s_per_m_K =
        own.speed_conductance_sd_W_s_per_m_K.value_or(sd.thermal.speed_conductance_W_s_per_m_K);
  }
  return sd;
}

bool TireFile::gives_uncertainty_of(bool heat_balance) const {
  bool is_given = false;
  TireParameters<double>::visit_all(standard_uncertainties, [&](const std::string& table, const Field&, double sd) {
    if ((table == "thermal") == heat_balance && sd > 0.0) is_given = true;
  });
  return is_given || (heat_balance && std::any_of(rig_thermal.begin(), rig_thermal.end(), [](const auto& entry) {
                        return entry.second.rest_conductance_sd_W_per_K.has_value() ||
                               entry.second.speed_conductance_sd_W_s_per_m_K.has_value();
                      }));
}

std::vector<std::string> TireFile::list_class_doubts() const {
  if (!service.has_value()) return {};
  std::vector<std::string> doubts;
  const char* name = name_of(service->tire_class);
  if (service->tire_class == TireClass::kC1) {
    const bool is_commercial = designation.rfind("LT", 0) == 0 || (!designation.empty() && designation.back() == 'C');
    if (is_commercial) {
      doubts.push_back(
          fmt::format("class C1: the designation {} is one of commercial vehicles, class C2 or C3", designation));
    }
  }
  if (const auto doubt = doubt_class_by_index(*service)) doubts.push_back(*doubt);
  // Assumed: 400 kPa. Truck tires carry their load at 500 kPa and more; their pressures in psi are 80 to 130
  constexpr double kLeastOfTruck_Pa = 400e3;
  const double pressure_Pa = service->maximum_load_pressure_Pa.value_or(kLeastOfTruck_Pa);
  if (service->tire_class == TireClass::kC3 && pressure_Pa < kLeastOfTruck_Pa) {
    doubts.push_back(
        fmt::format("[service_description] maximum_load_pressure_kPa = {:g} is low for class C3: is it in psi?",
                    pressure_Pa * 1e-3));
  }
  if (!iso_28580.has_value()) return doubts;
  if (const auto doubt = doubt_class_by_rrc(service->tire_class, iso_28580->rrc, service->is_severe_snow)) {
    doubts.push_back("[iso_28580] rrc_N_per_kN: " + *doubt);
  }
  constexpr double kSame = 0.01;  // Assumed: files round load, pressure and speed
  const IsoTestOfClass of_class = find_iso_test(*service, values.geometry.rim_diameter_m);
  const auto compare = [&](const char* key, double stated_SI, double asked_SI, double tolerance = kLimitTolerance) {
    if (std::abs(stated_SI / asked_SI - 1.0) <= tolerance) return;
    const Unit unit = unit_of_key(key);
    doubts.push_back(fmt::format("[iso_28580] {} = {:.6g}, but the test of class {} asks for {:.6g} with load index {}",
                                 key, unit.from_si(stated_SI), name, unit.from_si(asked_SI), service->load_index));
  };
  const bool is_index_known = service->load_index != 0;  // rollrig label may have none
  if (is_index_known) compare("load_N", iso_28580->load_N, of_class.load_N, kSame);
  if (of_class.pressure_Pa.has_value()) compare("pressure_kPa", iso_28580->pressure_Pa, *of_class.pressure_Pa, kSame);
  compare("speed_km_h", iso_28580->speed_m_s, of_class.speed_m_s, kSame);
  compare("warm_up_min", iso_28580->warm_up_s, of_class.warm_up_s);
  compare("ambient_coefficient_per_degC", iso_28580->ambient_coefficient_per_K, of_class.ambient_coefficient_per_K);
  return doubts;
}

std::optional<std::string> TireFile::warn_of_conductances(const CoolingRig& rig) const {
  const auto own = rig_thermal.find(rig.name);
  if (own != rig_thermal.end() &&
      own->second.rest_conductance_W_per_K.has_value() != own->second.speed_conductance_W_s_per_m_K.has_value()) {
    return fmt::format("[thermal.rig.{}] of tire '{}' gives one conductance; the other one is that of {}", rig.name,
                       name, gives_conductances(values.thermal) ? "[thermal]" : "[tire_cooling] of the rig");
  }
  if (rig_thermal.empty() || rig_thermal.count(rig.name) > 0 || !gives_conductances(values.thermal))
    return std::nullopt;
  std::vector<std::string> named;
  for (const auto& [named_rig, conductances] : rig_thermal) named.push_back(named_rig);
  return fmt::format(
      "tire '{}' has conductances for {}, and none for rig '{}': those of its [thermal] are used, and its "
      "temperature may be several degC off",
      name, fmt::join(named, ", "), rig.name);
}

TireParameters<double> TireFile::parameters_with_class_values(double load_N, double pressure_Pa) const {
  if (!has_constant) throw missing_table(*this, "constant", "baseline constant_rrc");
  TireParameters<double> filled = values;
  filled.own = {&find_tire_model(kConstantModel), {}};
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

}  // namespace rollrig::models
