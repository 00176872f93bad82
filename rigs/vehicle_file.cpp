#include "rigs/vehicle_file.h"

#include <fmt/format.h>

#include <map>

#include "rigs/toml_group.h"

namespace rollrig::rigs {
namespace {

const std::map<std::string, DrivenAxle> kDrivenAxles{
    {"front", DrivenAxle::kFront}, {"rear", DrivenAxle::kRear}, {"all", DrivenAxle::kAll}};

/// Reads table [name]; every field has a default, so the table may be absent.
template <class Group>
void read_optional_table(TableReader& file, const std::string& name, Group& group) {
  const ConfigTable* table = file.table(name);
  const ConfigTable empty{{}, file.source().origin};
  TableReader reader(table != nullptr ? *table : empty, fmt::format("[{}]", name));
  read_fields(reader, group);
  reader.finish();
}

void read_powertrain(TableReader& file, VehicleFile& vehicle) {
  const ConfigTable* table = file.table("powertrain");
  const ConfigTable empty{{}, file.source().origin};
  TableReader reader(table != nullptr ? *table : empty, "[powertrain]");
  vehicle.driven_axle = kDrivenAxles.at(reader.text_or("driven_axle", "rear", {"front", "rear", "all"}));
  read_fields(reader, vehicle.powertrain);
  reader.finish();
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

VehicleFile read_vehicle(const ConfigTable& config) {
  TableReader file(config, "");
  check_format(file, "rollrig-vehicle", 1);
  VehicleFile vehicle;
  vehicle.path = config.origin.file;
  vehicle.name = file.text("name");
  const bool is_given_by_road_load = file.has("road_load");  // which holds the drag
  VehicleBody::visit(vehicle.body, [&](Field field, double& member) {
    if (is_given_by_road_load && std::string(field.key) == "drag_area_m2") field.fallback = 0.0;
    member = file.number(field);
  });
  read_standard_uncertainties(file, vehicle.uncertainties);
  vehicle.tires = file.count({"tires", between(1.0, 20.0), "Number of tires"});
  read_optional_table(file, "geometry", vehicle.geometry);
  read_optional_table(file, "suspension", vehicle.suspension);
  read_powertrain(file, vehicle);
  read_optional_table(file, "brakes", vehicle.brakes);
  read_road_load(file, vehicle);
  file.finish();
  return vehicle;
}

std::string write_vehicle(const VehicleFile& vehicle) {
  std::string text = fmt::format("format = \"rollrig-vehicle/1\"\nname = \"{}\"\n", vehicle.name);
  text += write_fields(vehicle.body, &vehicle.uncertainties);
  text += fmt::format("tires = {}\n", vehicle.tires);
  text += write_group("geometry", vehicle.geometry);
  text += write_group("suspension", vehicle.suspension);
  text += write_group("powertrain", vehicle.powertrain);
  text += fmt::format("driven_axle = \"{}\"\n", name_of(vehicle.driven_axle));
  text += write_group("brakes", vehicle.brakes);
  if (vehicle.road_load.has_value()) text += write_group("road_load", *vehicle.road_load);
  return text;
}

const char* name_of(DrivenAxle axle) {
  for (const auto& [name, value] : kDrivenAxles) {
    if (value == axle) return name.c_str();
  }
  return "";
}

}  // namespace rollrig::rigs
