#include "scenarios/scaffold/class_tire.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <sstream>

#include <fmt/format.h>
#include <boost/algorithm/string/trim.hpp>

#include "estimation/loss_conversion.h"
#include "models/reference_conditions.h"
#include "models/tire/own_number.h"
#include "scenarios/scaffold/iso_test.h"
#include "scenarios/scaffold/new_machine.h"
#include "scenarios/scaffold/tire_size.h"
#include "sim/core/assets.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/text.h"
#include "tables/tir_file.h"

namespace rollrig::scenarios {
namespace {

/// What a class has of its own.
struct ClassValues {
  const char* name;
  const char* base;  // asset
  double iso_load_share;
  const char* iso_load_note;
  double lowest_load_share;  // [validity]
  double highest_speed_km_h;
  std::array<double, 3> sweep_shares;
  double fall_per_degC;   // 0: of the base
  double mass_kg_per_m2;  // of the outer area; 0: of the base
};

const std::vector<ClassValues>& class_values() {
  static const std::vector<ClassValues> all{
      {"C1", "c1_205_55r16", 0.80, "§3.2.3.1: 80 % of the load of the index", 0.4, 160.0, {0.8, 0.7, 0.6}, 0.0, 0.0},
      {"C2",
       "c1_205_55r16",
       0.85,
       "Assumed: ISO 28580 for class C2, not read: 85 % of the load of the index",
       0.4,
       140.0,
       {0.85, 0.7, 0.55},
       0.0190,
       14.0},
      {"C3",
       "c3_315_80r22_5",
       0.85,
       "Assumed: ISO 28580 for class C3, not read: 85 % of the load of the index",
       0.33,
       110.0,
       {0.85, 0.68, 0.51},
       0.0,
       0.0},
  };
  return all;
}

const ClassValues& find_class(const std::string& name) {
  for (const ClassValues& one : class_values()) {
    if (name == one.name) return one;
  }
  InputProblem problem = unknown_name("class", name, {"C1", "C2", "C3"});
  problem.file = "command line";
  problem.key = "--class";
  throw InputError(problem);
}

void require_number(double value, const Range& range, const char* option, const char* unit) {
  if (std::isfinite(value) && range.contains(value)) return;
  throw InputError({fmt::format("{} is out of range", option), "command line", 0, option, fmt::format("{:g}", value),
                    fmt::format("a number {} in {}", range.to_string(), unit), ""});
}

/// Gauge pressure of the test.
double find_iso_pressure_kPa(const NewTireOptions& options, const std::string& tire_class) {
  if (options.pressure_kPa.has_value()) {
    require_number(*options.pressure_kPa, between(100.0, 1000.0), "--pressure", "kPa");
    return *options.pressure_kPa;
  }
  if (tire_class == "C1") return options.is_reinforced ? 250.0 : 210.0;
  throw InputError({fmt::format("the pressure of the test of a tire of class {} is that of its maximum load, which its "
                                "sidewall states",
                                tire_class),
                    "command line", 0, "--pressure", "", "--pressure NUMBER, in kPa, gauge", ""});
}

/// A number that was estimated, without digits that nobody knows.
double round_estimate(double value) {
  constexpr double kDigits = 4.0;
  const double step = std::pow(10.0, std::floor(std::log10(value)) + 1.0 - kDigits);
  return step * std::round(value / step);
}

/// A number of the file and what is known of it.
class NumberSetter {
 public:
  NumberSetter(ClassTire& made, const models::TireFile& base) : made_(made), base_(base) {}

  void set(const char* key, double& number, double value, const std::string& note) {
    number = value;
    made_.notes[key] = note;
  }
  /// In proportion to `ratio` of the reference tire.
  void scale(const char* key, double& number, double ratio, const std::string& to) {
    set(key, number, round_estimate(number * ratio),
        fmt::format("Assumed: that of {}, in proportion to {}", base_.name, to));
  }
  void set_own(const char* key, double value, const std::string& note) {
    set(fmt::format("bounded.{}", key).c_str(), *models::find_own_number(made_.tire.values.own, key), value, note);
  }
  void set_own_sd(const char* key, double value, const std::string& note) {
    *models::find_own_number(made_.tire.standard_uncertainties.own, key) = value;
    made_.notes[fmt::format("bounded.{}_sd", key)] = note;
  }

