#pragma once
/// Sets simulated with noise, for tests of fits and for the coverage study.

#include <string>

#include "estimation/tire_fit/fit_tire.h"
#include "tests/support/drum_fixture.h"

namespace rollrig::tests {

/// How a tire warms up.
struct WarmUp {
  double speed_km_h;
  double load_N = 5400.0;
  double pressure_kPa = 280.0;
  const char* id = nullptr;  // of the run, by which its noise differs; that of the scenario unless said
};

/// Warm-ups of a tire in one session, free of noise, as a measurement set; sensors by name of an asset.
measurements::MeasurementSet make_warm_up_set(const models::TireFile& tire, const std::vector<WarmUp>& warm_ups,
                                              const std::string& sensors, const std::string& fidelity,
                                              const rigs::RigFile& rig = read_asset_rig());

/// Warm-ups of a tire at 80 and 120 km/h in one session, free of noise, as a measurement set; sensors by
/// name of an asset. On the rig drum_2m of the assets unless said.
measurements::MeasurementSet make_warm_up_set(const std::string& tire, const std::string& sensors,
                                              const std::string& fidelity = "multibody",
                                              const rigs::RigFile& rig = read_asset_rig());

/// The set with the errors of its sensors added.
measurements::MeasurementSet add_noise(const measurements::MeasurementSet& set, std::uint64_t seed);

/// The true value of an estimate's key, in the unit of the key.
double find_truth(const measurements::MeasurementSet& set, const std::string& key);

/// A number of a tire's own law, in SI units.
double& find_own(models::OwnParameters<double>& own, const std::string& key);

/// Puts a number of the tire's own law, in the unit of the key.
void put_own(models::TireFile& tire, const std::string& key, double value);

/// How many seeds a study of intervals uses: `all` if ROLLRIG_WHOLE_STUDIES is set, as in the preset weekly. Otherwise
/// a quarter of them, at least 50 (or `all`, if that is less). If 95 % intervals contain the truth in 85 %,
/// is_rejected() at 1 % detects that in half of the studies with 50 seeds, and in 99 of 100 with 200. With 50 seeds, it
/// does not detect intervals that are too wide.
int count_seeds(int all);

/// Whether `successes` of `trials` is rejected by a two-sided binomial test of probability `p` at `level`.
bool is_rejected(int successes, int trials, double p, double level);

}  // namespace rollrig::tests
