#pragma once
/// Builds the program of a test on the drum, phase by phase.

#include <string>
#include <vector>

#include "measurements/measurement_set.h"
#include "rigs/drum_channels.h"
#include "scenarios/common/drum_conditions.h"
#include "sim/program.h"

namespace rollrig::scenarios {

/// How a test starts, where not as its conditions say: gauge pressure, speed, and load of the run-up (skim load).
struct TestStart {
  std::optional<double> pressure_Pa;
  std::optional<double> speed_m_s;
  std::optional<double> load_N;
};

/// Keeps the present speed and load, and appends phases. The drum stands and carries skim load at first.
class DrumProgram {
 public:
  DrumProgram(const DrumConditions& conditions, const RunSpec& spec);

  /// The start of one run of a measurement set: rest at standstill under skim load, then the pressure is set, and rests
  /// until it is verified; run-up, none where the test starts at standstill. What follows the first begins at time 0.
  void begin_test(const std::string& set_run_id, const TestStart& start = {});
  /// Back to standstill at skim load.
  void end_test();
  /// Constant speed under a load, that of the conditions unless another is given. Throws InputError when the phase is
  /// too short to be found and averaged.
  void roll(const std::string& name, double duration_s, std::optional<double> load_N = std::nullopt);
  /// The same under skim load.
  void skim(const std::string& name, double duration_s) { roll(name, duration_s, skim_load_N_); }
  /// A change to another speed at constant acceleration, under the load of the phase before it unless one is given.
  void change_speed(const std::string& name, double duration_s, double speed_m_s,
                    std::optional<double> load_N = std::nullopt);
  /// Coasts under the present load: the motor is off until the speed has fallen to `end_m_s`, where the next phase goes
  /// on. A coast that has not fallen so far after `longest_s` ends there, and the next phase fails.
  void coast(const std::string& name, double end_m_s, double longest_s);
  /// Follows given inputs, `run`'s first row being now: load held from row to row, all else linear (formats.md).
  void follow(const std::string& name, const measurements::MeasuredRun& run, const rigs::MachineKind& kind);
  /// Ends the phase appended last when the tire reaches a temperature from below.
  void end_at_tire_temperature(double temperature_K);

  /// The program so far, with its start time.
  sim::Program program() const;
  /// Start and end of each run marked so far.
  std::vector<SetRun> set_runs() const;
  bool surface_recorded() const { return conditions_.surface_K.has_value(); }

 private:
  void soak_and_inflate(double pressure_Pa);
  sim::Phase& append(const std::string& name, double duration_s, double end_speed_m_s);
  void check_readable(const std::string& name, double duration_s) const;
  void open_set_run(const std::string& id);
  void close_set_run();

  const DrumConditions& conditions_;
  double skim_load_N_;
  sim::Program program_;
  double speed_m_s_ = 0.0;
  double load_N_;
  std::optional<double> before_zero_s_;
  std::vector<SetRun> set_runs_;  // times from the start of the program
  bool set_run_open_ = false;
};

}  // namespace rollrig::scenarios
