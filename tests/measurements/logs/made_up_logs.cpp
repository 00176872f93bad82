#include "tests/measurements/logs/made_up_logs.h"

#include <algorithm>
#include <cmath>

#include "measurements/sensor_file.h"
#include "sim/core/random.h"
#include "tests/support/machines.h"

namespace rollrig::tests {
namespace {

constexpr double kStep_s = 0.05;
constexpr double kEnd_s = 3000.0;

struct Moment {
  double speed_m_s, load_N, rubber_K, gas_K, pressure_Pa, torque_Nm;
};

double ramp(double t, double start_s, double duration_s) { return std::clamp((t - start_s) / duration_s, 0.0, 1.0); }

/// Two speeds, four skims of a minute.
std::vector<Moment> integrate(bool changes) {
  std::vector<Moment> moments;
  double T = changes ? 25.0 : 45.0;
  double gas = T;
  for (double t = 0.0; t < kEnd_s; t += kStep_s) {
    const double v = changes ? 22.2 * ramp(t, 60.0, 30.0) + 11.1 * ramp(t, 1900.0, 20.0) : 22.2;
    bool skim = false;
    for (const double at_s : {600.0, 1100.0, 1600.0, 2500.0}) skim = skim || (changes && t >= at_s && t < at_s + 60.0);
    const double load = skim ? 200.0 : 5400.0;
    const double force = load / 5400.0 * (36.0 + 0.87 * v) * std::exp(-(0.0149 + 0.000126 * v) * T);
    if (changes) {
      gas += kStep_s * 4.0 / 95.0 * (T - gas);
      T += kStep_s / 18000.0 * (force * v - (12.0 + 1.4 * v) * (T - 25.0) - 4.0 * (T - gas));
    }
    moments.push_back({v, load, T + 273.15, gas + 273.15, 381e3 * (gas + 273.15) / 298.15 - 101e3, force + 10.0});
  }
  return moments;
}

/// Linear between steps, but for the load.
Moment at(const std::vector<Moment>& moments, double t) {
  const double steps = std::clamp(t / kStep_s, 0.0, static_cast<double>(moments.size() - 2));
  const auto index = static_cast<std::size_t>(steps);
  const double share = steps - static_cast<double>(index);
  const Moment& a = moments[index];
  const Moment& b = moments[index + 1];
  const auto between = [share](double from, double to) { return from + share * (to - from); };
  return {between(a.speed_m_s, b.speed_m_s),     a.load_N,
          between(a.rubber_K, b.rubber_K),       between(a.gas_K, b.gas_K),
          between(a.pressure_Pa, b.pressure_Pa), between(a.torque_Nm, b.torque_Nm)};
}

/// Mean from half an interval before to half an interval after.
template <class Read>
double mean(const std::vector<Moment>& moments, double at_s, double interval_s, Read&& read) {
  const int count = static_cast<int>(std::lround(interval_s / kStep_s));
  double sum = 0.0;
  for (int k = 0; k < count; ++k) sum += read(at(moments, at_s + (k + 0.5 - 0.5 * count) * kStep_s));
  return sum / count;
}

void add_noise(std::vector<double>& values, double white, double drift_sd, double interval_s, RandomStream& random) {
  constexpr double kDrift_s = 60.0;
  const double memory = std::exp(-interval_s / kDrift_s);
  double drift = drift_sd * random.normal();
  for (double& value : values) {
    value += drift + white * random.normal();
    drift = memory * drift + std::sqrt(1.0 - memory * memory) * drift_sd * random.normal();
  }
}

}  // namespace

double true_shift_s(const LogsPlan& plan, double tire_s) { return plan.shift_s + plan.rate * tire_s; }

MadeUpLogs make_up_logs(const LogsPlan& plan, std::uint64_t seed) {
  RandomStream random(seed, "logs");
  static const std::vector<Moment> with_changes = integrate(true);
  static const std::vector<Moment> without = integrate(false);
  const std::vector<Moment>& moments = plan.changes ? with_changes : without;
  const auto instant = [&moments](double t) { return at(moments, t); };
  MadeUpLogs made;
  made.torque.file = "torque.csv";
  made.torque.form = "torque_log";
  made.torque.interval_s = 1.0;
  for (double t = 1.0 + random.uniform(); t < kEnd_s - 2.0; t += 1.0) {
    made.torque.time_s.push_back(t);
    made.torque.line.push_back(static_cast<int>(made.torque.line.size()) + 2);
    made.torque.columns["speed_km_h"].push_back(instant(t).speed_m_s);
    made.torque.columns["load_N"].push_back(instant(t).load_N);
    made.torque.columns["drum_torque_Nm"].push_back(mean(moments, t, 1.0, [](const Moment& m) { return m.torque_Nm; }));
  }
  made.tire.file = "tire.csv";
  made.tire.form = "tire_log";
  made.tire.interval_s = plan.tire_interval_s;
  for (double t = 2.0 + random.uniform(); t < kEnd_s - 3.0; t += plan.tire_interval_s * (1.0 + plan.rate)) {
    made.tire.time_s.push_back((t - plan.shift_s) / (1.0 + plan.rate));
    made.tire.line.push_back(static_cast<int>(made.tire.line.size()) + 2);
    made.tire.columns["liner_temperature_degC"].push_back(
        mean(moments, t, plan.tire_interval_s, [](const Moment& m) { return m.rubber_K; }));
    made.tire.columns["cavity_pressure_kPa"].push_back(
        mean(moments, t, plan.tire_interval_s, [](const Moment& m) { return m.pressure_Pa; }));
    if (plan.tire_has_speed) made.tire.columns["speed_km_h"].push_back(instant(t).speed_m_s);
  }
  const double k = plan.noise;
  add_noise(made.torque.columns["drum_torque_Nm"], 0.25 * k, 0.1 * k, 1.0, random);
  add_noise(made.tire.columns["liner_temperature_degC"], 0.1 * k, 0.05 * k, plan.tire_interval_s, random);
  add_noise(made.tire.columns["cavity_pressure_kPa"], 50.0 * k, 25.0 * k, plan.tire_interval_s, random);
  if (plan.tire_has_speed) add_noise(made.tire.columns["speed_km_h"], 0.08 * k, 0.04 * k, plan.tire_interval_s, random);
  made.mapping.set.kind = tests::kDrum;
  made.mapping.set.sensors = measurements::read_sensor_asset("source");
  made.mapping.clock.largest_shift_s = 60.0;
  return made;
}

}  // namespace rollrig::tests
