#include "report/run_page.h"

#include <algorithm>
#include <cmath>

#include "report/blocks.h"
#include "report/readings.h"
#include "rigs/vehicle_channels.h"
#include "scenarios/common/vehicle_conditions.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

namespace quantities = models::quantities;
using rigs::wheel_channel;
using scenarios::RunSpec;
using Column = std::vector<double>;
using Recording = sim::Recording<double>;
using Tire = models::TireParameters<double>;

/// A recorded pose, or nothing.
const Column* find_pose(const Recording& recording, const Quantity& quantity) {
  for (std::size_t i = 0; i < recording.poses.size(); ++i) {
    const bool is_whole = recording.pose_values[i].size() == recording.row_count();
    if (recording.poses[i].quantity == quantity && is_whole) return &recording.pose_values[i];
  }
  return nullptr;
}

/// Way at the recorded speed, in meters.
Column integrate_speed(const Recording& recording) {
  const Column& speed_m_s = recording.channel(quantities::kSpeed);
  Column way_m(speed_m_s.size(), 0.0);
  for (std::size_t i = 1; i < way_m.size(); ++i) {
    way_m[i] = way_m[i - 1] + 0.5 * (speed_m_s[i] + speed_m_s[i - 1]) * (recording.time_s[i] - recording.time_s[i - 1]);
  }
  return way_m;
}

Column scaled(Column values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

class Scene {
 public:
  Scene(const RunSpec& spec, const Recording& recording) : spec_(spec), recording_(recording) {}

  Json series(const Column& values_SI, const char* key) const {
    Json json = make_series("", recording_.time_s, in_unit_of(key, values_SI));
    json.erase("name");
    return json;
  }

  /// For what the picture says in numbers.
  Json recorded(const Column& values_SI, const char* key) const {
    return make_recorded(recording_.time_s, in_unit_of(key, values_SI));
  }

  static Json make_tire(const Tire& tire) {
    const auto& geometry = tire.geometry;
    return {{"radius_m", geometry.outer_diameter_m / 2.0}, {"rim_radius_m", geometry.rim_diameter_m / 2.0}};
  }

  bool is_belt() const { return spec_.rig.kind->traits.surface == models::Surface::kBelt; }

  /// Of what turns under the tire: of a belt, the drums at its ends.
  double surface_radius_m() const {
    constexpr double kBeltDrum_m = 0.3;  // Assumed, for the picture alone
    return is_belt() ? kBeltDrum_m : spec_.rig.drum.diameter_m / 2.0;
  }
  /// Of the surface under the axle, above the point from which its height counts.
  double surface_height_m() const { return is_belt() ? 0.0 : surface_radius_m(); }

  /// Height of an axle above the surface that carries it, from what the contact carries.
  static Column height_by_load(const Tire& tire, const Column& load_N) {
    Column height_m;
    for (const double load : load_N) height_m.push_back(calc_loaded_radius_m(tire, load));
    return height_m;
  }

  Column angle_of(const Quantity& pose, double radius_m) const {
    const Column* recorded = find_pose(recording_, pose);
    return recorded != nullptr ? *recorded : scaled(integrate_speed(recording_), 1.0 / radius_m);
  }

  /// What the contact carries: as recorded, or the load that the wheel is given where nothing else is.
  const Column& contact_load_N(const std::string& position) const {
    const Column* recorded = recording_.find(wheel_channel(quantities::kContactLoad, position));
    return recorded != nullptr ? *recorded : recording_.channel(wheel_channel(quantities::kLoad, position));
  }

  /// What every wheel has: load, temperature, angles; the height is the machine's to add.
  Json make_wheel(const Tire& tire, const std::string& position, const Quantity& surface_pose) const {
    const Column& load_N = contact_load_N(position);
    const double rolling_m = calc_loaded_radius_m(tire, load_N[load_N.size() / 2]);
    Json wheel = {
        {"x_m", 0.0},
        {"tire", make_tire(tire)},
        {"load_N", recorded(load_N, "load_N")},
        {"temperature_degC",
         series(recording_.channel(wheel_channel(quantities::kLinerTemperature, position)), "x_degC")},
        {"angle_rad", series(angle_of(wheel_channel({"wheel_angle", "rad"}, position), rolling_m), "angle_rad")}};
    if (surface_radius_m() > 0.0) {
      wheel["surface_angle_rad"] = series(angle_of(surface_pose, surface_radius_m()), "angle_rad");
    }
    return wheel;
  }

  Json temperature_range_degC() const {
    double low = 1e9;
    double high = -1e9;
    for (std::size_t i = 0; i < recording_.channels.size(); ++i) {
      if (recording_.channels[i].quantity.name().rfind(quantities::kLinerTemperature.name(), 0) != 0) continue;
      const Column& values = recording_.values[i];
      low = std::min(low, *std::min_element(values.begin(), values.end()));
      high = std::max(high, *std::max_element(values.begin(), values.end()));
    }
    return {std::floor(low - kZeroCelsius_K), std::ceil(high - kZeroCelsius_K)};
  }

  const RunSpec& spec() const { return spec_; }
  const Recording& recording() const { return recording_; }

 private:
  const RunSpec& spec_;
  const Recording& recording_;
};

Json make_drum_wheel(const Scene& scene) {
  const Tire& tire = scene.spec().tire.values;
  Json wheel = scene.make_wheel(tire, "", {"drum_angle", "rad"});
  const Column* pose = find_pose(scene.recording(), {"axle_height", "m"});
  Column height_m = scene.height_by_load(tire, scene.contact_load_N(""));
  for (double& height : height_m) height += scene.surface_height_m();
  wheel["axle_height_m"] = scene.series(pose != nullptr ? *pose : height_m, "height_m");
  return wheel;
}

/// A wheel that is drawn, at its place forwards of the center of gravity.
struct DrawnWheel {
  std::string position;
  double x_m = 0.0;
  Tire tire;
};

/// Height of an axle: the body's heave and pitch and the axle's own travel on top of the static one.
Column find_axle_height_m(const Scene& scene, const DrawnWheel& drawn) {
  const Recording& recording = scene.recording();
  Column height_m = scene.height_by_load(drawn.tire, scene.contact_load_N(drawn.position));
  const Column* heave_m = find_pose(recording, {"body_heave", "m"});
  const Column* travel_m = find_pose(recording, wheel_channel({"axle_travel", "m"}, drawn.position));
  if (heave_m == nullptr || travel_m == nullptr) return height_m;
  const Column* pitch_rad = find_pose(recording, {"body_pitch", "rad"});
  const double static_load_N = recording.channel(wheel_channel(quantities::kLoad, drawn.position)).front();
  const double static_m = calc_loaded_radius_m(drawn.tire, static_load_N);
  for (std::size_t row = 0; row < height_m.size(); ++row) {
    height_m[row] = static_m + (*heave_m)[row] + (*travel_m)[row];
    if (pitch_rad != nullptr) height_m[row] += drawn.x_m * (*pitch_rad)[row];
  }
  return height_m;
}

Json make_vehicle_wheel(const Scene& scene, const DrawnWheel& drawn) {
  const Recording& recording = scene.recording();
  Json wheel = scene.make_wheel(drawn.tire, drawn.position, wheel_channel({"roller_angle", "rad"}, drawn.position));
  wheel["x_m"] = drawn.x_m;
  wheel["axle_height_m"] = scene.series(find_axle_height_m(scene, drawn), "height_m");
  wheel["force_N"] =
      scene.series(recording.channel(wheel_channel(quantities::kLongitudinalForce, drawn.position)), "force_N");
  return wheel;
}

/// The wheels on the left side of the vehicle, or the one wheel with its share of it.
std::vector<DrawnWheel> list_drawn_wheels(const RunSpec& spec, bool is_whole) {
  const rigs::VehicleFile& vehicle = *spec.vehicle;
  std::vector<DrawnWheel> drawn;
  for (const rigs::VehicleAxle& axle : vehicle.axles) {
    const std::string position = is_whole ? rigs::name_wheels(vehicle, axle).front() : "";
    drawn.push_back({position, is_whole ? vehicle.calc_x_m(axle) : 0.0, rigs::tire_of(axle, spec.tire).values});
  }
  if (!is_whole) drawn = {drawn[scenarios::VehicleConditions::find_axle(spec)]};
  return drawn;
}

void add_vehicle(const Scene& scene, Block& block) {
  const Recording& recording = scene.recording();
  const Column still(recording.row_count(), 0.0);
  const auto pose_or_still = [&](const Quantity& quantity) {
    const Column* pose = find_pose(recording, quantity);
    return pose != nullptr ? *pose : still;
  };
  Json body = {{"height_m", scene.spec().vehicle->center_of_gravity_height_m},
               {"heave_m", scene.series(pose_or_still({"body_heave", "m"}), "height_m")},
               {"axles_x_m", Json::array()}};
  const bool is_whole = recording.find(quantities::kLoad) == nullptr;
  if (is_whole) body["pitch_rad"] = scene.series(pose_or_still({"body_pitch", "rad"}), "angle_rad");
  for (const DrawnWheel& drawn : list_drawn_wheels(scene.spec(), is_whole)) {
    if (is_whole) body["axles_x_m"].push_back(drawn.x_m);
    if (recording.find(wheel_channel(quantities::kLoad, drawn.position)) == nullptr) continue;  // its axle stands
    block["wheels"].push_back(make_vehicle_wheel(scene, drawn));
  }
  block["body"] = body;
  const Column* position_m = find_pose(recording, {"position", "m"});
  if (block["machine"] == "road") {
    block["position_m"] = scene.series(position_m != nullptr ? *position_m : integrate_speed(recording), "position_m");
  }
}

}  // namespace

