#include "tests/support/uneven_machines.h"

#include "sim/core/assets.h"

namespace rollrig::tests {
namespace {

rigs::RigFile read_asset(const std::string& name) { return rigs::read_rig(read_config(find_asset("rigs", name))); }

void set_front(double rigs::VehicleAxle::*share, double value, rigs::VehicleFile& vehicle) {
  vehicle.axles.front().*share = value;
  vehicle.axles.back().*share = 1.0 - value;
}

}  // namespace

rigs::RigFile make_uneven_drum() {
  rigs::RigFile rig = read_asset("drum_2m");
  rig.name = "drum_1707";
  rig.conductances_of = "drum_2m";
  rig.drum = {1.707, 310.0};
  rig.parasitic = {9.0, 0.3, 0.006};
  return rig;
}

rigs::RigFile make_uneven_dyno() {
  rigs::RigFile rig = read_asset("dyno_48in");
  rig.drum.inertia_kg_m2 = 85.0;
  rig.parasitic = {7.0, 0.2, 0.003};
  return rig;
}

rigs::VehicleFile make_uneven_vehicle() {
  rigs::VehicleFile vehicle = rigs::read_vehicle(read_config(find_asset("vehicles", "source_car")));
  set_front_load(vehicle, 0.56);
  set_front_brakes(vehicle, 0.68);
  set_front_drive(vehicle, 0.0);
  return vehicle;
}

void set_front_load(rigs::VehicleFile& vehicle, double share) {
  set_front(&rigs::VehicleAxle::load_share, share, vehicle);
}
void set_front_drive(rigs::VehicleFile& vehicle, double share) {
  set_front(&rigs::VehicleAxle::drive_share, share, vehicle);
}
void set_front_brakes(rigs::VehicleFile& vehicle, double share) {
  set_front(&rigs::VehicleAxle::brake_share, share, vehicle);
}

}  // namespace rollrig::tests
