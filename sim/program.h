#pragma once
/// What is done in a run, in time: phases, each a row of segments on which the inputs are straight lines.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <boost/container/small_vector.hpp>

namespace rollrig::sim {

/// A straight line from the start of a segment.
struct Ramp {
  double start = 0.0;
  double slope_per_s = 0.0;

  double at(double elapsed_s) const { return start + slope_per_s * elapsed_s; }
};

/// The inputs of a system. A program of a drive cycle has thousands of segments, whose inputs need no memory of their
/// own this way. Assumed: 8, more than the inputs of any rig.
using Ramps = boost::container::small_vector<Ramp, 8>;

/// A stretch in which every input is one straight line. Two segments meet at a knot. A system is told which segment it
/// is in; it never finds out from the time, so that a knot belongs to one side for sure.
struct Segment {
  double duration_s = 0.0;
  Ramps inputs;             // in the order that the system declares
  double max_step_s = 0.0;  // of the fixed grid, where shorter than the phase's; 0 for none
};

/// The part of a segment from one time after its start to another.
Segment cut_segment(const Segment& segment, double from_s, double to_s);

/// Ends a phase before its time: the watched quantity crosses the threshold.
struct StopCondition {
  enum class Direction { kFalling, kRising };
  std::string watch;  // a name that the system knows
  double threshold_SI = 0.0;
  Direction direction = Direction::kFalling;

  /// How far a value is from the threshold: above 0 until the condition is met.
  double find_distance(double value_SI) const {
    return direction == Direction::kFalling ? value_SI - threshold_SI : threshold_SI - value_SI;
  }
};

/// Something that is done to the system at the start of a phase, at once.
struct Command {
  std::string name;  // that the system knows
  double value_SI = 0.0;
};

struct Phase {
  std::string name;
  std::vector<Segment> segments;
  std::vector<Command> commands;
  std::optional<StopCondition> until;
  int row_stride = 1;       // every how many-th sample is written
  double max_step_s = 5.0;  // of the fixed grid. Assumed: a fifth of the gas's time constant

  double duration_s() const;
};

struct Program {
  double start_time_s = 0.0;
  double sample_interval_s = 1.0;
  std::vector<double> sample_times_s;  // where not empty, instead of the interval; increasing, from start to end
  // Of samples at own times: where the mean of each begins and that of the last ends; empty: half-way between samples.
  std::vector<double> mean_bounds_s;
  std::vector<Phase> phases;

  double duration_s() const;
};

/// Says in the log (level debug) that a phase begins.
void log_phase(const Phase& phase, double start_s);

}  // namespace rollrig::sim
