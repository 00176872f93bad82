#pragma once
/// Coast-downs of a drum as files give them ("rollrig-drum-coastdown/1", docs/formats.md).

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "include/rollrig/bad_rows.h"
#include "measurements/left_out_rows.h"
#include "sim/core/config.h"

namespace rollrig::estimation {

enum class CoastState { kLoaded, kLifted };
enum class CoastBody { kDrum, kWheel };

constexpr double kSamePressure = 0.01;  // Assumed: pressures that differ by less are one.

/// Whether a pressure is that of a level.
inline bool is_same_pressure(double pressure_Pa, double level_Pa) {
  return std::abs(pressure_Pa / level_Pa - 1.0) < kSamePressure;
}

constexpr double kSameLoad = 0.02;  // Assumed: loads that differ by less are one.

/// Whether a load is that of a level; 0: not known.
inline bool is_same_load(double load_N, double level_N) {
  return load_N == level_N || (level_N > 0.0 && std::abs(load_N / level_N - 1.0) < kSameLoad);
}

/// Surface speed of one body over time, a row a pulse (or a sample).
struct CoastSeries {
  std::vector<double> time_s;
  std::vector<double> speed_m_s;
};

struct CoastRun {
  std::string id;    // as written in the set
  std::string file;  // path
  CoastState state = CoastState::kLoaded;
  double pressure_Pa = 0.0;  // gauge; of loaded runs
  double load_N = 0.0;       // of loaded runs; 0 where not said
  std::string direction;     // empty where not said
  std::optional<CoastSeries> drum;
  std::optional<CoastSeries> wheel;
  measurements::LeftOutRows left_out;  // bad rows of the file
};

struct CoastSet {
  std::string path;
  std::string name;
  double drum_diameter_m = 0.0;
  std::optional<double> drum_inertia_kg_m2;
  std::optional<double> wheel_inertia_kg_m2;
  std::optional<double> wheel_rolling_radius_m;
  std::optional<double> wheel_mass_ratio;     // mu where the inertias are not known one by one
  std::optional<double> drum_pulse_length_m;  // way of the surface from pulse to pulse
  std::optional<double> wheel_pulse_length_m;
  std::vector<double> speeds_m_s;  // at which decelerations are asked for
  double reference_speed_m_s = 0.0;
  std::optional<double> reference_pressure_Pa;
  double half_band_m_s = 4.0;  // Assumed: rows used about each speed, this far to both sides
  bool find_resonance = true;
  std::vector<double> leave_out_m_s;  // from, to; empty where not said
  std::vector<CoastRun> runs;

  /// I_D/R^2, the mass that the drum is worth at its surface.
  std::optional<double> calc_drum_mass_kg() const;
  /// mu: given, or from both inertias; 0 when neither is known.
  double calc_mass_ratio() const;
  bool is_mass_ratio_known() const;
};

/// Reads a set and its files, which lie beside it or in `data_folder` where that is given.
///
/// A row is bad if a number of it is wrong, `src` names no body, it has too few or too many fields, or its time does
/// not increase within its body. The bad rows of all files are refused together, or left out.
/// Errors   InputError: bad rows, where they are refused, or too many of them; anything else that is wrong
/// Checked  tests/estimation/coast_set_test.cpp, tests/cli/bad_input_test.cpp
CoastSet read_coast_set(const std::string& path, const std::string& data_folder = "",
                        BadRows bad_rows = BadRows::kRefuse);

/// The files with bad rows that were left out, once each: a file may stand in several runs.
std::vector<const CoastRun*> list_runs_with_bad_rows(const CoastSet& set);

}  // namespace rollrig::estimation
