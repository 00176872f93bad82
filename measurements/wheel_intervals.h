#pragma once
/// Rows of a run cut into the steps of a replay, and what the steps come to row by row.

#include <string>
#include <utility>
#include <vector>

#include "measurements/measurement_set.h"
#include "sim/recording.h"

namespace rollrig::measurements {

/// Recorded inputs in the middle of a part of the time between two rows. The load of the part's first row holds.
struct WheelInterval {
  double duration_s = 0.0;
  double speed_m_s = 0.0;
  double acceleration_m_s2 = 0.0;
  double load_N = 0.0;  // not read on the road, where the vehicle's mass decides
  double ambient_K = 0.0;
  double surface_K = 0.0;  // used where the run recorded it
  double slope = 0.0;
  double longitudinal_force_N = 0.0;  // root mean square over the part, with the sign of its middle
  std::size_t row = 0;                // the row before
  double share_of_row = 0.0;          // of the part, what belongs to the mean of the row before; the rest to the next
};

/// The parts of a run, none longer than 2.5 s (Assumed: a tenth of the gas's time constant).
/// On the road the slope is the rise of `elevation_m` over the way between two rows; 0 below 1 m/s.
std::vector<WheelInterval> make_wheel_intervals(const MeasuredRun& run);

/// Means of channels over what belongs to each row.
template <class S>
class RowMeans {
 public:
  RowMeans(const MeasuredRun& run, std::vector<std::string> names) : weights_(run.time_s.size(), 0.0) {
    recording_.time_s = run.time_s;
    for (std::string& name : names) {
      recording_.channels.push_back({std::move(name)});
      recording_.values.emplace_back(run.time_s.size(), S(0.0));
    }
  }

  void add(const WheelInterval& part, const std::vector<S>& values) {
    for (const std::size_t next : {0, 1}) {
      const double weight = part.duration_s * (next == 0 ? part.share_of_row : 1.0 - part.share_of_row);
      if (weight == 0.0) continue;
      weights_[part.row + next] += weight;
      for (std::size_t c = 0; c < values.size(); ++c) recording_.values[c][part.row + next] += weight * values[c];
    }
  }

  sim::Recording<S> finish() {
    for (std::vector<S>& column : recording_.values) {
      for (std::size_t row = 0; row < column.size(); ++row) column[row] = column[row] * (1.0 / weights_[row]);
    }
    return std::move(recording_);
  }

 private:
  sim::Recording<S> recording_;
  std::vector<double> weights_;
};

}  // namespace rollrig::measurements
