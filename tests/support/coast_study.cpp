#include "tests/support/coast_study.h"

#include <cmath>
#include <functional>

#include "sim/core/random.h"

namespace rollrig::tests {
namespace {

using estimation::CoastRun;
using estimation::CoastSeries;
using estimation::CoastState;

constexpr double kWay_m = 4.8;  // of the drum's surface from pulse to pulse
constexpr double kTop_m_s = 27.0;
constexpr double kEnd_m_s = 1.5;

/// Pulses of a body: 30 s of constant drive, then the coast by Runge and Kutta's method in steps of 10 ms; the speed
/// of a row is that at the middle of the way since the pulse before, where a period's mean stands.
CoastSeries make_series(const CoastStudy& study, double way_m, const std::function<double(double)>& deceleration_m_s2,
                        RandomStream& random) {
  constexpr double kDrive_s = 30.0;
  constexpr double kStep_s = 0.01;
  CoastSeries series;
  double speed = kTop_m_s, way = 0.0, last_pulse_s = 0.0, missed_from_s = -1.0;
  for (double t = 0.0; speed > kEnd_m_s; t += kStep_s) {
    const double before = speed;
    if (t > kDrive_s) {
      const double middle = speed - 0.5 * kStep_s * deceleration_m_s2(speed);
      speed -= kStep_s * deceleration_m_s2(middle);
    }
    const double step_m = 0.5 * kStep_s * (before + speed);
    way += step_m;
    if (way < way_m) continue;
    const double pulse_s = t + kStep_s * (1.0 - (way - way_m) / step_m);
    way -= way_m;
    const double period_s = pulse_s - (missed_from_s >= 0.0 ? missed_from_s : last_pulse_s);
    last_pulse_s = pulse_s;
    if (random.uniform() < study.missed_share) {  // this pulse is not seen: the next period is twice as long
      if (missed_from_s < 0.0) missed_from_s = pulse_s - period_s;
      continue;
    }
    missed_from_s = -1.0;
    double measured = way_m / period_s + study.noise_m_s * random.normal();
    if (random.uniform() < study.doubled_share) measured *= 2.0;
    if (series.time_s.empty() && pulse_s < 1.0) {
      series.time_s.push_back(pulse_s);
      series.speed_m_s.push_back(measured);
      continue;
    }
    series.time_s.push_back(pulse_s);
    series.speed_m_s.push_back(std::max(0.01, measured));
  }
  return series;
}

}  // namespace

double calc_true_drum_m_s2(double v) { return 0.008 + 0.0007 * v + 0.00015 * v * v; }
double calc_true_wheel_m_s2(double v) { return 0.05 + 0.004 * v + 0.0014 * v * v; }

double calc_true_net_m_s2(const CoastStudy& study, double pressure_Pa, double v) {
  return (0.055 + 0.0015 * v + 0.00001 * v * v) * std::pow(pressure_Pa / 420e3, study.exponent);
}

estimation::CoastSet make_coasts(const CoastStudy& study, std::uint64_t seed) {
  estimation::CoastSet set;
  set.name = "made up";
  set.drum_diameter_m = 1.5;
  set.drum_pulse_length_m = kWay_m;
  set.wheel_pulse_length_m = kWay_m / 3.0;
  set.speeds_m_s = {6.0, 10.0, 18.0, 22.0};
  set.reference_speed_m_s = 18.0;
  set.reference_pressure_Pa = 420e3;
  if (study.mass_ratio > 0.0) set.wheel_mass_ratio = study.mass_ratio;
  RandomStream random(seed, "coasts");
  const double mu = study.mass_ratio;
  for (const double pressure_Pa : study.pressures_Pa) {
    for (const char* direction : {"left", "right"}) {
      const double side = 1.0 + (direction[0] == 'l' ? 0.5 : -0.5) * study.left_over_right;
      const double level = 1.0 + study.loaded_scatter * random.normal();
      const auto deceleration = [&](double v) {
        const double total =
            calc_true_net_m_s2(study, pressure_Pa, v) * side + calc_true_drum_m_s2(v) + mu * calc_true_wheel_m_s2(v);
        const double x = (v - study.resonance_m_s) / study.resonance_width_m_s;
        return level * total / (1.0 + mu) * (1.0 + study.resonance * std::exp(-0.5 * x * x));
      };
      CoastRun run;
      run.id = direction;
      run.state = CoastState::kLoaded;
      run.pressure_Pa = pressure_Pa;
      run.direction = direction;
      run.drum = make_series(study, kWay_m, deceleration, random);
      set.runs.push_back(run);
    }
  }
  for (int i = 0; i < study.lifted_runs; ++i) {
    CoastRun run;
    run.id = "lifted";
    run.state = CoastState::kLifted;
    const double level = 1.0 + study.lifted_scatter * random.normal();
    run.drum = make_series(
        study, kWay_m, [level](double v) { return level * calc_true_drum_m_s2(v); }, random);
    const double wheel = 1.0 + study.lifted_scatter * random.normal();
    run.wheel = make_series(
        study, kWay_m / 3.0, [wheel](double v) { return wheel * calc_true_wheel_m_s2(v); }, random);
    set.runs.push_back(run);
  }
  return set;
}

}  // namespace rollrig::tests
