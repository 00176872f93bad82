#include "rigs/vehicle_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/predicate.hpp>

#include "rigs/powertrain_file.h"
#include "rigs/toml_group.h"
#include "sim/core/assets.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"

namespace rollrig::rigs {
namespace {

constexpr double kSumTolerance = 1e-6;  // of shares that are written with six digits

/// The reader of table [name]; every field has a default, so the table may be absent.
TableReader find_optional_table(TableReader& file, const std::string& name) {
  static const ConfigTable empty;
  const ConfigTable* table = file.table(name);
  return {table != nullptr ? *table : empty, fmt::format("[{}]", name)};
}

template <class Group>
void read_optional_table(TableReader& file, const std::string& name, Group& group) {
  TableReader reader = find_optional_table(file, name);
  read_fields(reader, group);
  reader.finish();
}

/// Two axles with half of the tires each.
void read_two_axles(TableReader& file, VehicleFile& vehicle) {
  const int tires = file.count({"tires", between(1.0, 20.0), "Number of tires"});
  TwoAxleGeometry geometry;
  TwoAxleBrakes brakes;
  VehicleAxle front;
  TableReader geometry_table = find_optional_table(file, "geometry");
  const bool has_load_share = geometry_table.has("front_load_share");
  read_fields(geometry_table, geometry);
  geometry_table.finish();
  read_optional_table(file, "suspension", front.suspension);
  TableReader powertrain = find_optional_table(file, "powertrain");
  const std::string driven = powertrain.text_or("driven_axle", "rear", {"front", "rear", "all"});
  read_powertrain(powertrain, vehicle.powertrain);
  read_optional_table(file, "brakes", brakes);
  vehicle.center_of_gravity_height_m = geometry.center_of_gravity_height_m;
  front.name = "front";
  front.load_share = has_load_share ? geometry.front_load_share : static_cast<double>(tires / 2) / tires;
  front.drive_share = driven == "all" ? 0.5 : driven == "front" ? 1.0 : 0.0;
  front.brake_share = brakes.front_share;
  front.wheels = tires / 2;
  VehicleAxle rear = front;
  rear.name = "rear";
  rear.position_m = geometry.wheelbase_m;
  rear.load_share = 1.0 - front.load_share;
  rear.drive_share = 1.0 - front.drive_share;
  rear.brake_share = 1.0 - front.brake_share;
  rear.wheels = tires - front.wheels;
  vehicle.axles = {front, rear};
  if (tires > 1) return;
  rear.position_m = 0.0;
  rear.load_share = rear.drive_share = rear.brake_share = 1.0;
  vehicle.axles = {rear};
}

VehicleAxle read_axle(const ConfigTable& table, const std::string& default_name, const std::string& vehicle_path) {
  TableReader reader(table, "[[axle]]");
  VehicleAxle axle;
  axle.name = reader.text_or("name", default_name);
  const bool is_plain = std::all_of(axle.name.begin(), axle.name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
  if (axle.name.empty() || !is_plain || name_without_unit("load_" + axle.name) != "load_" + axle.name) {
    throw reader.problem("name", "channels are called by the axle's name",
                         "lower-case letters, digits and '_', not a unit at the end");
  }
  read_fields(reader, axle);
  read_optional_table(reader, "suspension", axle.suspension);
  const std::string tire = reader.text_or("tire", "");
  if (!tire.empty()) {
    const std::string folder = std::filesystem::path(vehicle_path).parent_path().string();
    const std::string path = find_asset_of(reader, "tire", folder, "tires", tire);
    const std::string content = read_text_file(path);
    axle.tire = models::read_tire(parse_config(content, path));
    axle.tire->content = content;
  }
  reader.finish();
  return axle;
}

/// Throws InputError where shares do not add up, or axles do not follow one another.
void check_axles(const TableReader& file, const std::vector<VehicleAxle>& axles) {
  const auto require_sum = [&](const char* key, double VehicleAxle::*share) {
    const double sum = std::accumulate(axles.begin(), axles.end(), 0.0,
                                       [share](double all, const VehicleAxle& axle) { return all + axle.*share; });
    if (std::abs(sum - 1.0) <= kSumTolerance) return;
    throw file.problem("axle", fmt::format("the {} of all axles sum to {:.7g}", key, sum),
                       fmt::format("a {} of each axle, 1 in all", key));
  };
  require_sum("load_share", &VehicleAxle::load_share);
  require_sum("drive_share", &VehicleAxle::drive_share);
  require_sum("brake_share", &VehicleAxle::brake_share);
  for (std::size_t i = 0; i < axles.size(); ++i) {
    const double before_m = i == 0 ? 0.0 : axles[i - 1].position_m;
    if (i == 0 ? axles[i].position_m != 0.0 : axles[i].position_m <= before_m) {
      throw file.problem(
          "axle", fmt::format("axle '{}' is at position_m = {}", axles[i].name, axles[i].position_m),
          i == 0 ? "0 for the first axle" : fmt::format("more than {}, of the axle before it", before_m));
    }
    for (std::size_t k = 0; k < axles.size(); ++k) {
      if (i == k || !boost::ends_with("_" + axles[k].name, "_" + axles[i].name)) continue;
      throw file.problem(
          "axle", fmt::format("channels of axles '{}' and '{}' could not be told apart", axles[k].name, axles[i].name),
          "names of which none ends as another");
    }
  }
}

void read_axles(TableReader& file, VehicleFile& vehicle) {
  vehicle.center_of_gravity_height_m = file.number(make_center_height_field());
  TableReader powertrain = find_optional_table(file, "powertrain");
  read_powertrain(powertrain, vehicle.powertrain);
  const std::vector<const ConfigTable*> tables = file.tables("axle");
  if (tables.empty())
    throw file.problem("axle", "the vehicle has no axles", "an [[axle]] table for each, from the front");
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const std::string name = tables.size() != 2 ? fmt::format("axle_{}", i + 1) : i == 0 ? "front" : "rear";
    vehicle.axles.push_back(read_axle(*tables[i], name, vehicle.path));
  }
  check_axles(file, vehicle.axles);
}

void read_road_load(TableReader& file, VehicleFile& vehicle) {
  const ConfigTable* table = file.table("road_load");
  if (table == nullptr) return;
  TableReader reader(*table, "[road_load]");
  models::RoadLoad<double> load;
  read_fields(reader, load);
  reader.finish();
  vehicle.road_load = load;
}

}  // namespace

int VehicleFile::count_wheels() const {
  return std::accumulate(axles.begin(), axles.end(), 0,
                         [](int count, const VehicleAxle& axle) { return count + axle.wheels; });
}

double VehicleFile::calc_x_m(const VehicleAxle& axle) const {
  double x_m = 0.0;
  for (const VehicleAxle& other : axles) x_m += other.load_share * (other.position_m - axle.position_m);
  return x_m;
}

VehicleFile read_vehicle(const ConfigTable& config) {
  TableReader file(config, "");
  check_format(file, "rollrig-vehicle", 2);
  VehicleFile vehicle;
  vehicle.path = config.origin.file;
  vehicle.name = file.text("name");
  const bool is_given_by_road_load = file.has("road_load");  // which holds the drag
  VehicleBody::visit(vehicle.body, [&](Field field, double& member) {
    if (is_given_by_road_load && std::string(field.key) == "drag_area_m2") field.fallback = 0.0;
    member = file.number(field);
  });
  read_standard_uncertainties(file, vehicle.uncertainties);
  const bool has_two_axles = file.text("format") == "rollrig-vehicle/1";
  has_two_axles ? read_two_axles(file, vehicle) : read_axles(file, vehicle);
  read_road_load(file, vehicle);
  vehicle.battery = read_battery(file);
  vehicle.names_tires = std::any_of(vehicle.axles.begin(), vehicle.axles.end(),
                                    [](const VehicleAxle& axle) { return axle.tire.has_value(); });
  file.finish();
  return vehicle;
}

namespace {

/// Of the two keys that say what a charge takes, the one that decides.
std::string write_battery(const VehicleBattery& battery) {
  std::string text = write_group("battery", battery);
  if (battery.recharge_J <= 0.0) return text;
  const std::size_t line = text.find("charging_efficiency");
  return text.erase(line, text.find('\n', line) + 1 - line);
}

}  // namespace

std::string write_vehicle(const VehicleFile& vehicle) {
  std::string text = fmt::format("format = \"rollrig-vehicle/2\"\nname = \"{}\"\n", vehicle.name);
  text += write_fields(vehicle.body, &vehicle.uncertainties);
  text += fmt::format("center_of_gravity_height_m = {:.10g}\n", vehicle.center_of_gravity_height_m);
  text += write_powertrain(vehicle.powertrain);
  if (vehicle.battery.has_value()) text += write_battery(*vehicle.battery);
  if (vehicle.road_load.has_value()) text += write_group("road_load", *vehicle.road_load);
  for (const VehicleAxle& axle : vehicle.axles) {
    text += fmt::format("\n[[axle]]\nname = \"{}\"\n", axle.name) + write_fields(axle);
    if (axle.tire.has_value()) text += fmt::format("tire = \"{}\"\n", axle.tire->path);
    text += write_group("axle.suspension", axle.suspension);
  }
  return text;
}

std::map<std::string, std::string> write_vehicle_files(VehicleFile vehicle, const std::string& content) {
  std::map<std::string, std::string> files;
  for (VehicleAxle& axle : vehicle.axles) {
    if (!axle.tire.has_value()) continue;
    axle.tire->path = "tire_" + axle.name + ".toml";
    files[axle.tire->path] = models::write_tire(*axle.tire);
  }
  files["vehicle.toml"] = content.empty() || vehicle.names_tires ? write_vehicle(vehicle) : content;
  return files;
}

void share_tire(const models::TireFile& tire, VehicleFile& vehicle) {
  for (VehicleAxle& axle : vehicle.axles) {
    if (axle.tire.has_value() && models::write_tire(*axle.tire) == models::write_tire(tire)) axle.tire.reset();
  }
}

std::vector<TireGroup> group_tires(const VehicleFile& vehicle, double pressure_Pa) {
  constexpr double kSameLoad = 1e-4;
  const auto write_own_tire = [](const VehicleAxle& axle) {
    return axle.tire.has_value() ? models::write_tire(*axle.tire) : std::string();
  };
  std::vector<TireGroup> groups;
  for (const VehicleAxle& axle : vehicle.axles) {
    const double own_Pa = axle.pressure_Pa > 0.0 ? axle.pressure_Pa : pressure_Pa;
    const auto is_alike = [&](const TireGroup& group) {
      const double share = group.load_share / group.count;
      return group.pressure_Pa == own_Pa && std::abs(axle.load_share / axle.wheels - share) <= kSameLoad * share &&
             write_own_tire(*group.axle) == write_own_tire(axle);
    };
    auto group = std::find_if(groups.begin(), groups.end(), is_alike);
    if (group == groups.end()) group = groups.insert(group, {&axle, own_Pa});
    group->load_share += axle.load_share;
    group->count += axle.wheels;
  }
  if (groups.size() == 1) groups.front().load_share = 1.0;  // without the rounding of shares
  return groups;
}

std::string list_driven_axles(const VehicleFile& vehicle) {
  std::vector<std::string> names;
  for (const VehicleAxle& axle : vehicle.axles) {
    if (axle.drive_share > 0.0) names.push_back(axle.name);
  }
  return names.size() == vehicle.axles.size() ? "all" : boost::algorithm::join(names, ", ");
}

}  // namespace rollrig::rigs