Block make_animation(const RunSpec& spec, const Recording& recording) {
  const Scene scene(spec, recording);
  const bool is_vehicle = spec.vehicle.has_value();
  const bool is_road = is_vehicle && scene.surface_radius_m() <= 0.0;
  const char* of = recording.poses.empty()
                       ? "Drawn to scale; angles from the recorded speed, heights from the recorded load."
                       : "Drawn to scale from the recorded positions of the bodies.";
  const char* machine = scene.is_belt() ? "belt" : !is_vehicle ? "drum" : is_road ? "road" : "rollers";
  const std::string what = scene.is_belt() ? "The belt with the wheel on it"
                           : !is_vehicle   ? "The drum with the wheel on it"
                           : is_road       ? "The vehicle on the road"
                                           : "The vehicle on its rollers";
  Block block = {{"type", "animation"},
                 {"machine", machine},
                 {"label", what + " at the slider's time; the tire is colored by its temperature"},
                 {"caption", std::string(of) + " The tire has the color of its liner temperature."},
                 {"temperature_degC", scene.temperature_range_degC()},
                 {"speed_km_h", scene.recorded(recording.channel(quantities::kSpeed), "speed_km_h")},
                 {"wheels", Json::array()}};
  if (!is_road) block["drum_radius_m"] = scene.surface_radius_m();
  if (is_vehicle) {
    add_vehicle(scene, block);
  } else {
    block["wheels"].push_back(make_drum_wheel(scene));
  }
  return block;
}

}  // namespace rollrig::report
