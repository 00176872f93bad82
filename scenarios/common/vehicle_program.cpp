#include "scenarios/common/vehicle_program.h"

#include "scenarios/run/fidelity.h"

namespace rollrig::scenarios {
namespace {

constexpr double kMaxStepCoasting_s = 1.0;
constexpr double kMaxStepOnRamp_s = 1.0;  // recuperation has a knee in it

}  // namespace

VehicleProgram::VehicleProgram(const VehicleConditions& conditions, double sample_interval_s, double count_from_m_s)
    : conditions_(conditions), count_from_m_s_(count_from_m_s) {
  program_.sample_interval_s = sample_interval_s;
}

sim::Phase& VehicleProgram::append(const std::string& name) {
  sim::Phase phase;
  phase.name = name;
  phase.commands = {{rigs::kDrive, 1.0}};
  program_.phases.push_back(phase);
  return program_.phases.back();
}

/// A straight line of speed that lies on one side of the speed counted from.
void VehicleProgram::add_counted_line(sim::Phase& phase, double duration_s, double end_m_s) {
  sim::Segment segment;
  segment.duration_s = duration_s;
  segment.inputs.resize(rigs::kVehicleInputCount);
  const double ambient_K = *conditions_.ambient_K;
  const auto put = [&segment](rigs::VehicleInput input, sim::Ramp ramp) {
    segment.inputs[rigs::index_of(input)] = ramp;
  };
  if (end_m_s != speed_m_s_) segment.max_step_s = kMaxStepOnRamp_s;
  put(rigs::VehicleInput::kSpeed, {speed_m_s_, (end_m_s - speed_m_s_) / duration_s});
  put(rigs::VehicleInput::kAmbient, {ambient_K, 0.0});
  put(rigs::VehicleInput::kSurface, {conditions_.surface_K.value_or(ambient_K), 0.0});
  put(rigs::VehicleInput::kSlope, {slope_, 0.0});
  put(rigs::VehicleInput::kWind, {wind_m_s_, 0.0});
  const bool counted = 0.5 * (speed_m_s_ + end_m_s) > count_from_m_s_;
  put(rigs::VehicleInput::kCounted, {counted ? 1.0 : 0.0, 0.0});
  phase.segments.push_back(std::move(segment));
  speed_m_s_ = end_m_s;
}

void VehicleProgram::add_line(sim::Phase& phase, double duration_s, double end_m_s) {
  const double start_m_s = speed_m_s_;
  const bool crosses = (start_m_s - count_from_m_s_) * (end_m_s - count_from_m_s_) < 0.0;
  if (crosses) {
    const double share = (count_from_m_s_ - start_m_s) / (end_m_s - start_m_s);
    add_counted_line(phase, share * duration_s, count_from_m_s_);
    add_counted_line(phase, (1.0 - share) * duration_s, end_m_s);
  } else {
    add_counted_line(phase, duration_s, end_m_s);
  }
}

void VehicleProgram::rest(const std::string& name, double duration_s) {
  if (duration_s <= 0.0) return;
  add_line(append(name), duration_s, 0.0);
}

void VehicleProgram::drive(const SpeedTrace& trace, const std::string& name) {
  sim::Phase& phase = append(name);
  speed_m_s_ = trace.speed_m_s.front();
  for (std::size_t i = 0; i + 1 < trace.time_s.size();) {
    std::size_t next = i + 1;  // rows on one straight line make one segment, as at standstill
    const double slope = (trace.speed_m_s[next] - trace.speed_m_s[i]) / (trace.time_s[next] - trace.time_s[i]);
    const auto on_line = [&](std::size_t k) {
      return trace.speed_m_s[k] == trace.speed_m_s[i] + slope * (trace.time_s[k] - trace.time_s[i]);
    };
    while (next + 1 < trace.time_s.size() && on_line(next + 1)) ++next;
    add_line(phase, trace.time_s[next] - trace.time_s[i], trace.speed_m_s[next]);
    i = next;
  }
}

void VehicleProgram::drive_at(const std::string& name, double speed_m_s, double duration_s, double ramp_s) {
  sim::Phase& phase = append(name);
  add_line(phase, ramp_s, speed_m_s);
  add_line(phase, duration_s - 2.0 * ramp_s, speed_m_s);
  add_line(phase, ramp_s, 0.0);
}

void VehicleProgram::change_speed(const std::string& name, double duration_s, double speed_m_s) {
  add_line(append(name), duration_s, speed_m_s);
}

void VehicleProgram::coast(const std::string& name, double end_m_s, double longest_s, double slope, double wind_m_s) {
  sim::Phase& phase = append(name);
  phase.commands = {{rigs::kDrive, 0.0}};
  phase.max_step_s = kMaxStepCoasting_s;
  phase.until = sim::StopCondition{rigs::kWatchSpeed, end_m_s, sim::StopCondition::Direction::kFalling};
  const double start_m_s = speed_m_s_;
  slope_ = slope;
  wind_m_s_ = wind_m_s;
  add_counted_line(phase, longest_s, start_m_s);  // the input is not followed
  slope_ = wind_m_s_ = 0.0;
  speed_m_s_ = end_m_s;
}

}  // namespace rollrig::scenarios