 private:
  ClassTire& made_;
  const models::TireFile& base_;
};

void set_geometry(const TireSize& size, const ClassValues& values, ClassTire& made, NumberSetter& numbers) {
  models::TireGeometry<double>& geometry = made.tire.values.geometry;
  const models::TireGeometry<double> base = geometry;
  numbers.set("geometry.outer_diameter_m", geometry.outer_diameter_m, size.outer_diameter_m,
              "Designation: rim diameter + 2 (aspect ratio) (section width)");
  numbers.set("geometry.section_width_m", geometry.section_width_m, size.section_width_m, "Designation");
  numbers.set("geometry.rim_diameter_m", geometry.rim_diameter_m, size.rim_diameter_m, "Designation");
  const double area_m2 = models::calc_outer_area_m2(geometry);
  if (values.mass_kg_per_m2 > 0.0) {
    numbers.set("geometry.mass_kg", geometry.mass_kg, round_estimate(values.mass_kg_per_m2 * area_m2),
                fmt::format("Assumed: {:g} kg/m2 of the outer area, as tires of vans", values.mass_kg_per_m2));
  } else {
    numbers.scale("geometry.mass_kg", geometry.mass_kg, area_m2 / models::calc_outer_area_m2(base), "the outer area");
  }
  numbers.scale("geometry.wheel_mass_kg", geometry.wheel_mass_kg, geometry.rim_diameter_m / base.rim_diameter_m,
                "the rim's diameter");
  const double inertia_ratio =
      geometry.mass_kg / base.mass_kg * std::pow(geometry.outer_diameter_m / base.outer_diameter_m, 2.0);
  numbers.scale("geometry.spin_inertia_kg_m2", geometry.spin_inertia_kg_m2, inertia_ratio, "mass and diameter squared");
}

void set_stiffness(const models::TireFile& base, double iso_load_N, ClassTire& made, NumberSetter& numbers) {
  models::TireStiffness<double>& stiffness = made.tire.values.stiffness;
  const auto side_m = [](const models::TireGeometry<double>& geometry) {
    return 0.5 * (geometry.outer_diameter_m - geometry.rim_diameter_m);
  };
  const double load_ratio = iso_load_N / base.iso_28580->load_N;
  const double side_ratio = side_m(made.tire.values.geometry) / side_m(base.values.geometry);
  numbers.scale("stiffness.vertical_N_per_m", stiffness.vertical_N_per_m, load_ratio / side_ratio,
                "load over section height");
  numbers.scale("stiffness.slip_stiffness_N", stiffness.slip_stiffness_N, load_ratio, "the load");
  made.notes["stiffness.friction_coefficient"] = "Assumed: dry steel";
}

void set_heat(const models::TireFile& base, double pressure_Pa, ClassTire& made, NumberSetter& numbers) {
  constexpr double kPerMass_J_per_kg_K = 1640.0;
  constexpr double kSpread = 0.3;
  models::TireThermalParameters<double>& thermal = made.tire.values.thermal;
  const models::TireGeometry<double>& geometry = made.tire.values.geometry;
  numbers.set("thermal.heat_capacity_J_per_K", thermal.heat_capacity_J_per_K,
              round_estimate(kPerMass_J_per_kg_K * geometry.mass_kg),
              "Assumed: 1640 J/(kg K) of the mass, as the prior of the calibrated tires");
  made.tire.standard_uncertainties.thermal.heat_capacity_J_per_K =
      round_estimate(kSpread * thermal.heat_capacity_J_per_K);
  made.notes["thermal.heat_capacity_J_per_K_sd"] =
      "Assumed: 30 %; the calibrated tires have 1940 to 2640 J/(kg K) of their masses";
  const auto cavity = [](const models::TireGeometry<double>& of) {  // in proportion to the volume
    return of.section_width_m * (std::pow(of.outer_diameter_m, 2.0) - std::pow(of.rim_diameter_m, 2.0));
  };
  const double gas_ratio = cavity(geometry) / cavity(base.values.geometry) * (pressure_Pa + kStandardAtmosphere_Pa) /
                           (base.iso_28580->pressure_Pa + kStandardAtmosphere_Pa);
  numbers.scale("thermal.gas_heat_capacity_J_per_K", thermal.gas_heat_capacity_J_per_K, gas_ratio,
                "cavity and absolute pressure");
  const double area_ratio = models::calc_outer_area_m2(geometry) / models::calc_outer_area_m2(base.values.geometry);
  numbers.scale("thermal.H_gas_W_per_K", thermal.H_gas_W_per_K, area_ratio, "the outer area");
  const double conductance_W_per_K =
      round_estimate(*models::find_own_number(base.values.own, "conductance_W_per_K") * area_ratio);
  numbers.set_own("conductance_W_per_K", conductance_W_per_K,
                  fmt::format("Assumed: that of {}, in proportion to the outer area", base.name));
  numbers.set_own_sd("conductance_W_per_K", 0.5 * conductance_W_per_K, "Assumed: half of the value, as a40");
}

void set_law(const NewTireOptions& options, const ClassValues& values, ClassTire& made, NumberSetter& numbers) {
  constexpr double kUsualSd_N_per_kN = 0.15;
  const double sd_N_per_kN = options.rrc_sd_N_per_kN.value_or(kUsualSd_N_per_kN);
  const double loss_N = made.tire.iso_28580->rrc * made.tire.iso_28580->load_N * 1.5;  // a first value
  numbers.set_own("loss_N", loss_N, "Calibrated: [iso_28580] in the virtual test");
  numbers.set_own_sd("loss_N", loss_N * sd_N_per_kN / options.rrc_N_per_kN,
                     options.rrc_sd_N_per_kN.has_value()
                         ? fmt::format("Given: {:g} N/kN of RRc", sd_N_per_kN)
                         : "Assumed: 0.15 N/kN of RRc, as between two laboratories and two tires of a kind");
  if (values.fall_per_degC > 0.0) {
    numbers.set_own("fall_per_degC", values.fall_per_degC,
                    "Calibrated: K_t = 0.010 of class C2 in the virtual test (UN R117, Annex 6, 6.2)");
  }
}

/// Load index and speed symbol of the options and the size. Throws InputError where they contradict each other.
ParsedServiceDescription find_service_description(const NewTireOptions& options, const TireSize& size) {
  const ParsedServiceDescription of_size =
      size.load_index.empty() ? ParsedServiceDescription{}
                              : parse_service_description(size.load_index + size.speed_symbol, "--size");
  ParsedServiceDescription found = options.load_index.empty() ? of_size : parse_service_description(options.load_index);
  const bool has_both = of_size.load_index > 0 && !options.load_index.empty();
  const bool is_other_symbol =
      !found.speed_symbol.empty() && !of_size.speed_symbol.empty() && found.speed_symbol != of_size.speed_symbol;
  const bool is_other_dual = found.dual_index > 0 && of_size.dual_index > 0 && found.dual_index != of_size.dual_index;
  if (has_both && (found.load_index != of_size.load_index || is_other_dual || is_other_symbol)) {
    const std::string own = size.load_index + size.speed_symbol;
    throw InputError({fmt::format("the size has the load index {}", own), "command line", 0, "--load-index",
                      options.load_index, fmt::format("{}, or no --load-index", own), ""});
  }
  if (found.speed_symbol.empty()) found.speed_symbol = of_size.speed_symbol;
  found.speed_symbol = choose_speed_symbol(options.speed_symbol, found);
  return found;
}

/// [service_description], where class, load index and speed symbol are known as far as the class needs them.
void set_service(const NewTireOptions& options, const ParsedServiceDescription& description, ClassTire& made) {
  models::ServiceDescription service;
  service.tire_class = *models::find_class_named(made.tire_class);
  service.load_index = description.load_index;
  service.speed_symbol = description.speed_symbol;
  service.is_reinforced = options.is_reinforced && service.tire_class == models::TireClass::kC1;
  if (options.pressure_kPa.has_value()) service.maximum_load_pressure_Pa = 1e3 * *options.pressure_kPa;
  if (service.tire_class == models::TireClass::kC1) service.maximum_load_pressure_Pa.reset();
  made.service = service;
  made.tire.service.reset();  // that of the reference tire
  if (const auto doubt = models::doubt_class_by_index(service)) made.warnings.push_back(*doubt);
  if (service.speed_symbol.empty() && service.tire_class == models::TireClass::kC3) return;
  if (const auto mistake = models::find_class_mistake(service)) {
    throw InputError({mistake->what, "command line", 0, "--class", made.tire_class, mistake->allowed, ""});
  }
  made.tire.service = service;
  made.notes["service_description.class"] = options.tire_class.empty() ? "Assumed by size and load index" : "Given";
  made.notes["service_description.load_index"] = "Given";
  made.notes["service_description.speed_symbol"] = "Given";
  made.notes["service_description.reinforced"] = "Given";
  made.notes["service_description.maximum_load_pressure_kPa"] = "Given, as the pressure of the test";
}

std::string rrc_note(const NewTireOptions& options) {
  if (options.tir.empty()) return "Given";
  return fmt::format("Rolling coefficients of {}, at 80 km/h, from flat to the 2 m drum by (3.1)",
                     std::filesystem::path(options.tir).filename().string());
}

void set_tests(const NewTireOptions& options, const ClassValues& values, double pressure_kPa, ClassTire& made,
               NumberSetter& numbers) {
  models::TireFile& tire = made.tire;
  models::Iso28580Reference& iso = *tire.iso_28580;
  const double capacity_N = made.load_capacity_N;
  const std::string pressure_note =
      options.pressure_kPa.has_value()
          ? "Given"
          : fmt::format("§3.2.3.1 step 2: {} tires", options.is_reinforced ? "reinforced" : "standard");
  numbers.set("iso_28580.rrc_N_per_kN", iso.rrc, options.rrc_N_per_kN * 1e-3, rrc_note(options));
  numbers.set("iso_28580.load_N", iso.load_N, std::round(values.iso_load_share * capacity_N), values.iso_load_note);
  numbers.set("iso_28580.pressure_kPa", iso.pressure_Pa, pressure_kPa * 1e3, pressure_note);
  const models::IsoTestOfClass test = models::find_iso_test(made.service, tire.values.geometry.rim_diameter_m);
  iso.soak_s = test.soak_s;
  numbers.set("iso_28580.warm_up_min", iso.warm_up_s, test.warm_up_s,
              "Assumed: ISO 28580, table of warm-up times, as other publications cite it");
  numbers.set("iso_28580.ambient_coefficient_per_degC", iso.ambient_coefficient_per_K, test.ambient_coefficient_per_K,
              "UN R117, Annex 6, 6.2");
  numbers.set("iso_28580.speed_km_h", iso.speed_m_s, test.speed_m_s,
              "Assumed: UN R117, Annex 6, test speeds, as other publications cite them");
  auto& reference = tire.values.rolling_resistance;
  numbers.set("rolling_resistance.reference_load_N", reference.reference_load_N, iso.load_N, "as [iso_28580]");
  numbers.set("rolling_resistance.reference_pressure_kPa", reference.reference_pressure_Pa, iso.pressure_Pa,
              "as [iso_28580]");
  models::TireValidity& validity = *tire.validity;
  numbers.set("validity.highest_speed_km_h", validity.highest_speed_m_s, values.highest_speed_km_h / kKmhPerMs,
              "Assumed: where its class is used");
  numbers.set("validity.lowest_load_N", validity.lowest_load_N, std::round(values.lowest_load_share * capacity_N),
              fmt::format("Assumed: {:.0f} % of the load of the index", 100.0 * values.lowest_load_share));
  numbers.set("validity.highest_load_N", validity.highest_load_N, std::round(capacity_N), "the load of the index");
  tire.sweep_loads_N.clear();
  for (const double share : values.sweep_shares) tire.sweep_loads_N.push_back(std::round(share * capacity_N));
  made.notes["load_sweep.loads_N"] =
      fmt::format("Assumed: {:.0f}, {:.0f} and {:.0f} % of the load of the index", 100.0 * values.sweep_shares[0],
                  100.0 * values.sweep_shares[1], 100.0 * values.sweep_shares[2]);
}

std::string make_tire_name(const TireSize& size, const std::string& load_index) {
  std::string name;
  for (const char c : size.designation + "_" + load_index) {
    if (c != ' ') name += (c == '/' || c == '.') ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return name;
}

const Range kRrcs_N_per_kN = between(2.0, 30.0);  // Assumed: of any tire

void require_options(const NewTireOptions& options) {
  if (options.tir.empty()) {
    if (options.rrc_N_per_kN == 0.0) {
      throw InputError({"the RRc is missing or 0", "command line", 0, "--rrc", "",
                        fmt::format("{} N/kN; or --tir with a tire property file", kRrcs_N_per_kN.to_string()), ""});
    }
    require_number(options.rrc_N_per_kN, kRrcs_N_per_kN, "--rrc", "N/kN");
  } else if (options.rrc_N_per_kN != 0.0) {
    throw InputError({"the property file gives the RRc", "command line", 0, "--rrc",
                      fmt::format("{:g}", options.rrc_N_per_kN), "--rrc or --tir, not both", ""});
  }
  if (options.rrc_sd_N_per_kN.has_value()) {
    require_number(*options.rrc_sd_N_per_kN, Range{0.0, 5.0, true, false}, "--rrc-sd", "N/kN");
  }
}

/// RRc of the standard's test by the coefficients of a property file, rounded to 0.001 N/kN.
double find_tir_rrc_N_per_kN(const tables::TirFile& tir, double load_N, double pressure_kPa) {
  constexpr double kIsoCurvature_per_m = 1.0;  // of the 2 m drum
  const double flat_N =
      tables::calc_rolling_resistance_N(tir, load_N, 1e3 * pressure_kPa, models::get_reference_speed_m_s<double>());
  LossConditions flat, drum;
  flat.drum_curvature_per_m = 0.0;
  drum.drum_curvature_per_m = kIsoCurvature_per_m;
  flat.tire_diameter_m = drum.tire_diameter_m = 2.0 * tir.radius_m;
  const double rrc_N_per_kN = 1e3 * flat_N * estimation::convert_loss(flat, drum).force_factor / load_N;
  if (kRrcs_N_per_kN.contains(rrc_N_per_kN)) return std::round(1e3 * rrc_N_per_kN) / 1e3;
  throw InputError({"the property file has the rolling resistance of no tire", tir.path, 0, "QSY1",
                    fmt::format("RRc {:.3g} N/kN in the test of ISO 28580", rrc_N_per_kN),
                    fmt::format("{} N/kN; or --rrc in place of --tir", kRrcs_N_per_kN.to_string()), ""});
}

}  // namespace

std::map<std::string, std::string> read_comments(const std::string& toml) {
  std::map<std::string, std::string> comments;
  std::istringstream in(toml);
  std::string table;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line.front() == '[') {
      table = line.substr(1, line.find(']') - 1);
      continue;
    }
    const std::size_t equals = line.find('=');
    const std::size_t hash = line.find('#', equals == std::string::npos ? 0 : equals);
    if (equals == std::string::npos || hash == std::string::npos || line.front() == '#') continue;
    const std::string key = boost::algorithm::trim_copy(line.substr(0, equals));
    comments[table.empty() ? key : table + "." + key] = boost::algorithm::trim_copy(line.substr(hash + 1));
  }
  return comments;
}

