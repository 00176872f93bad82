#pragma once
/// Coastdowns, and the CSV files that hold them: speed over time, or times through speed bins. See docs/formats.md.

#include <optional>
#include <string>
#include <vector>

#include "include/rollrig/bad_rows.h"
#include "measurements/left_out_rows.h"

namespace rollrig::estimation {

/// Time to fall from one speed to a lower one.
struct SpeedBin {
  double high_m_s = 0.0;
  double low_m_s = 0.0;
  double duration_s = 0.0;
};

/// Weather and road, one value a sample (or a bin); empty where it was not measured.
struct CoastdownConditions {
  std::vector<double> ambient_K;
  std::vector<double> ambient_pressure_Pa;
  std::vector<double> wind_m_s;       // along the road, positive against the + heading
  std::vector<double> crosswind_m_s;  // across the road
  std::vector<double> slope;          // rise over run, positive uphill in the + heading
  std::vector<double> air_speed_m_s;  // at the vehicle
  std::vector<double> yaw_rad;        // of the air at the vehicle
};

/// One coastdown. Either the trace or the bins are filled.
struct CoastdownRun {
  std::string id;
  std::string session;            // runs of one session share the wind
  int heading = 0;                // +1, -1; 0 where it is not known
  std::optional<double> start_s;  // on any clock that the runs of a session share
  std::vector<double> time_s;     // increasing
  std::vector<double> speed_m_s;
  std::vector<SpeedBin> bins;        // by falling speed
  std::optional<double> total_s;     // of all bins, as the file gives it
  std::optional<double> distance_m;  // likewise
  CoastdownConditions conditions;
};

struct CoastdownData {
  std::vector<CoastdownRun> runs;
};

/// What the manifest of a simulated coastdown says of its vehicle.
struct RecordedVehicle {
  double mass_kg = 0.0;
  double rotating_mass_kg = 0.0;
  double drag_area_m2 = 0.0;
};

struct CoastdownFile {
  CoastdownData data;
  bool is_trace = false;
  bool is_simulated = false;                 // a manifest of a simulation lies beside it
  std::optional<RecordedVehicle> vehicle;    // of rollrig's own recording with its manifest
  std::size_t rows_off = 0;                  // left out by `use`
  std::vector<std::string> ignored_columns;  // of a bins file
  std::string path{};                        // of the CSV
  measurements::LeftOutRows left_out{};      // bad rows
};

/// Reads either form, told apart by its columns; or the recording of a simulated coastdown, or the folder that has it
/// (read_coastdown_recording()).
///
/// A row is bad if a number or its heading is wrong, it has too few or too many fields, its time does not increase
/// within its run, or its bin does not fall, rises or overlaps. Bad rows are refused together, or left out; a wrong
/// field that the fit does not need (`start_time`, `run_total_s`, `run_dist_m`, `dist_m`) is left empty.
/// Errors   InputError: bad rows, where they are refused, or too many of them; a wrong or missing column, a run whose
///          speed does not fall, decelerations that no coasting road vehicle has (require_coasting_decelerations())
/// Checked  tests/estimation/coastdown_file_test.cpp, tests/cli/bad_input_test.cpp
CoastdownFile read_coastdowns(const std::string& path, BadRows bad_rows = BadRows::kRefuse);

/// Doubts where a recording of a simulation has another mass or drag area than the one that is given: "--mass is ...".
std::vector<std::string> doubt_vehicle(const CoastdownFile& file, const std::optional<double>& mass_kg,
                                       const std::optional<double>& drag_area_m2);

/// What of a file is not used: rows that are off, bad rows, columns that its form does not have.
std::vector<std::string> list_reading_warnings(const CoastdownFile& file);

}  // namespace rollrig::estimation
