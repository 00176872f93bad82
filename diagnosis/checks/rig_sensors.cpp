#include "diagnosis/checks/rig_sensors.h"

#include <functional>
#include <stdexcept>

#include "measurements/read_force.h"

namespace rollrig::diagnosis {
namespace {

namespace quantities = models::quantities;

constexpr Quantity kAirReading{"air_reading", "degC"};
constexpr Quantity kPressureReading{"pressure_reading", "kPa"};

/// States of a corner at a row of a recording in full detail: rubber and gas come first.
template <class S>
std::vector<S> find_states(const models::Corner<S>& corner, const sim::Recording<S>& recording, std::size_t row) {
  std::vector<S> states{recording.channel(quantities::kLinerTemperature)[row],
                        recording.channel(quantities::kGasTemperature)[row]};
  for (std::size_t i = states.size(); i < corner.state_count(); ++i) {
    states.push_back(recording.channel(corner.states()[i].quantity)[row]);
  }
  return states;
}

/// What really acts at each row of a run, by the ports.
template <class S>
std::vector<S> read_instants(const measurements::MeasurementSet& set, const measurements::MeasuredRun& run,
                             const models::Corner<S>& corner, const sim::Recording<S>& recording,
                             const std::function<S(const models::Instant<S>&)>& read) {
  const bool has_surface = run.has(quantities::kSurfaceTemperature);
  std::vector<S> values;
  for (std::size_t row = 0; row < run.time_s.size(); ++row) {
    const auto given = [&](const Quantity& column) { return S(run.column(column)[row]); };
    const std::vector<S> states = find_states(corner, recording, row);
    models::Instant<S> now;
    now.inflation = {S(run.cold_pressure_Pa), S(run.initial_tire_temperature_K),
                     S(set.rig->environment.ambient_pressure_Pa)};
    now.recorded.speed_m_s = given(quantities::kSpeed);
    now.recorded.load_N = given(quantities::kLoad);
    now.recorded.ambient_K = given(quantities::kAmbient);
    now.recorded.surface_recorded = has_surface;
    now.recorded.surface_K = has_surface ? given(quantities::kSurfaceTemperature) : now.recorded.ambient_K;
    now.recorded.air_density_ratio = S(1.0);
    corner.apply_inputs(states.data(), now);
    now.motion.speed_m_s = now.acting.speed_m_s;
    now.motion.load_N = now.acting.load_N;
    corner.calc_losses(states.data(), now);
    values.push_back(read(now));
  }
  return values;
}

}  // namespace

const std::vector<RigSensor>& all_rig_sensors() {
  static const std::vector<RigSensor> sensors{
      {quantities::kRimTemperature, "thermocouple on the rim", 1.0, {2.0, 0.05, 60.0, 0.1, 0.0}},
      {quantities::kGasTemperature, "thermometer in the tire's gas, at the valve", 1.0, {0.5, 0.05, 60.0, 0.1, 0.0}},
      {kSurfaceReading, "thermometer on the drum's surface", 0.25, {2.0, 0.1, 60.0, 0.2, 0.0}},
      {kAirReading, "thermometer in the air beside the tire", 0.25, {0.5, 0.1, 60.0, 0.1, 0.0}},
      {quantities::kSpindleForce, "force sensor at the wheel's spindle", 4.0, {0.5, 0.1, 60.0, 0.3, 0.0}},
      {quantities::kContactLoad, "load cell under the wheel's carriage", 1.0, rigs::columns::kUsualScale},
      {quantities::kSpeedReading, "light barrier that counts turns of the drum", 0.25, rigs::columns::kUsualCounter},
      {kPressureReading, "second gauge on the cavity's pressure", 0.25, {1000.0, 50.0, 120.0, 50.0, 0.0}}};
  return sensors;
}

const RigSensor& find_rig_sensor(const Quantity& channel) {
  for (const RigSensor& sensor : all_rig_sensors()) {
    if (sensor.channel == channel) return sensor;
  }
  throw std::invalid_argument("no sensor reads " + channel.header());
}

template <class S>
std::vector<S> read_channel(const measurements::MeasurementSet& source, const measurements::MeasuredRun& run,
                            const models::Corner<S>& corner, const sim::Recording<S>& recording,
                            const Quantity& channel) {
  const auto read = [&](auto&& get) {
    return read_instants<S>(source, run, corner, recording, std::forward<decltype(get)>(get));
  };
  using Instant = models::Instant<S>;
  if (channel == kSurfaceReading) return read([](const Instant& now) { return now.boundary.surface_K; });
  if (channel == kAirReading) return read([](const Instant& now) { return now.acting.ambient_K; });
  if (channel == quantities::kSpeedReading && recording.find(channel) == nullptr) {
    return read([](const Instant& now) { return now.acting.speed_m_s; });
  }
  if (channel == kPressureReading) return read([](const Instant& now) { return now.pressure_Pa; });
  const bool takes_heat = recording.find(channel) != nullptr;
  if (channel == quantities::kRimTemperature && !takes_heat) {  // as warm as the air
    const std::vector<double>& ambient_K = run.column(quantities::kAmbient);
    return {ambient_K.begin(), ambient_K.end()};
  }
  if (channel == source.kind->traits.force) {
    return measurements::read_force(run, corner, recording.channel(channel), channel);
  }
  return recording.channel(channel);
}

template std::vector<double> read_channel(const measurements::MeasurementSet&, const measurements::MeasuredRun&,
                                          const models::Corner<double>&, const sim::Recording<double>&,
                                          const Quantity&);
template std::vector<Jet> read_channel(const measurements::MeasurementSet&, const measurements::MeasuredRun&,
                                       const models::Corner<Jet>&, const sim::Recording<Jet>&, const Quantity&);

}  // namespace rollrig::diagnosis
