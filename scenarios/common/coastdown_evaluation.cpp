#include "scenarios/common/coastdown_evaluation.h"

#include <fmt/format.h>

#include <algorithm>

namespace rollrig::scenarios {
namespace {

constexpr double kRunUp_m_s2 = 1.5;       // Assumed: brisk, so that tires do not change on the way
constexpr double kLongest_s = 3600.0;     // of one coastdown. Assumed: one from 130 km/h takes some minutes
constexpr double kStandstill_m_s = 0.05;  // Assumed: below, rolling forces fade and the vehicle creeps to rest
constexpr const char* kPrefix = "coastdown ";

/// +1 for the first direction of a pair, -1 for the second, from the phase's name.
int heading_of(const std::string& phase) { return phase.back() == '+' ? 1 : -1; }

/// Speed over time in a phase.
estimation::CoastdownRun take_trace(const sim::Recording<double>& recording, const sim::PhaseSpan& phase) {
  if (phase.end_s - phase.start_s >= kLongest_s - 1.0) {
    throw RunFailure(
        fmt::format("{} does not come to its end speed within {:.0f} s: something drives the vehicle as much as it "
                    "resists, such as slope_percent, wind_m_s or an effect with a negative force",
                    phase.name, kLongest_s));
  }
  estimation::CoastdownRun run;
  run.id = phase.name.substr(std::string(kPrefix).size());
  run.session = "session";
  run.heading = heading_of(phase.name);
  run.start_s = phase.start_s;
  const std::vector<double>& speed_m_s = recording.channel(quantities::kSpeed);
  for (std::size_t row = 0; row < recording.row_count(); ++row) {
    const double time_s = recording.time_s[row];
    if (time_s < phase.start_s || time_s > phase.end_s) continue;
    run.time_s.push_back(time_s);
    run.speed_m_s.push_back(speed_m_s[row]);
  }
  return run;
}

}  // namespace

void Coastdowns::check(const RunSpec& spec) const {
  if (to_m_s >= from_m_s - 10.0 / 3.6) {
    throw InputError(setting_problem(spec, "to_km_h", "the coastdown would fall through less than 10 km/h",
                                     fmt::format("less than {:.1f} km/h", 3.6 * from_m_s - 10.0)));
  }
  if (is_on_road(spec.rig.kind->traits)) {
    if (wind_m_s == 0.0 || spec.vehicle->body.drag_area_m2 > 0.0) return;
    throw InputError(setting_problem(spec, "wind_m_s", "the vehicle has no drag area that a wind acts on",
                                     "0, or a vehicle with drag_area_m2"));
  }
  for (const char* key : {"slope_percent", "wind_m_s"}) {
    if (spec.settings.find(key) != nullptr) {
      throw InputError(setting_problem(spec, key, "rollers have neither slope nor wind", "a rig of kind \"road\""));
    }
  }
}

void Coastdowns::append_to(VehicleProgram& program) const {
  if (warm_up_s > 0.0) {
    program.change_speed("start", warm_up_speed_m_s / kRunUp_m_s2, warm_up_speed_m_s);
    program.change_speed("warm-up", warm_up_s, warm_up_speed_m_s);
  }
  append_coastdowns_to(program);
}

void Coastdowns::append_coastdowns_to(VehicleProgram& program) const {
  const double end_m_s = std::max(to_m_s, kStandstill_m_s);
  for (int pair = 1; pair <= pairs; ++pair) {
    for (const int heading : {1, -1}) {
      const std::string name = fmt::format("{} {}", pair, heading > 0 ? '+' : '-');
      const double change_m_s = std::max(std::abs(from_m_s - program.speed_m_s()), 1.0);
      program.change_speed("run-up " + name, change_m_s / kRunUp_m_s2, from_m_s);
      program.coast(kPrefix + name, end_m_s, kLongest_s, heading * slope, heading * wind_m_s);
    }
  }
}

bool is_coastdown(const std::string& phase) { return phase.rfind(kPrefix, 0) == 0; }

CoastdownInputs take_coastdowns(const sim::Recording<double>& recording, const RunSpec& spec,
                                const VehicleConditions& conditions, const Coastdowns& coastdowns) {
  CoastdownInputs inputs;
  for (const sim::PhaseSpan& phase : recording.phases) {
    if (!is_coastdown(phase.name)) continue;
    estimation::CoastdownRun run = take_trace(recording, phase);
    const std::size_t rows = run.time_s.size();
    run.conditions.ambient_K.assign(rows, *conditions.ambient_K);
    run.conditions.ambient_pressure_Pa.assign(rows, spec.rig.environment.ambient_pressure_Pa);
    run.conditions.wind_m_s.assign(rows, coastdowns.wind_m_s);
    run.conditions.slope.assign(rows, coastdowns.slope);
    inputs.data.runs.push_back(std::move(run));
  }
  estimation::RoadLoadFitOptions& options = inputs.options;
  options.mass_kg = spec.vehicle->body.mass_kg;
  options.rotating_mass_kg = spec.vehicle->body.rotating_mass_kg;
  options.drag_area_m2 = spec.vehicle->body.drag_area_m2;
  // Where a tail wind is faster than the vehicle, drag drives it, and (v + w)^2 is not its law.
  // Assumed: a margin of 10 %.
  options.speed_from_m_s = std::max(options.speed_from_m_s, 1.1 * std::abs(coastdowns.wind_m_s));
  if (is_indoors(spec.rig.kind->traits)) {
    options.reference_temperature_K = *conditions.ambient_K;
    options.reference_pressure_Pa = spec.rig.environment.ambient_pressure_Pa;
  }
  return inputs;
}

estimation::RoadLoadFit fit_coastdowns(const sim::Recording<double>& recording, const RunSpec& spec,
                                       const VehicleConditions& conditions, const Coastdowns& coastdowns) {
  const CoastdownInputs inputs = take_coastdowns(recording, spec, conditions, coastdowns);
  return estimation::fit_road_load(inputs.data, inputs.options);
}

const std::vector<double>& road_load_speeds_m_s() {
  constexpr double kKmh = 1e3 / 3600.0;
  static const std::vector<double> speeds{20.0 * kKmh,  40.0 * kKmh,  60.0 * kKmh, 80.0 * kKmh,
                                          100.0 * kKmh, 120.0 * kKmh, 130.0 * kKmh};
  return speeds;
}

}  // namespace rollrig::scenarios