ClassTire make_class_tire(const NewTireOptions& given) {
  NewTireOptions options = given;
  require_options(options);
  const TireSize size = parse_tire_size(options.size);
  const std::string load_index = options.load_index.empty() ? size.load_index : options.load_index;
  if (load_index.empty()) {
    throw InputError({"the size does not tell the load index", "command line", 0, "--load-index", "",
                      "--load-index NUMBER, as on the sidewall behind the size", ""});
  }
  const ParsedServiceDescription description = find_service_description(options, size);
  require_plain_name(options.name);
  ClassTire made;
  made.load_capacity_N = find_load_capacity_N(load_index);
  made.tire_class = options.tire_class.empty() ? find_tire_class(size, description) : options.tire_class;
  made.class_reason = options.tire_class.empty() ? "assumed by size and load index" : "given";
  const ClassValues& values = find_class(made.tire_class);
  const double pressure_kPa = find_iso_pressure_kPa(options, made.tire_class);
  if (!options.tir.empty()) {
    const tables::TirFile tir = tables::read_tir(options.tir);
    made.warnings = tir.warnings;
    options.rrc_N_per_kN =
        find_tir_rrc_N_per_kN(tir, std::round(values.iso_load_share * made.load_capacity_N), pressure_kPa);
  }
  made.base = values.base;
  const std::string base_file = find_asset("tires", values.base);
  const models::TireFile base = models::read_tire(read_config(base_file));
  made.tire = base;
  made.notes = read_comments(read_text_file(base_file));
  made.tire.name = options.name.empty() ? make_tire_name(size, load_index) : options.name;
  made.tire.designation = size.designation;
  made.tire.basis = models::TireBasis::kClass;
  NumberSetter numbers(made, base);
  set_service(options, description, made);
  if (const auto doubt = doubt_class_by_size(made.tire_class, size.is_commercial, description)) {
    made.warnings.push_back(*doubt);
  }
  set_geometry(size, values, made, numbers);
  set_tests(options, values, pressure_kPa, made, numbers);
  set_stiffness(base, made.tire.iso_28580->load_N, made, numbers);
  set_heat(base, made.tire.iso_28580->pressure_Pa, made, numbers);
  set_law(options, values, made, numbers);
  scale_to_iso_rrc(made.tire);
  return made;
}

std::string write_class_tire(const ClassTire& made) {
  const std::string head = fmt::format(
      "A tire of class {}, {}, made by rollrig new tire: values of the reference tire {} of rollrig, in proportion to "
      "size and load, scaled to an RRc of {:g} N/kN. Every number cites its source or says \"Assumed:\"; the comments "
      "are "
      "explained in that file. \"Given\" is what was given to the command.",
      made.tire_class, made.tire.designation, made.base, 1e3 * made.tire.iso_28580->rrc);
  std::istringstream lines(wrap(head, 0, 110));
  std::string text;
  for (std::string line; std::getline(lines, line);) text += "# " + line + "\n";
  return text + models::write_tire(made.tire, made.notes);
}

}  // namespace rollrig::scenarios
