// The rows of a run as a program of straight lines.
#include <cmath>
#include <utility>

#include "measurements/resimulation.h"
#include "rigs/recorded_road.h"
#include "rigs/recorded_roller.h"

namespace rollrig::measurements {
namespace {

namespace quantities = models::quantities;
using rigs::DrumInput;
using rigs::VehicleInput;

/// Straight lines between the rows of a run.
class Rows {
 public:
  explicit Rows(const MeasuredRun& run)
      : run_(run),
        speed_m_s_(run.column(quantities::kSpeed)),
        ambient_K_(run.column(quantities::kAmbient)),
        surface_K_(find(quantities::kSurfaceTemperature)),
        load_N_(find(quantities::kLoad)),
        force_N_(find(quantities::kLongitudinalForce)),
        elevation_m_(find(quantities::kElevation)) {}

  std::size_t count() const { return run_.time_s.size(); }
  double duration_s(std::size_t row) const { return run_.time_s[row + 1] - run_.time_s[row]; }

  /// From `start_s` after a row, for the machine of a kind.
  sim::Segment make_segment(const MachineKind& kind, std::size_t row, double start_s, double duration_s) const {
    sim::Segment segment{duration_s, sim::Ramps(count_inputs(kind))};
    sim::Ramps& inputs = segment.inputs;
    const sim::Ramp ambient = line(ambient_K_, row, start_s);
    if (is_on_road(kind.traits)) {
      inputs[index_of(VehicleInput::kSpeed)] = line(speed_m_s_, row, start_s);
      inputs[index_of(VehicleInput::kAmbient)] = ambient;
      inputs[index_of(VehicleInput::kSlope)] = {calc_slope(row), 0.0};
      return segment;
    }
    inputs[index_of(DrumInput::kSpeed)] = line(speed_m_s_, row, start_s);
    inputs[index_of(DrumInput::kLoad)] = {(*load_N_)[row], 0.0};
    inputs[index_of(DrumInput::kAmbient)] = ambient;
    inputs[index_of(DrumInput::kSurface)] = surface_K_ != nullptr ? line(*surface_K_, row, start_s) : ambient;
    if (!is_of_vehicle(kind.traits) || force_N_ == nullptr) return segment;
    inputs[rigs::kLongitudinalForceInput] = {calc_rms_with_sign(line(*force_N_, row, start_s), duration_s), 0.0};
    return segment;
  }

 private:
  static std::size_t count_inputs(const MachineKind& kind) {
    if (is_on_road(kind.traits)) return rigs::kVehicleInputCount;
    return is_of_vehicle(kind.traits) ? rigs::kRollerInputCount : rigs::kDrumInputCount;
  }

  const std::vector<double>* find(const Quantity& quantity) const {
    return run_.has(quantity) ? &run_.column(quantity) : nullptr;
  }

  sim::Ramp line(const std::vector<double>& values, std::size_t row, double start_s) const {
    const sim::Ramp ramp{values[row], (values[row + 1] - values[row]) / duration_s(row)};
    return {ramp.at(start_s), ramp.slope_per_s};
  }

  double calc_slope(std::size_t row) const {
    constexpr double kSlowest_m_s = 1.0;  // Assumed: below it the way is too short to tell
    if (elevation_m_ == nullptr) return 0.0;
    const double speed_m_s = 0.5 * (speed_m_s_[row] + speed_m_s_[row + 1]);
    const double rise_m = (*elevation_m_)[row + 1] - (*elevation_m_)[row];
    return speed_m_s < kSlowest_m_s ? 0.0 : rise_m / (speed_m_s * duration_s(row));
  }

  /// Of a force over a stretch.
  static double calc_rms_with_sign(const sim::Ramp& force_N, double duration_s) {
    const double middle_N = force_N.at(0.5 * duration_s);
    const double change_N = force_N.slope_per_s * duration_s;
    return std::copysign(std::sqrt(middle_N * middle_N + change_N * change_N / 12.0), middle_N);
  }

  const MeasuredRun& run_;
  const std::vector<double>& speed_m_s_;
  const std::vector<double>& ambient_K_;
  const std::vector<double>* surface_K_;
  const std::vector<double>* load_N_;
  const std::vector<double>* force_N_;
  const std::vector<double>* elevation_m_;
};

/// Steps between two rows, an even number where there are several, so that none lies across the middle.
int count_steps(double between_s) {
  constexpr double kLongest_s = 2.5;  // Assumed: a tenth of the gas's time constant, as the order is 2
  const auto steps = static_cast<int>(std::ceil(between_s / kLongest_s - 1e-9));
  return steps > 1 ? steps + steps % 2 : 1;
}

/// Whether `next` continues every straight line of `before`, so that the two are one segment.
bool continues(const sim::Segment& before, const sim::Segment& next) {
  constexpr double kSame = 1e-7;  // files hold nine digits
  for (std::size_t i = 0; i < before.inputs.size(); ++i) {
    const sim::Ramp& a = before.inputs[i];
    const sim::Ramp& b = next.inputs[i];
    const double scale = kSame * (1.0 + std::abs(b.start));
    const bool same_line = std::abs(a.at(before.duration_s) - b.start) <= scale &&
                           std::abs(a.slope_per_s - b.slope_per_s) * next.duration_s <= scale;
    if (!same_line) return false;
  }
  return true;
}

}  // namespace

sim::Program make_recorded_program(const MeasuredRun& run, const MachineKind& kind) {
  const Rows rows(run);
  const bool joins = !is_of_vehicle(kind.traits);
  sim::Phase phase;
  phase.name = run.id;
  for (std::size_t row = 0; row + 1 < rows.count(); ++row) {
    const int steps = joins ? 1 : count_steps(rows.duration_s(row));
    const double step_s = rows.duration_s(row) / steps;
    for (int i = 0; i < steps; ++i) {
      sim::Segment segment = rows.make_segment(kind, row, i * step_s, step_s);
      if (joins && !phase.segments.empty() && continues(phase.segments.back(), segment)) {
        phase.segments.back().duration_s += step_s;
      } else {
        phase.segments.push_back(std::move(segment));
      }
    }
  }
  sim::Program program;
  program.start_time_s = run.time_s.front();
  program.sample_times_s = run.time_s;
  program.mean_bounds_s = run.mean_bounds_s;
  program.phases = {std::move(phase)};
  return program;
}

}  // namespace rollrig::measurements
