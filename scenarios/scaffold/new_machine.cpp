#include "scenarios/scaffold/new_machine.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "rigs/rig_file.h"
#include "rigs/vehicle_file.h"
#include "sim/core/assets.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"

namespace rollrig::scenarios {
namespace {

/// The asset that stands for a kind, and its table with diameter and inertia.
struct RigBase {
  const char* kind;
  const char* asset;
  const char* table;
};

const RigBase& find_base(const std::string& kind) {
  static const std::vector<RigBase> bases{
      {"drum", "drum_1m7", "drum"}, {"flat_belt", "flat_belt", "belt"}, {"dyno", "dyno_48in", "roller"}};
  for (const RigBase& base : bases) {
    if (kind == base.kind) return base;
  }
  InputProblem problem = unknown_name("kind", kind, {"drum", "flat_belt", "dyno"});
  problem.file = "command line";
  problem.key = "--kind";
  throw InputError(problem);
}

void require_given(const std::optional<double>& number, const Range& range, const char* option, const char* unit) {
  if (!number.has_value() || (std::isfinite(*number) && range.contains(*number))) return;
  throw InputError({fmt::format("{} is out of range", option), "command line", 0, option, fmt::format("{:g}", *number),
                    fmt::format("a number {} in {}", range.to_string(), unit), ""});
}

void refuse_given(const std::optional<double>& number, const char* option, const std::string& kind) {
  if (!number.has_value()) return;
  throw InputError({fmt::format("a rig of kind {} has no {}", kind, option), "command line", 0, option,
                    fmt::format("{:g}", *number), "another option, or another --kind", ""});
}

/// Replaces the line of a key, with its comment. The key must be there.
void replace_line(std::string& toml, const std::string& table, const std::string& key, const std::string& value,
                  const std::string& comment) {
  const std::size_t header = table.empty() ? 0 : toml.find("\n[" + table + "]");
  const std::size_t at = toml.find("\n" + key + " = ", header) + 1;
  const std::size_t end = toml.find('\n', at);
  const std::string assignment = fmt::format("{} = {}", key, value);
  toml.replace(at, end - at, comment.empty() ? assignment : fmt::format("{:<37} # {}", assignment, comment));
}

/// Takes out a table with its header, if it is there.
void remove_table(std::string& toml, const std::string& table) {
  const std::size_t header = toml.find("\n[" + table + "]");
  if (header == std::string::npos) return;
  const std::size_t next = toml.find("\n[", header + 1);
  toml.erase(header, (next == std::string::npos ? toml.size() : next) - header);
}

std::string show_seven_digits(double value) { return fmt::format("{:.7g}", value); }

void require_rig_options(const NewRigOptions& options) {
  const bool is_belt = options.kind == "flat_belt";
  if (is_belt) {
    refuse_given(options.diameter_m, "--diameter", options.kind);
    refuse_given(options.inertia_kg_m2, "--inertia", options.kind);
  } else {
    refuse_given(options.moving_mass_kg, "--moving-mass", options.kind);
  }
  if (options.kind == "dyno") refuse_given(options.skim_load_N, "--skim-load", options.kind);
  if (options.kind == "drum" && !options.diameter_m.has_value()) {
    throw InputError({"a drum needs its diameter", "command line", 0, "--diameter", "", "--diameter NUMBER, in m", ""});
  }
  require_given(options.diameter_m, between(0.2, 20.0), "--diameter", "m");
  require_given(options.inertia_kg_m2, positive(), "--inertia", "kg m2");
  require_given(options.moving_mass_kg, positive(), "--moving-mass", "kg");
  require_given(options.skim_load_N, between(1.0, 5000.0), "--skim-load", "N");
  require_given(options.ambient_degC, between(-60.0, 80.0), "--ambient", "degC");
  require_given(options.bearing_loss_N, between(0.0, 1000.0), "--bearing-loss", "N");
}

/// The coefficients of the loss of bearings and air, in proportion.
void scale_bearings(const NewRigOptions& options, const rigs::RigFile& rig, std::string& toml) {
  if (!options.bearing_loss_N.has_value()) return;
  constexpr double kSpeed_m_s = 80.0 / kKmhPerMs;
  const auto& loss = rig.parasitic;
  const double factor = *options.bearing_loss_N /
                        (loss.c0_N + loss.c1_N_s_per_m * kSpeed_m_s + loss.c2_N_s2_per_m2 * kSpeed_m_s * kSpeed_m_s);
  const std::string note =
      fmt::format("Assumed: that of {}, scaled to {:g} N at 80 km/h", rig.name, *options.bearing_loss_N);
  replace_line(toml, "parasitic", "c0_N", show_seven_digits(factor * loss.c0_N), note);
  replace_line(toml, "parasitic", "c1_N_s_per_m", show_seven_digits(factor * loss.c1_N_s_per_m), "Assumed: likewise");
  replace_line(toml, "parasitic", "c2_N_s2_per_m2", show_seven_digits(factor * loss.c2_N_s2_per_m2),
               "Assumed: likewise");
}

void put_drum(const NewRigOptions& options, const RigBase& base, const rigs::RigFile& rig, std::string& toml) {
  if (options.diameter_m.has_value())
    replace_line(toml, base.table, "diameter_m", show_seven_digits(*options.diameter_m), "Given");
  if (options.inertia_kg_m2.has_value()) {
    replace_line(toml, base.table, "inertia_kg_m2", show_seven_digits(*options.inertia_kg_m2), "Given");
  } else if (options.diameter_m.has_value()) {
    replace_line(toml, base.table, "inertia_kg_m2",
                 show_seven_digits(rig.drum.inertia_kg_m2 * std::pow(*options.diameter_m / rig.drum.diameter_m, 3.0)),
                 fmt::format("Assumed: that of {}, in proportion to the cube of the diameter", base.asset));
  }
  if (options.moving_mass_kg.has_value()) {
    replace_line(toml, base.table, "moving_mass_kg", show_seven_digits(*options.moving_mass_kg), "Given");
  }
}

constexpr double kAir_kg_m3 = 1.167;  // at 20 degC and 98.21 kPa

/// A table line by line, each number with its source.
class VehicleText {
 public:
  void text(const std::string& more) { text_ += more; }
  void number(const std::string& key, double value, const std::string& note) {
    text_ += fmt::format("{:<37} # {}\n", fmt::format("{} = {}", key, show_seven_digits(value)), note);
  }
  void number(const std::string& key, const std::optional<double>& given, double usual, const std::string& note) {
    number(key, given.value_or(usual), given.has_value() ? "Given" : note);
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

void require_vehicle_options(const NewVehicleOptions& options) {
  require_given(options.mass_kg, between(100.0, 100000.0), "--mass", "kg");
  require_given(options.drag_area_m2, between(0.01, 20.0), "--drag-area", "m2");
  require_given(options.rotating_mass_kg, non_negative(), "--rotating-mass", "kg");
  require_given(options.wheelbase_m, between(0.5, 20.0), "--wheelbase", "m");
  require_given(options.front_load_share, between(0.05, 0.95), "--front-load-share", "parts of 1");
  if (!options.drag_area_m2.has_value() && !options.road_load.has_value()) {
    throw InputError({"a vehicle needs its drag", "command line", 0, "--drag-area", "",
                      "--drag-area NUMBER, in m2, or --abc A B C of its road load", ""});
  }
  if (options.road_load.has_value()) {
    require_given((*options.road_load)[0], between(0.0, 20000.0), "--abc", "N, of A");
    require_given((*options.road_load)[1], between(-100.0, 100.0), "--abc", "N/(km/h), of B");
    require_given((*options.road_load)[2], Range{0.0, 10.0, true, false}, "--abc", "N/(km/h)^2, of C");
  }
  for (const char* axle : {"front", "rear", "all"}) {
    if (options.driven_axle == axle) return;
  }
  InputProblem problem = unknown_name("axle", options.driven_axle, {"front", "rear", "all"});
  problem.file = "command line";
  problem.key = "--driven";
  throw InputError(problem);
}

void write_axle(const NewVehicleOptions& options, const char* name, double position_m, VehicleText& out) {
  const bool is_front = position_m == 0.0;
  const double front_share = options.front_load_share.value_or(0.5);
  const double share = is_front ? front_share : 1.0 - front_share;
  out.text(fmt::format("\n[[axle]]\nname = \"{}\"\n", name));
  out.number("position_m", position_m, is_front ? "the first axle" : options.wheelbase_m ? "Given" : "Assumed");
  out.number("load_share", share, options.front_load_share.has_value() ? "Given" : "Assumed: half of the weight");
  if (options.driven_axle == "all") {
    out.number("drive_share", 0.5, "Assumed: driven alike");
  } else if (options.driven_axle == name) {
    out.number("drive_share", 1.0, "the driven axle");
  }
  out.number("brake_share", is_front ? 0.65 : 0.35, "Assumed: as source_car");
}

}  // namespace

void require_plain_name(const std::string& name) {
  const bool is_plain = std::none_of(name.begin(), name.end(), [](char c) {
    return c == '"' || c == '/' || c == '\\' || c == '\x7f' || (c >= 0 && c < ' ');
  });
  if (is_plain) return;
  throw InputError({"the name has a character that it cannot have", "command line", 0, "--name", name,
                    "a name without quotes, slashes, backslashes and control characters", ""});
}

std::string write_new_rig(const NewRigOptions& options) {
  const RigBase& base = find_base(options.kind);
  require_rig_options(options);
  require_plain_name(options.name);
  const std::string path = find_asset("rigs", base.asset);
  const rigs::RigFile rig = rigs::read_rig(read_config(path));
  std::string toml = read_text_file(path);
  const std::string note =
      fmt::format("# A rig of kind {}, made by rollrig new rig: {} of rollrig with the numbers that say \"Given\".\n",
                  options.kind, base.asset);
  toml = note + "# Every other number cites its source or says \"Assumed:\".\n" + toml.substr(toml.find("format = "));
  replace_line(toml, "", "name", "\"" + (options.name.empty() ? "my_" + options.kind : options.name) + "\"", "");
  put_drum(options, base, rig, toml);
  scale_bearings(options, rig, toml);
  if (options.skim_load_N.has_value()) {
    replace_line(toml, "skim", "load_N", show_seven_digits(*options.skim_load_N), "Given");
    remove_table(toml, "skim_by_class");  // the load that was given is that of all tires
  }
  if (options.ambient_degC.has_value()) {
    replace_line(toml, "environment", "ambient_degC", show_seven_digits(*options.ambient_degC), "Given");
  }
  rigs::read_rig(parse_config(toml, "the new rig"));  // whatever it would refuse is refused before it is written
  return toml;
}

std::string write_new_vehicle(const NewVehicleOptions& options) {
  require_vehicle_options(options);
  require_plain_name(options.name);
  VehicleText out;
  out.text(
      "# A vehicle, made by rollrig new vehicle. Every number says \"Given\", cites its source or says "
      "\"Assumed:\".\n");
  out.text(fmt::format("format = \"rollrig-vehicle/2\"\nname = \"{}\"\n",
                       options.name.empty() ? "my_vehicle" : options.name));
  out.number("mass_kg", options.mass_kg, "Given");
  out.number("rotating_mass_kg", options.rotating_mass_kg, 0.03 * options.mass_kg,
             "Assumed: 3 % of the mass, as SAE J2263 has it where no other is known");
  const double c_N_s2_per_m2 = options.road_load.has_value() ? (*options.road_load)[2] * kKmhPerMs * kKmhPerMs : 0.0;
  out.number("drag_area_m2", options.drag_area_m2, 2.0 * c_N_s2_per_m2 / kAir_kg_m3,
             "from C at 1.167 kg/m3, all of it as drag");
  out.number("center_of_gravity_height_m", 0.6, "Assumed: as source_car");
  if (options.road_load.has_value()) {
    out.text("\n[road_load]\n");
    out.number("A_N", (*options.road_load)[0], "Given");
    out.number("B_N_per_km_h", (*options.road_load)[1], "Given");
    out.number("C_N_per_km_h2", (*options.road_load)[2], "Given");
  }
  out.text("\n[powertrain]\n");
  out.number("efficiency", 0.85, "Assumed: battery to wheels, and back");
  out.number("regeneration_limit_m_s2", 1.5, "Assumed: as source_car");
  out.number("regeneration_fade_km_h", 10.0, "Assumed: as source_car");
  write_axle(options, "front", 0.0, out);
  write_axle(options, "rear", options.wheelbase_m.value_or(2.7), out);
  std::string toml = out.take();
  rigs::read_vehicle(parse_config(toml, "the new vehicle"));
  return toml;
}

}  // namespace rollrig::scenarios
