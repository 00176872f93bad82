#include "scenarios/common/drum_program.h"

#include <algorithm>

#include "measurements/resimulation.h"
#include "scenarios/run/fidelity.h"

namespace rollrig::scenarios {
namespace {

constexpr double kRowEveryAtRest_s = 60.0;  // Assumed: a soak changes within hours
constexpr double kMaxStepOfCoast_s = 1.0;

}  // namespace

DrumProgram::DrumProgram(const DrumConditions& conditions, const RunSpec& spec)
    : conditions_(conditions), skim_load_N_(spec.rig.skim.load_N), load_N_(skim_load_N_) {
  program_.sample_interval_s = spec.sample_interval_s;
}

sim::Phase& DrumProgram::append(const std::string& name, double duration_s, double end_speed_m_s) {
  sim::Segment segment;
  segment.duration_s = duration_s;
  segment.inputs.resize(rigs::kDrumInputCount);
  const double ambient_K = *conditions_.ambient_K;
  segment.inputs[rigs::index_of(rigs::DrumInput::kSpeed)] = {speed_m_s_, (end_speed_m_s - speed_m_s_) / duration_s};
  segment.inputs[rigs::index_of(rigs::DrumInput::kLoad)] = {load_N_, 0.0};
  segment.inputs[rigs::index_of(rigs::DrumInput::kAmbient)] = {ambient_K, 0.0};
  segment.inputs[rigs::index_of(rigs::DrumInput::kSurface)] = {conditions_.surface_K.value_or(ambient_K), 0.0};
  sim::Phase phase;
  phase.name = name;
  phase.segments = {segment};
  program_.phases.push_back(phase);
  speed_m_s_ = end_speed_m_s;
  return program_.phases.back();
}

void DrumProgram::soak_and_inflate(double pressure_Pa) {
  close_set_run();
  load_N_ = skim_load_N_;
  const int row_stride = std::max(1, static_cast<int>(kRowEveryAtRest_s / program_.sample_interval_s));
  const auto rest = [&](const std::string& name, double duration_s) -> sim::Phase* {
    if (duration_s <= 0.0) return nullptr;
    sim::Phase& phase = append(name, duration_s, 0.0);
    phase.row_stride = row_stride;
    return &phase;
  };
  rest("soak", conditions_.soak_s);
  const sim::Command inflate{rigs::kSetPressure, pressure_Pa};
  // A second at least, so that the pressure has a phase to be set in.
  sim::Phase* check = rest("pressure check", std::max(1.0, conditions_.pressure_check_s));
  check->commands = {inflate};
}

void DrumProgram::begin_test(const std::string& set_run_id, const TestStart& start) {
  soak_and_inflate(start.pressure_Pa.value_or(*conditions_.pressure_Pa));
  open_set_run(set_run_id);
  load_N_ = start.load_N.value_or(skim_load_N_);
  const double speed_m_s = start.speed_m_s.value_or(conditions_.speed_m_s);
  if (speed_m_s > 0.0) append("run-up", conditions_.run_up_s, speed_m_s);
  if (!before_zero_s_.has_value()) before_zero_s_ = program_.duration_s();
}

void DrumProgram::end_test() {
  close_set_run();
  load_N_ = skim_load_N_;
  append("run-down", conditions_.run_up_s, 0.0);
}

void DrumProgram::check_readable(const std::string& name, double duration_s) const {
  const double sample_s = program_.sample_interval_s;
  const double window_s = std::min(conditions_.window_s, duration_s - 2.0 * conditions_.margin_s);
  if (window_s >= 2.0 * sample_s && duration_s >= kShortestRange_s + sample_s) return;
  throw InputError(
      {fmt::format("phase '{}' of {} s is too short to be read: margin_s {}, window_s {}, samples every {} s", name,
                   duration_s, conditions_.margin_s, conditions_.window_s, sample_s),
       "", 0, "margin_s, window_s, sample_interval_s", "",
       fmt::format("two samples in the window, phases of {} s and a sample at least", kShortestRange_s), ""});
}

void DrumProgram::roll(const std::string& name, double duration_s, std::optional<double> load_N) {
  check_readable(name, duration_s);
  load_N_ = load_N.value_or(*conditions_.load_N);
  append(name, duration_s, speed_m_s_);
}

void DrumProgram::change_speed(const std::string& name, double duration_s, double speed_m_s,
                               std::optional<double> load_N) {
  load_N_ = load_N.value_or(load_N_);
  append(name, duration_s, speed_m_s).commands = {{rigs::kDrive, 1.0}};
}

void DrumProgram::coast(const std::string& name, double end_m_s, double longest_s) {
  speed_m_s_ = end_m_s;  // where the motor takes over; until then the input is not followed
  sim::Phase& phase = append(name, longest_s, end_m_s);
  phase.commands = {{rigs::kDrive, 0.0}};
  phase.max_step_s = kMaxStepOfCoast_s;
  phase.until = sim::StopCondition{rigs::kWatchSpeed, end_m_s, sim::StopCondition::Direction::kFalling};
}

void DrumProgram::follow(const std::string& name, const measurements::MeasuredRun& run, const rigs::MachineKind& kind) {
  sim::Phase phase = measurements::make_recorded_program(run, kind).phases.front();
  phase.name = name;
  program_.phases.push_back(std::move(phase));
  speed_m_s_ = run.column(quantities::kSpeed).back();
  load_N_ = run.column(quantities::kLoad).back();
}

void DrumProgram::end_at_tire_temperature(double temperature_K) {
  program_.phases.back().until =
      sim::StopCondition{rigs::kWatchTireTemperature, temperature_K, sim::StopCondition::Direction::kRising};
}

void DrumProgram::open_set_run(const std::string& id) {
  close_set_run();
  SetRun run;
  run.id = id;
  const auto is_taken = [this](const std::string& wanted) {
    return std::any_of(set_runs_.begin(), set_runs_.end(), [&](const SetRun& other) { return other.id == wanted; });
  };
  for (int repeat = 2; is_taken(run.id); ++repeat) run.id = fmt::format("{}-{}", id, repeat);
  run.start_s = program_.duration_s();
  // What a set says of its run is what lay before it: the soak counts as rest.
  const bool remembers = conditions_.started_warm || conditions_.rest_before_s.has_value();
  const double rested_s = conditions_.rest_before_s.value_or(0.0) + conditions_.soak_s + conditions_.pressure_check_s;
  if (remembers && rested_s > 0.0) run.rest_before_s = rested_s;
  run.started_warm = conditions_.started_warm && rested_s <= 0.0;
  run.force_at_standstill = conditions_.force_at_standstill;
  set_runs_.push_back(run);
  set_run_open_ = true;
}

void DrumProgram::close_set_run() {
  if (set_run_open_) set_runs_.back().end_s = program_.duration_s();
  set_run_open_ = false;
}

sim::Program DrumProgram::program() const {
  sim::Program program = program_;
  program.start_time_s = -before_zero_s_.value_or(0.0);
  return program;
}

std::vector<SetRun> DrumProgram::set_runs() const {
  std::vector<SetRun> runs = set_runs_;
  if (set_run_open_) runs.back().end_s = program_.duration_s();
  for (SetRun& run : runs) {
    run.start_s -= before_zero_s_.value_or(0.0);
    run.end_s -= before_zero_s_.value_or(0.0);
  }
  return runs;
}

}  // namespace rollrig::scenarios
