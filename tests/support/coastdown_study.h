#pragma once
/// Simulated coastdowns of a known vehicle, with the noise of a satellite speed sensor.

#include <cstdint>
#include <string>

#include "estimation/road_load/road_load_fit.h"

namespace rollrig::tests {

/// An electric car: 120 N, 0.5 N/(km/h), 0.03 N/(km/h)^2, 2100 kg and 3 %.
struct CoastdownStudy {
  models::RoadLoad<double> load{120.0, 0.5 * 3.6, 0.03 * 12.96};
  double mass_kg = 2100.0;
  double effective_mass_kg = 2163.0;
  int pairs = 5;
  double from_km_h = 130.0;
  double to_km_h = 15.0;
  double interval_s = 0.1;
  double noise_sd_m_s = 0.05;
  double resolution_km_h = 0.01;
  double wind_m_s = 0.0;         // against the + heading
  double slope = 0.0;            // uphill in the + heading
  double run_force_sd_N = 0.0;   // constant along a run
  double run_wind_sd_m_s = 0.0;  // wind of a run
  double gust_N_sqrt_s = 0.0;    // white force
  double drift = 0.0;            // relative rise of A and B from the first to the last run
  double ambient_K = 293.15;
  double ambient_pressure_Pa = 98.21e3;
  double rolling_fall_per_K = 8.6e-3;
};

/// Runs + and - in turn; the equation of motion by classical Runge-Kutta.
estimation::CoastdownData simulate_coastdowns(const CoastdownStudy& study, std::uint64_t seed);

/// The runs as a file that `rollrig fit road-load` reads, air at 20 degC.
std::string write_coastdown_csv(const estimation::CoastdownData& data);

/// The passing times of the same runs at every `width_km_h`, without noise.
estimation::CoastdownData cut_into_bins(const estimation::CoastdownData& traces, double width_km_h);

}  // namespace rollrig::tests
