#pragma once
/// Builds the program of a drive, phase by phase.

#include <string>

#include "rigs/vehicle_channels.h"
#include "scenarios/common/speed_trace.h"
#include "scenarios/common/vehicle_conditions.h"
#include "sim/program.h"

namespace rollrig::scenarios {

/// Keeps the present speed, and appends phases. The vehicle stands at first, its tires soaked.
class VehicleProgram {
 public:
  /// Stretches above `count_from_m_s` are counted; a trace is cut where it crosses that speed.
  VehicleProgram(const VehicleConditions& conditions, double sample_interval_s, double count_from_m_s);

  /// Speed at which the program begins, instead of standstill; before the first phase.
  void start_at(double speed_m_s) { speed_m_s_ = speed_m_s; }
  /// Standstill.
  void rest(const std::string& name, double duration_s);
  /// A trace as one phase.
  void drive(const SpeedTrace& trace, const std::string& name);
  /// To a constant speed, held, and back to standstill, as one phase; `duration_s` in all.
  void drive_at(const std::string& name, double speed_m_s, double duration_s, double ramp_s);
  /// Evenly to another speed.
  void change_speed(const std::string& name, double duration_s, double speed_m_s);
  /// Neutral until the speed falls to `end_m_s`, at most for `longest_s`; slope and wind as given.
  void coast(const std::string& name, double end_m_s, double longest_s, double slope, double wind_m_s);
  sim::Program program() const { return program_; }
  double speed_m_s() const { return speed_m_s_; }
  bool surface_recorded() const { return conditions_.surface_K.has_value(); }

 private:
  sim::Phase& append(const std::string& name);
  void add_line(sim::Phase& phase, double duration_s, double end_m_s);
  void add_counted_line(sim::Phase& phase, double duration_s, double end_m_s);

  VehicleConditions conditions_;
  double count_from_m_s_;
  sim::Program program_;
  double speed_m_s_ = 0.0;
  double slope_ = 0.0;
  double wind_m_s_ = 0.0;
};

}  // namespace rollrig::scenarios
