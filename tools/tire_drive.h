#pragma once
/// What one undriven tire goes through in the source's tests on the dynamometer (§3.4.3, §3.4.4).

#include <string>
#include <vector>

#include "scenarios/run/run_spec.h"

namespace rollrig::tools {

/// One section of a drive; energy counts above 20 km/h as in §4.4.2.
struct DriveSection {
  std::string name;
  double distance_km = 0.0;
  double rr_Wh = 0.0;          // by the model
  double iso_Wh = 0.0;         // by the constant ISO coefficient as the tire file reports it
  double counted_km = 0.0;     // of the distance
  std::vector<double> time_s;  // from the section's start
  std::vector<double> temperature_degC;

  double difference() const { return rr_Wh / iso_Wh - 1.0; }
  double start_degC() const { return temperature_degC.front(); }
  double end_degC() const { return temperature_degC.back(); }
  double mean_degC() const;
  double lowest_degC() const;
  double highest_degC() const;
  double at_degC(double after_s) const;
};

using TireDrive = std::vector<DriveSection>;

/// The drive of §3.4.4: scenario sae_j1634, variant source, a quarter at 5400 N and 280 kPa.
TireDrive drive_source_test(const std::string& tire);
/// The same of a spec of make_source_drive(), whose tire or rig was changed.
TireDrive drive_source_test(const scenarios::RunSpec& spec);
/// The highway part of the dyno setting of §3.4.3: two highway cycles in a row, from cold tires.
TireDrive drive_dyno_setting(const std::string& tire);
/// The same of a spec of make_source_drive(), at a cold pressure.
TireDrive drive_dyno_setting(const scenarios::RunSpec& spec, double pressure_Pa);

/// RRc of a tire on the rollers of 1.2 m at 5400 N and 280 kPa by its law alone, where all of it has one temperature.
double calc_law_rrc_N_per_kN(const models::TireFile& tire, double speed_km_h, double tire_degC);

/// Mean over the time of a drive, and the range, of the liner's temperature.
double find_mean_degC(const TireDrive& drive);
double find_range_K(const TireDrive& drive);

/// Sections whose names begin with `kind`.
TireDrive select(const TireDrive& drive, const std::string& kind);

/// Table 5.1's row of one tire. Wh/km, but for the last.
struct EnergyRow {
  double city = 0.0;
  double highway = 0.0;  // the two highway sections alone
  double overall = 0.0;  // mean of the two
  double iso = 0.0;
  double difference = 0.0;  // (overall - iso) / overall
};
EnergyRow make_energy_row(const TireDrive& drive);

/// Table 4.2's column: energy of two tires over the two highway cycles.
struct HighwayEnergy {
  double model_Wh = 0.0;
  double iso_Wh = 0.0;
};
HighwayEnergy find_highway_energy(const TireDrive& dyno_setting);

}  // namespace rollrig::tools
