#pragma once
/// Decelerations of coasting drums and wheels, made by hand, and what they come to.

#include <cmath>
#include <string>
#include <vector>

#include "estimation/drum_deceleration/coast_evaluation.h"

namespace rollrig::tests {

using namespace rollrig::estimation;
using Vector = Eigen::Vector2d;

inline constexpr double kMassRatio = 0.13;

/// Decelerations at the two speeds of each run.
struct Decelerations {
  std::vector<std::vector<Vector>> loaded;  // runs of each level of pressure
  std::vector<Vector> drum;
  std::vector<Vector> wheel;
};

inline const Decelerations kScattered{
    {{{0.061, 0.083}, {0.064, 0.084}, {0.062, 0.088}}, {{0.049, 0.071}, {0.052, 0.072}}},
    {{0.0110, 0.0190}, {0.0125, 0.0196}, {0.0117, 0.0215}},
    {{0.020, 0.031}, {0.023, 0.030}, {0.024, 0.036}, {0.021, 0.034}}};

/// As scattered, without any scatter of drum and wheel.
inline Decelerations make_exact_lifted(std::vector<std::vector<Vector>> loaded) {
  return {std::move(loaded), {{0.011, 0.019}, {0.011, 0.019}}, {{0.021, 0.032}, {0.021, 0.032}}};
}

struct Evaluated {
  CoastSet set;
  DrumCoastdownFit fit;
};

inline void add_run(Evaluated& to, CoastBody body, CoastRun run, const Vector& values_m_s2) {
  CoastAnalysis analysis;
  analysis.run = to.set.runs.size();
  analysis.body = body;
  for (const double value : values_m_s2) {
    DecelerationFit at_speed;
    at_speed.available = !std::isnan(value);
    at_speed.value_m_s2 = value;
    at_speed.sd_m_s2 = 0.004;
    analysis.decelerations.push_back(at_speed);
  }
  to.set.runs.push_back(std::move(run));
  to.fit.analyses.push_back(analysis);
}

/// Levels at 200, 240, 288 .. kPa; loaded runs go to and fro by turns.
inline Evaluated evaluate(const Decelerations& values, double mass_ratio = kMassRatio) {
  Evaluated result;
  result.set.drum_diameter_m = 1.7;
  result.set.drum_inertia_kg_m2 = 1500.0;
  result.set.speeds_m_s = {12.0, 22.0};
  result.set.reference_speed_m_s = 21.0;
  result.set.reference_pressure_Pa = 240e3;
  result.fit.mass_ratio = mass_ratio;
  result.fit.directions = {"fro", "to"};
  double pressure_Pa = 200e3;
  for (const std::vector<Vector>& level : values.loaded) {
    for (std::size_t i = 0; i < level.size(); ++i) {
      CoastRun run;
      run.pressure_Pa = pressure_Pa;
      run.direction = result.fit.directions[i % 2];
      add_run(result, CoastBody::kDrum, run, level[i]);
    }
    pressure_Pa *= 1.2;
  }
  CoastRun lifted;
  lifted.state = CoastState::kLifted;
  for (const Vector& value : values.drum) add_run(result, CoastBody::kDrum, lifted, value);
  for (const Vector& value : values.wheel) add_run(result, CoastBody::kWheel, lifted, value);
  const Tables tables = make_tables(result.set, result.fit);
  for (std::size_t i = 0; i < 2; ++i) {
    result.fit.points.push_back(evaluate_speed(result.set, tables, result.fit, i));
  }
  add_ratios(result.set, tables, result.fit);
  return result;
}

inline Vector calc_mean(const std::vector<Vector>& runs) {
  Vector sum = Vector::Zero();
  for (const Vector& run : runs) sum += run;
  return sum / static_cast<double>(runs.size());
}

}  // namespace rollrig::tests
