/// Columns of the CSV files of a measurement set, by the kind of set.
#include <algorithm>
#include <stdexcept>

#include "measurements/measurement_set.h"

namespace rollrig::measurements {
namespace {

constexpr Range kSpeedRange = between(0.0, 400.0);  // in km/h

}  // namespace

const SetColumns& columns_of(SetKind kind) {
  static const std::vector<Field> temperatures_and_pressure{
      {"liner_temperature_degC", kSetTemperatureRange, "temperature of the inner liner"},
      {"cavity_pressure_kPa", between(-100.0, 3000.0), "gauge pressure"}};
  static const auto with = [](Field first) {
    std::vector<Field> fields{first};
    fields.insert(fields.end(), temperatures_and_pressure.begin(), temperatures_and_pressure.end());
    // Beyond the format's list: where the gas temperature was measured, H can be fitted (3.16).
    fields.push_back({"gas_temperature_degC", kSetTemperatureRange, "temperature of the inflation gas"});
    return fields;
  };
  static const SetColumns drum{{{"speed_km_h", kSpeedRange, "surface speed"},
                                {"load_N", between(0.0, 200000.0), "load as the rig reports it"},
                                {"ambient_degC", kSetTemperatureRange, "air at the tire"}},
                               {{"surface_temperature_degC", kSetTemperatureRange, "drum surface"},
                                {kHungTorque, any_number(), "known torque on the sensor, by weights on a lever"}},
                               with({"drum_torque_Nm", any_number(), "motor torque at the drum axle"})};
  static const SetColumns dyno{{{"speed_km_h", kSpeedRange, "surface speed"},
                                {"load_N", between(0.0, 200000.0), "load as the rig reports it"},
                                {"longitudinal_force_N", any_number(), "wheel on roller, positive when it drives"},
                                {"ambient_degC", kSetTemperatureRange, "air at the tire"}},
                               {{"surface_temperature_degC", kSetTemperatureRange, "roller surface"}},
                               with({"loss_force_N", any_number(), "loss between hub and roller over surface speed"})};
  static const SetColumns road{{{"speed_km_h", kSpeedRange, "vehicle speed"},
                                {"elevation_m", any_number(), "height of the road"},
                                {"ambient_degC", kSetTemperatureRange, "air"}},
                               {},
                               {{"traction_force_N", any_number(), "force at the wheels"}}};
  switch (kind) {
    case SetKind::kDrum:
      return drum;
    case SetKind::kDyno:
      return dyno;
    case SetKind::kRoad:
      return road;
  }
  throw std::invalid_argument("a kind of set without columns");
}

std::vector<std::string> measured_channels(SetKind kind) {
  std::vector<std::string> names;
  for (const Field& field : columns_of(kind).measured) names.push_back(field.key);
  return names;
}

std::vector<std::string> all_measured_channels() {
  std::vector<std::string> names;
  for (const SetKind kind : {SetKind::kDrum, SetKind::kDyno, SetKind::kRoad}) {
    for (const std::string& name : measured_channels(kind)) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

const char* name_of(SetKind kind) {
  if (kind == SetKind::kRoad) return "road";
  return kind == SetKind::kDrum ? "drum" : "dyno";
}

SetKind kind_of(rigs::RigKind kind) {
  if (kind == rigs::RigKind::kDrum) return SetKind::kDrum;
  if (kind == rigs::RigKind::kDyno) return SetKind::kDyno;
  throw std::invalid_argument("a rig on which no sets are measured");
}

}  // namespace rollrig::measurements
