#pragma once
/// Simulated coastdowns for the procedures of WLTP, SAE J2263 and J1263: wind along and across the road, gusts that the
/// anemometer sees, split runs, weather and sensors that are off.

#include <cstdint>
#include <string>
#include <vector>

#include "estimation/road_load/coastdown_file.h"
#include "models/vehicle/road_load.h"

namespace rollrig::tests {

struct ProcedureStudy {
  models::RoadLoad<double> load{130.0, 0.6 * 3.6, 0.031 * 12.96};  // at 20 degC and the pressure below
  double reference_pressure_Pa = 100e3;
  double mass_kg = 1850.0;
  double rotating_mass_kg = 55.5;
  int pairs = 6;
  double from_km_h = 140.0;
  double from_scatter_km_h = 0.0;  // by which a run may begin higher or lower
  double to_km_h = 10.0;
  double split_overlap_km_h = 20.0;
  double split_km_h = 0.0;  // runs end there, and others begin above; 0: whole runs
  double interval_s = 0.1;
  double noise_sd_m_s = 0.03;
  double wind_m_s = 0.0;  // against the + heading
  double crosswind_m_s = 0.0;
  double gust_sd_m_s = 0.0;  // of the wind, with a memory of 4 s; an anemometer at the vehicle sees it
  double slope = 0.0;
  bool slope_known = true;
  double run_force_sd_N = 0.0;
  double yaw_drag_per_rad2 = 0.0;  // relative rise of the drag with the square of yaw
  double ambient_K = 293.15;
  double ambient_pressure_Pa = 100e3;
  bool sensors_off = false;  // thermometer, barometer and scale, each within its accuracy
  bool on_board = false;     // columns of the air at the vehicle
  double air_noise_m_s = 0.1;
};

struct SimulatedProcedure {
  estimation::CoastdownFile file;
  double mass_kg = 0.0;  // as the scale shows it
};

SimulatedProcedure simulate_procedure(const ProcedureStudy& study, std::uint64_t seed);

/// As a CSV of speed traces with all conditions that the runs have.
std::string write_procedure_csv(const estimation::CoastdownData& data);

}  // namespace rollrig::tests
