#include "tests/diagnosis/driving_sets.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/kinds/measurement_kind.h"
#include "measurements/read_force.h"
#include "scenarios/common/speed_trace.h"
#include "sim/core/assets.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/machines.h"

namespace rollrig::tests {
namespace {

/// Speeds second by second.
class Drive {
 public:
  Drive& follow(const char* cycle) {
    for (const double speed_m_s : scenarios::read_speed_trace(cycle).speed_m_s) speeds_m_s_.push_back(speed_m_s);
    return *this;
  }
  /// At 2 km/h a second to a speed, then holds it.
  Drive& hold(double km_h, double minutes) {
    constexpr double kRamp_m_s2 = 2.0 / 3.6;
    const double target_m_s = km_h / 3.6;
    double at_m_s = speeds_m_s_.empty() ? 0.0 : speeds_m_s_.back();
    while (at_m_s != target_m_s) {
      at_m_s += std::clamp(target_m_s - at_m_s, -kRamp_m_s2, kRamp_m_s2);
      speeds_m_s_.push_back(at_m_s);
    }
    speeds_m_s_.insert(speeds_m_s_.end(), static_cast<std::size_t>(60.0 * minutes), target_m_s);
    return *this;
  }

  void write(measurements::MeasuredRun& run, double ambient_K) const {
    for (std::size_t i = 0; i < speeds_m_s_.size(); ++i) run.time_s.push_back(static_cast<double>(i));
    run.columns["speed_km_h"] = speeds_m_s_;
    run.columns["ambient_degC"].assign(speeds_m_s_.size(), ambient_K);
    run.initial_tire_temperature_K = ambient_K;
    run.cold_pressure_Pa = 250e3;
  }

