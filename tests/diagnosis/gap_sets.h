#pragma once
/// Sets simulated with a known difference from the baseline, for tests of the diagnosis.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "diagnosis/comparison/model_comparison.h"

namespace rollrig::tests {

/// Drum runs in two sessions, each skim, 80 km/h, a faster speed, skim; the tire a50 on the asset rig, whose every
/// effect of `effects` acts. Free of noise. Up to six runs, from 2,000 to 3,500 s at 1 Hz.
measurements::MeasurementSet make_gap_set(const std::vector<models::ActiveEffect>& effects, std::size_t runs,
                                          const std::string& sensors = "source");

/// A set made ready, and the baseline fitted to it.
struct FittedBaseline : diagnosis::Study {
  explicit FittedBaseline(const measurements::MeasurementSet& measured);
};

/// A baseline set measured again and again: noise and true base parameters are drawn, all by their priors. The fit is
/// done to first order, which is exact here, since the base parameters' effect is too.
class RepeatedBaseline {
 public:
  explicit RepeatedBaseline(const measurements::MeasurementSet& clean);

  /// A set with the errors of its sensors added, and the baseline fitted; on one thread. `change` acts on the clean set
  /// before the errors are added.
  std::unique_ptr<diagnosis::Study> draw(std::uint64_t seed,
                                         const std::function<void(measurements::MeasurementSet&)>& change = {}) const;

 private:
  measurements::MeasurementSet clean_;
  Eigen::VectorXd simulated_;
  diagnosis::RowMatrix derivatives_;
  diagnosis::RowMatrix jacobian_;
};

/// Adds to a channel, in SI units, as a function of the run's time.
void add_to_channel(measurements::MeasuredRun& run, const std::string& channel,
                    const std::function<double(double time_s)>& error);

}  // namespace rollrig::tests
