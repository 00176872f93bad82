#pragma once
/// A certificate of a multi-cycle test beside the same test simulated.

#include <string>
#include <vector>

namespace rollrig::tools {

/// A section as the certificate has it, in the order of the test.
struct CertificateSection {
  int phase = 0;
  std::string kind;  // "udds", "hwfet", "css65"
  double distance_m = 0.0;
  double battery_J = 0.0;

  double per_m() const { return battery_J / distance_m; }
};

/// Reads phase, kind, miles and dc_kwh; further columns are passed over. Throws InputError.
std::vector<CertificateSection> read_certificate(const std::string& path);

/// A section as it is simulated, whole vehicle.
struct SimulatedSection {
  double distance_m = 0.0;
  double drive_J = 0.0;        // given out at the driven hubs
  double recuperated_J = 0.0;  // taken in there

  /// Battery energy over distance through one efficiency, both ways.
  double per_m(double efficiency) const { return (drive_J / efficiency - recuperated_J * efficiency) / distance_m; }
};

/// The test with the forces of the vehicle's [road_load] and its inertia (rig flat), or on rollers set to them.
struct MultiCycleTest {
  std::string vehicle = "volvo_ex30";
  double rrc_N_per_kN = 0.0;      // of tires that warm up, on rollers under all wheels; 0: [road_load] and no more
  double driveline_cold_N = 0.0;  // with the effect driveline_warming, of one wheel
};
std::vector<SimulatedSection> simulate_multi_cycle(const MultiCycleTest& test,
                                                   const std::vector<CertificateSection>& certificate);

/// The efficiency with which the sections at `fitted` (indices) deviate least: least squares of relative deviations.
double fit_efficiency(const std::vector<SimulatedSection>& simulated,
                      const std::vector<CertificateSection>& certificate, const std::vector<std::size_t>& fitted);

}  // namespace rollrig::tools