 private:
  std::vector<double> speeds_m_s_;
};

Drive plan_dyno_drive(std::size_t i, double minutes) {
  const double steady = std::max(5.0, minutes - 40.0);
  switch (i) {
    case 0:
      return Drive().follow("udds").follow("hwfet").hold(105.0, steady);
    case 1:
      return Drive().hold(80.0, 0.6 * steady + 15.0).follow("udds").hold(120.0, 0.4 * steady);
    case 2:
      return Drive().follow("hwfet").follow("udds").hold(0.0, 5.0).hold(50.0, steady);
    default:
      return Drive().hold(120.0, 0.5 * steady).follow("udds").hold(40.0, 0.5 * steady).hold(90.0, 10.0);
  }
}

/// What a driven rear wheel of the source's car does: half of the road load and of the inertia, brakes shared by all.
std::vector<double> find_wheel_force_N(const std::vector<double>& speed_m_s) {
  std::vector<double> force_N;
  for (std::size_t i = 0; i < speed_m_s.size(); ++i) {
    const double next = speed_m_s[std::min(i + 1, speed_m_s.size() - 1)];
    const double before = speed_m_s[i > 0 ? i - 1 : 0];
    const double road_load_N = 160.0 + 0.42 * speed_m_s[i] * speed_m_s[i];
    const double whole_N = speed_m_s[i] > 0.0 ? road_load_N + 2270.0 * (next - before) / 2.0 : 0.0;
    force_N.push_back(whole_N > 0.0 ? whole_N / 2.0 : whole_N / 4.0);
  }
  return force_N;
}

measurements::MeasurementSet begin_set(tests::Machine kind, models::Baseline baseline) {
  measurements::MeasurementSet set;
  set.path = "simulated";
  set.name = "simulated";
  set.kind = kind;
  set.baseline = baseline;
  set.tire = read_combined_tire();
  set.tire.has_constant = true;
  set.tire.values.constant.rrc = 0.0075;
  set.sensors = kind->default_sensors;
  return set;
}

}  // namespace

void measure_again(measurements::MeasurementSet& set, const std::vector<models::ActiveEffect>& effects,
                   const std::function<void(models::Context<double>&)>& change) {
  models::Context<double> context = measurements::make_context(set);
  if (change) change(context);
  for (measurements::MeasuredRun& run : set.runs) {
    models::Corner<double> corner(context, effects);
    const auto recording = measurements::Resimulation(run, *set.kind).simulate(set, run, corner);
    for (const auto& [channel, sensor] : set.sensors) run.columns[channel] = recording.channel(channel);
    const Quantity force = set.kind->traits.force;
    if (set.sensors.count(force) > 0) {
      run.columns[force] = measurements::read_force(run, corner, recording.channel(force), force);
    }
  }
}

measurements::MeasurementSet make_dyno_set(const std::vector<models::ActiveEffect>& effects, std::size_t runs,
                                           models::Baseline baseline, double minutes) {
  measurements::MeasurementSet set = begin_set(tests::kDyno, baseline);
  set.rig = rigs::read_rig(read_config(find_asset("rigs", "dyno_1m2")));
  for (const Quantity& rare :
       {models::quantities::kGasTemperature, models::quantities::kContactLoad, models::quantities::kSpeedReading}) {
    set.sensors.erase(rare);
  }
  for (std::size_t i = 0; i < runs; ++i) {
    measurements::MeasuredRun run;
    run.id = "run_" + std::to_string(i + 1);
    run.session = i % 2 == 0 ? "monday" : "tuesday";
    plan_dyno_drive(i, minutes).write(run, set.rig->environment.ambient_K);
    run.columns["load_N"].assign(run.time_s.size(), i == 3 ? 4500.0 : 5400.0);
    run.columns["longitudinal_force_N"] = find_wheel_force_N(run.columns.at("speed_km_h"));
    if (i == 2) run.cold_pressure_Pa = 290e3;
    set.runs.push_back(std::move(run));
  }
  measure_again(set, effects);
  return set;
}

measurements::MeasurementSet make_road_set(const std::vector<models::ActiveEffect>& effects, std::size_t runs,
                                           models::Baseline baseline) {
  measurements::MeasurementSet set = begin_set(tests::kRoad, baseline);
  set.vehicle = rigs::read_vehicle(read_config(find_asset("vehicles", "source_car")));
  if (baseline == models::Baseline::kConstantRrc) {
    set.tire.has_stiffness = set.tire.has_rolling_resistance = set.tire.has_thermal = false;
  }
  const double ambients_K[] = {278.15, 298.15, 288.15, 303.15, 283.15, 293.15};
  for (std::size_t i = 0; i < runs; ++i) {
    measurements::MeasuredRun run;
    run.id = "trip_" + std::to_string(i + 1);
    run.session = run.id;
    Drive drive;
    if (i % 3 == 0) drive.follow("udds").hold(100.0, 10.0);
    if (i % 3 == 1) drive.hold(70.0, 8.0).follow("hwfet").hold(120.0, 10.0);
    if (i % 3 == 2) drive.hold(50.0, 6.0).hold(90.0, 10.0).follow("udds");
    drive.write(run, ambients_K[i]);
    run.started_warm = i == 4;
    double way_m = 0.0;
    for (const double speed_m_s : run.columns.at("speed_km_h")) {
      way_m += speed_m_s;
      run.columns["elevation_m"].push_back(300.0 + 25.0 * std::sin(way_m / 900.0 + static_cast<double>(i)));
    }
    set.runs.push_back(std::move(run));
  }
  measure_again(set, effects);
  for (measurements::MeasuredRun& run : set.runs) {  // friction brakes are not logged
    std::vector<double>& traction_N = run.columns.at("traction_force_N");
    for (std::size_t row = 0; row < traction_N.size(); ++row) {
      const bool braked = traction_N[row] < -0.8 * set.vehicle->body.mass_kg;
      if (braked || run.columns.at("speed_km_h")[row] < 20.0 / 3.6) traction_N[row] = std::nan("");
    }
  }
  return set;
}

measurements::MeasuredRun thin_out(const measurements::MeasuredRun& run, std::size_t step) {
  measurements::MeasuredRun thin = run;
  const auto keep = [step](const std::vector<double>& all) {
    std::vector<double> kept;
    for (std::size_t i = 0; i < all.size(); i += step) kept.push_back(all[i]);
    return kept;
  };
  thin.time_s = keep(run.time_s);
  for (auto& [name, values] : thin.columns) values = keep(values);
  return thin;
}

}  // namespace rollrig::tests
