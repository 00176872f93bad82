#pragma once
/// The virtual tests by which a tire of the source is calibrated: parameters, observations, weights.

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

}  // namespace rollrig::tools
