#include "tests/support/uneven_machines.h"

#include "sim/core/assets.h"

namespace rollrig::tests {
namespace {

rigs::RigFile read_asset(const std::string& name) { return rigs::read_rig(read_config(find_asset("rigs", name))); }

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
  vehicle.geometry.front_load_share = 0.57;
  vehicle.brakes.front_share = 0.68;
  vehicle.driven_axle = rigs::DrivenAxle::kRear;
  return vehicle;
}

}  // namespace rollrig::tests
