#pragma once
/// From a plan to what the loggers write: integrates a run and takes means over sampling intervals.

#include <vector>

#include "validation/generator/plant.h"

namespace rollrig::generator {

/// A signal on a grid from time 0 on, linear between its points.
class Signal {
 public:
  Signal() = default;
  Signal(double step_s, std::vector<double> values);
  /// Mean from one time to another; the first and the last value hold beyond the ends.
  double mean(double from_s, double to_s) const;

 private:
  double integral(double time_s) const;

  double step_s_ = 1.0;
  std::vector<double> values_;
  std::vector<double> integral_;  // up to each point
};

/// A run as it would be recorded by perfect instruments: rows at 1 Hz, and signals to sample anew from. Columns that
/// a kind does not have are filled as well, and not written.
struct RunRecord {
  const Specimen* specimen = nullptr;
  std::vector<double> time_s;
  std::vector<double> speed_km_h;
  std::vector<double> load_N;
  std::vector<double> ambient_degC;
  std::vector<double> longitudinal_N;
  std::vector<double> elevation_m;
  std::vector<double> force;  // of the first channel in its unit; NaN where a vehicle's friction brakes act
  double lever = 1.0;         // of that channel, unit over N at the surface
  std::vector<double> liner_degC;
  std::vector<double> pressure_kPa;
  Signal liner;     // of the tire, beyond the end of the run by kMargin_s
  Signal pressure;  // likewise

  /// Mean over the sampling interval centered on a row, half an interval at the ends.
  double sample(const Signal& signal, std::size_t row, double shift_s = 0.0) const;
};

/// Makes an effect that changes each row of a record by itself.
template <class Law>
void trace_rows(Making& of, Law law) {
  of.effect.trace = [law](RunRecord& record) {
    for (std::size_t row = 0; row < record.time_s.size(); ++row) law(record, row);
  };
}

constexpr double kMargin_s = 30.0;

/// Simulates a run by linearly implicit Rosenbrock steps of order 4: on a drum of free size, restarted at each event;
/// where the speed has a knot each second, of half a second.
RunRecord record_run(const Specimen& specimen, const Effects& effects, const RunPlan& run);

}  // namespace rollrig::generator
