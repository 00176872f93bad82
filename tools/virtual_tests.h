#pragma once
/// The virtual tests by which a tire of the source is calibrated: parameters, observations, weights; and a50 fitted
/// with the coefficients of Figure 3.13.

#include <array>
#include <string>
#include <vector>

#include "tools/published_numbers.h"
#include "tools/virtual_run.h"

namespace rollrig::tools {

/// What is fitted of one tire. A and B are those of (3.6) at the two speeds of the source's warm-ups.
struct Calibration {
  enum Parameter : std::size_t {
    kLogA80,       // A at 80 km/h, N
    kARatio,       // A at 120 km/h over A at 80 km/h
    kB80,          // B at 80 km/h, 1/K
    kBRise,        // B at 120 km/h less B at 80 km/h, 1/K
    kLogDynoZ,     // W/K
    kLogDynoF,     // W s/(m K)
    kLogDrumG,     // z + f v at 80 km/h, W/K
    kDrumZShare,   // share of z in it
    kLogCapacity,  // J/K
  };
  static constexpr std::size_t kCount = 9;
  static const std::array<const char*, kCount> kNames;
  std::array<double, kCount> x{};

  static Calibration of(const models::TireFile& tire);
  void put(models::TireFile& tire) const;
};

/// One residual: (virtual - published) / sd, or how far the virtual number is outside a range.
struct Observation {
  std::string name;
  double published = 0.0;
  double fitted = 0.0;
  double sd = 1.0;
  double residual = 0.0;
};

class VirtualTests {
 public:
  VirtualTests(const std::string& tire_path, PublishedTire published);

  const models::TireFile& tire() const { return iso_.tire; }
  std::vector<Observation> observe(const Calibration& at) const;
  /// Root mean square over the eight sections, as a fraction.
  static double section_rms(const std::vector<Observation>& observations);

  /// For Ceres.
  bool operator()(double const* const* x, double* residuals) const;
  std::size_t observation_count() const;

 private:
  void observe_drive(const Calibration& at, std::vector<Observation>& all) const;
  void observe_drum(const Calibration& at, std::vector<Observation>& all) const;
  void observe_prior(const Calibration& at, std::vector<Observation>& all) const;

  PublishedTire published_;
  scenarios::RunSpec iso_, warm_up_, warm_up_iso_, speed_sweep_, drive_;
};

/// Conductances of a50 that were fitted with the coefficients of Figure 3.13.
struct CoolingFit {
  double rest_conductance_W_per_K = 0.0;
  double speed_conductance_W_s_per_m_K = 0.0;
  double rms = 0.0;                 // over the eight sections of Tables 4.4 and 4.5, a fraction
  std::vector<double> differences;  // of them, virtual, in the order driven
};

/// a50 with A and B of Figure 3.13 (55.1434 N, 0.0177 at 80 km/h; 64.7752 N, 0.0191 at 120 km/h; 80 km/h is
/// 22.22 m/s) at a heat capacity, and z and f on the dynamometer fitted to Tables 4.4 and 4.5.
/// `published` as of PublishedTire::sections(). Throws RunFailure when the fit does not converge.
CoolingFit fit_cooling_to_figure_3_13(const std::vector<double>& published, double heat_capacity_J_per_K);

}  // namespace rollrig::tools
