#include "scenarios/common/recorded_inputs.h"

#include <algorithm>
#include <cmath>

#include "scenarios/common/drum_conditions.h"
#include "scenarios/common/speed_trace.h"

namespace rollrig::scenarios {

void check_rest(const RunSpec& spec, bool started_warm, const std::optional<double>& rest_before_s) {
  if (!started_warm || !rest_before_s.has_value()) return;
  throw InputError(setting_problem(spec, "rest_before_min", "a tire that starts warm has not rested",
                                   "rest_before_min, or tire_state = \"warm\""));
}

void RecordedInputs::complete(const RunSpec& spec) {
  run = measurements::read_run_inputs(program.path, *spec.rig.kind);
  if (run.has(quantities::kLoad)) {
    const std::vector<double>& load_N = run.column(quantities::kLoad);
    check_tire_carries(spec, "program", *std::max_element(load_N.begin(), load_N.end()));
  }
  if (!pressure_Pa.has_value()) pressure_Pa = find_default_pressure_Pa(spec);
  if (!initial_tire_K.has_value()) initial_tire_K = run.column(quantities::kAmbient).front();
  check_rest(spec, tire_state.value == "warm", rest_before_s);
}

namespace {

/// Times shifted so that the first is 0, and before them a row of standstill where the first row moves.
measurements::MeasuredRun add_run_up(const measurements::MeasuredRun& run, double run_up_s) {
  measurements::MeasuredRun longer = run;
  for (double& time_s : longer.time_s) time_s -= run.time_s.front();
  if (run.column(quantities::kSpeed).front() <= 0.0) return longer;
  longer.time_s.insert(longer.time_s.begin(), -run_up_s);
  for (auto& [quantity, values] : longer.columns) {
    const double before = quantity == quantities::kSpeed ? 0.0 : values.front();
    values.insert(values.begin(), before);
  }
  return longer;
}

/// Times of rows: every interval, and those of the run itself.
std::vector<double> merge_times_s(const std::vector<double>& own_s, double interval_s) {
  constexpr double kSame_s = 1e-6;
  std::vector<double> times_s;
  for (std::size_t row = 0; row + 1 < own_s.size(); ++row) {
    times_s.push_back(own_s[row]);
    const double before = std::floor((own_s[row] - own_s.front() + kSame_s) / interval_s);
    for (double k = before + 1.0;; k += 1.0) {
      const double time_s = own_s.front() + k * interval_s;
      if (time_s > own_s[row + 1] - kSame_s) break;
      times_s.push_back(time_s);
    }
  }
  times_s.push_back(own_s.back());
  return times_s;
}

/// Values of a column at other times: a load holds until its next row, all else goes straight.
std::vector<double> resample(const std::vector<double>& own_s, const std::vector<double>& values, bool holds,
                             const std::vector<double>& times_s) {
  std::vector<double> at_times;
  std::size_t row = 0;
  for (const double time_s : times_s) {
    while (row + 2 < own_s.size() && time_s >= own_s[row + 1]) ++row;
    const double share = (time_s - own_s[row]) / (own_s[row + 1] - own_s[row]);
    const double straight = values[row] + share * (values[row + 1] - values[row]);
    const double held = time_s < own_s[row + 1] ? values[row] : values[row + 1];
    at_times.push_back(holds ? held : straight);
  }
  return at_times;
}

}  // namespace

measurements::MeasuredRun RecordedInputs::make_rows(const RunSpec& spec) const {
  const measurements::MeasuredRun longer = add_run_up(run, run_up_s);
  measurements::MeasuredRun rows;
  rows.id = run.id;
  rows.initial_tire_temperature_K = *initial_tire_K;
  rows.cold_pressure_Pa = *pressure_Pa;
  rows.rest_before_s = rest_before_s;
  rows.started_warm = tire_state.value == "warm";
  rows.force_at_standstill = run.force_at_standstill;
  rows.time_s = merge_times_s(longer.time_s, spec.sample_interval_s);
  for (const auto& [quantity, values] : longer.columns) {
    rows.columns[quantity] = resample(longer.time_s, values, quantity == quantities::kLoad, rows.time_s);
  }
  return rows;
}

FollowedRows measure_rows(const measurements::MeasuredRun& run) {
  return {run.id, run.time_s.back() - run.time_s.front(), calc_distance_m(run.time_s, run.column(quantities::kSpeed))};
}

TireCourse read_tire_course(const sim::Recording<double>& recording, double pressure_set_Pa) {
  const std::vector<double>& liner_K = recording.channel(quantities::kLinerTemperature);
  return {*std::max_element(liner_K.begin(), liner_K.end()), liner_K.back(), pressure_set_Pa,
          recording.channel(quantities::kCavityPressure).back()};
}

}  // namespace rollrig::scenarios
