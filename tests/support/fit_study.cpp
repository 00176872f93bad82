#include "tests/support/fit_study.h"

#include <algorithm>
#include <cstdlib>

#include <boost/math/distributions/binomial.hpp>

#include "estimation/parameters.h"
#include "measurements/sensor_file.h"
#include "models/tire/own_number.h"

namespace rollrig::tests {
namespace {

measurements::MeasuredRun make_run(const models::TireFile& tire, const WarmUp& how, const std::string& fidelity,
                                   const rigs::RigFile& rig) {
  scenarios::RunSpec spec =
      make_spec("warm_up", "a50",
                {"load_N=" + std::to_string(how.load_N), "pressure_kPa=" + std::to_string(how.pressure_kPa),
                 "speed_km_h=" + std::to_string(how.speed_km_h)},
                fidelity);
  spec.tire = tire;
  spec.rig = rig;
  const scenarios::Outcome outcome = scenarios::run_scenario(spec, {});
  const scenarios::SetRun& cut = outcome.set_runs.front();
  measurements::MeasuredRun run;
  run.id = cut.id;
  run.session = "day";
  run.initial_tire_temperature_K = cut.initial_tire_temperature_K;
  run.cold_pressure_Pa = cut.cold_pressure_Pa;
  const sim::Recording<double>& recording = outcome.recording;
  for (std::size_t row = 0; row < recording.row_count(); ++row) {
    if (recording.time_s[row] < cut.start_s - 1e-6) continue;
    run.time_s.push_back(recording.time_s[row] - cut.start_s);
    for (const char* column : {"speed_km_h", "load_N", "ambient_degC", "drum_torque_Nm", "liner_temperature_degC",
                               "cavity_pressure_kPa", "gas_temperature_degC"}) {
      run.columns[column].push_back(recording.channel(column)[row]);
    }
  }
  return run;
}

}  // namespace

measurements::MeasurementSet make_warm_up_set(const models::TireFile& tire, const std::vector<WarmUp>& warm_ups,
                                              const std::string& sensors, const std::string& fidelity,
                                              const rigs::RigFile& rig) {
  measurements::MeasurementSet set;
  set.path = "simulated";
  set.name = "simulated";
  set.tire = tire;
  set.rig = rig;
  set.kind = set.rig->kind;
  set.sensors = measurements::read_sensor_asset(sensors);
  for (const WarmUp& how : warm_ups) {
    set.runs.push_back(make_run(tire, how, fidelity, rig));
    if (how.id != nullptr) set.runs.back().id = how.id;
    if (set.sensors.count("gas_temperature_degC") == 0)
      set.runs.back().columns.erase(models::quantities::kGasTemperature);
  }
  return set;
}

measurements::MeasurementSet make_warm_up_set(const std::string& tire, const std::string& sensors,
                                              const std::string& fidelity, const rigs::RigFile& rig) {
  return make_warm_up_set(read_combined_tire(tire), {{80.0}, {120.0}}, sensors, fidelity, rig);
}

measurements::MeasurementSet add_noise(const measurements::MeasurementSet& set, std::uint64_t seed) {
  measurements::MeasurementSet noisy = set;
  for (measurements::MeasuredRun& run : noisy.runs) {
    for (const auto& [channel, sensor] : set.sensors) {
      models::apply_sensor(sensor, channel, {seed, run.session, run.id}, run.time_s, run.columns.at(channel));
    }
  }
  return noisy;
}

double find_truth(const measurements::MeasurementSet& set, const std::string& key) {
  models::Context<double> context = rigs::make_context(set.tire, *set.rig, models::Baseline::kCombined);
  const std::string name = key.substr(key.rfind('.') + 1);
  return unit_of_key(name).from_si(estimation::find_parameter(context, key));
}

double& find_own(models::OwnParameters<double>& own, const std::string& key) {
  double* found = models::find_own_number(own, key);
  if (found == nullptr) throw std::invalid_argument(key);
  return *found;
}

void put_own(models::TireFile& tire, const std::string& key, double value) {
  find_own(tire.values.own, key) = unit_of_key(key).to_si(value);
}

int count_seeds(int all) {
  constexpr int kLeast = 50;
  return std::getenv("ROLLRIG_WHOLE_STUDIES") != nullptr ? all : std::max(std::min(all, kLeast), all / 4);
}

bool is_rejected(int successes, int trials, double p, double level) {
  const boost::math::binomial_distribution<double> distribution(trials, p);
  const double at_most = boost::math::cdf(distribution, successes);
  const double at_least = successes == 0 ? 1.0 : boost::math::cdf(boost::math::complement(distribution, successes - 1));
  return std::min(at_most, at_least) < 0.5 * level;
}

}  // namespace rollrig::tests
