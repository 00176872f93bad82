#pragma once
/// Builds the program of a test on the drum, phase by phase.

#include <string>
#include <vector>

#include "measurements/measurement_set.h"
#include "rigs/drum_channels.h"
#include "scenarios/common/drum_conditions.h"
#include "sim/program.h"

namespace rollrig::scenarios {

/// Keeps the present speed and load, and appends phases. The drum stands and carries skim load at first.
class DrumProgram {
 public:
  DrumProgram(const DrumConditions& conditions, const rigs::RigFile& rig, double sample_interval_s);

  /// Rest at standstill under skim load, then the pressure is set, and rests until it is verified.
  void soak_and_inflate(double pressure_Pa);
  /// Soak, inflation, and run-up to test speed at skim load: the start of one run of a measurement set.
  void begin_test(const std::string& set_run_id, double pressure_Pa, double speed_m_s);
  /// The same, run up under a load of its own; without run-up where the test starts at standstill.
  void begin_test_under(const std::string& set_run_id, double pressure_Pa, double speed_m_s, double load_N);
  /// Back to standstill at skim load.
  void end_test();
  /// Speed changes evenly, load stays.
  void change_speed(const std::string& name, double duration_s, double speed_m_s);
  /// Constant speed under a load. Throws InputError when the phase is too short to be found and averaged.
  void roll(const std::string& name, double duration_s, double load_N);
  /// Follows given inputs, `run`'s first row being now: load held from row to row, all else linear (formats.md).
  void follow(const std::string& name, const measurements::MeasuredRun& run);
  /// Ends the phase appended last when the tire reaches a temperature from below.
  void end_at_tire_temperature(double temperature_K);
  /// The time at this point of the program becomes 0; the first call counts.
  void mark_time_zero();

  /// The program so far, with its start time.
  sim::Program program() const;
  /// Start and end of each run marked so far.
  std::vector<SetRun> set_runs() const;
  bool surface_recorded() const { return conditions_.surface_K.has_value(); }

 private:
  sim::Phase& append(const std::string& name, double duration_s, double end_speed_m_s);
  void check_readable(const std::string& name, double duration_s) const;
  void open_set_run(const std::string& id);
  void close_set_run();

  const DrumConditions& conditions_;
  double skim_load_N_;
  sim::Program program_;
  double speed_m_s_ = 0.0;
  double load_N_;
  double before_zero_s_ = 0.0;
  bool zero_marked_ = false;
  std::vector<SetRun> set_runs_;  // times from the start of the program
  bool set_run_open_ = false;
};

}  // namespace rollrig::scenarios
