#include "diagnosis/kinds/test_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/checks/rig_sensors.h"
#include "diagnosis/kinds/measurement_kind.h"

namespace rollrig::diagnosis {
namespace {

namespace quantities = models::quantities;

constexpr double kSetUp_h = 0.5;
constexpr double kAcceleration_km_h_s = 1.0;

/// The column of weights on the force sensor; without a name where the kind has none.
Quantity find_hung_column(const rigs::MachineKind& kind) {
  for (const rigs::Column& column : kind.columns.optional_given) {
    if (column.quantity == quantities::kHungTorque || column.quantity == quantities::kHungForce) return column.quantity;
  }
  return {};
}

}  // namespace

TestConditions find_test_conditions(const PreparedSet& set) {
  std::vector<double> pressures_Pa;
  for (const PreparedRun& run : set.runs()) pressures_Pa.push_back(run.measured.cold_pressure_Pa);
  std::nth_element(pressures_Pa.begin(), pressures_Pa.begin() + static_cast<std::ptrdiff_t>(pressures_Pa.size() / 2),
                   pressures_Pa.end());
  double load_N = 0.0;
  for (const PreparedRun& run : set.runs()) {
    const std::vector<double>& loads_N = run.measured.column(quantities::kLoad);
    load_N = std::max(load_N, *std::max_element(loads_N.begin(), loads_N.end()));
  }
  return {load_N,
          set.context().skim_load_N,
          pressures_Pa[pressures_Pa.size() / 2],
          set.kind().usual_ambient_K(set.source()),
          set.channels(),
          {},
          find_hung_column(*set.source().kind)};
}

RunPlan::RunPlan(const TestConditions& conditions, double first_km_h)
    : conditions_(conditions), speed_km_h_(first_km_h) {
  run_.initial_tire_temperature_K = conditions.ambient_K;
  run_.cold_pressure_Pa = conditions.pressure_Pa;
}

RunPlan& RunPlan::roll(double minutes, double load_N, double speed_km_h, bool read) {
  load_N_ = load_N;
  read_ = read;
  const double change_km_h = speed_km_h - speed_km_h_;
  const double start_km_h = speed_km_h_;
  const auto ramp = static_cast<int>(std::ceil(std::abs(change_km_h) / kAcceleration_km_h_s / kVirtualRow_s - 1e-9));
  for (int i = 0; i < ramp; ++i) add_row(start_km_h + change_km_h * i / ramp);
  const auto steady = static_cast<int>(std::lround(60.0 * minutes / kVirtualRow_s));
  for (int i = 0; i < steady; ++i) add_row(speed_km_h);
  speed_km_h_ = speed_km_h;
  return *this;
}

RunPlan& RunPlan::roll_at_loads(double minutes, const std::vector<double>& loads_N, double speed_km_h) {
  for (const double load_N : loads_N) roll(minutes, load_N, speed_km_h);
  return *this;
}

RunPlan& RunPlan::roll_at_speeds(double minutes, double load_N, const std::vector<double>& speeds_km_h) {
  for (const double speed_km_h : speeds_km_h) roll(minutes, load_N, speed_km_h);
  return *this;
}

RunPlan& RunPlan::pull(double longitudinal_force_N) {
  conditions_.held[quantities::kLongitudinalForce] = longitudinal_force_N;
  return *this;
}

RunPlan& RunPlan::at_pressure(double pressure_Pa) {
  run_.cold_pressure_Pa = pressure_Pa;
  return *this;
}

RunPlan& RunPlan::on_surface(double surface_K) {
  surface_K_ = surface_K;
  return *this;
}

RunPlan& RunPlan::hang(double torque_or_force) {
  hung_ = torque_or_force;
  return *this;
}

RunPlan& RunPlan::coast(double load_N, double speed_km_h,
                        const std::function<double(double speed_m_s)>& calc_slowing_m_s2) {
  load_N_ = load_N;
  read_ = true;
  constexpr double kStep_km_h = 0.1;  // a row, so that a program has round numbers
  while (speed_km_h_ > speed_km_h) {
    add_row(speed_km_h_);
    const double lost_km_h = 3.6 * calc_slowing_m_s2(speed_km_h_ / 3.6) * kVirtualRow_s;
    speed_km_h_ =
        kStep_km_h * (std::round(speed_km_h_ / kStep_km_h) - std::max(1.0, std::round(lost_km_h / kStep_km_h)));
  }
  speed_km_h_ = speed_km_h;
  return *this;
}

RunPlan& RunPlan::reversed() {
  run_.reversed = true;
  return *this;
}

measurements::MeasuredRun RunPlan::finish() {
  add_row(speed_km_h_);
  const auto hangs = [](double torque_or_force) { return torque_or_force != 0.0; };
  if (std::any_of(hung_by_row_.begin(), hung_by_row_.end(), hangs)) run_.columns[conditions_.hung] = hung_by_row_;
  return run_;
}

void RunPlan::add_row(double speed_km_h) {
  const bool first = run_.time_s.empty();
  run_.time_s.push_back(first ? 0.0 : run_.time_s.back() + kVirtualRow_s);
  run_.columns[quantities::kSpeed].push_back(speed_km_h / 3.6);
  run_.columns[quantities::kLoad].push_back(load_N_);
  run_.columns[quantities::kAmbient].push_back(conditions_.ambient_K);
  hung_by_row_.push_back(hung_);
  for (const auto& [column, value] : conditions_.held) run_.columns[column].push_back(value);
  if (surface_K_ > 0.0) run_.columns[quantities::kSurfaceTemperature].push_back(surface_K_);
  for (const Quantity& channel : conditions_.channels) {
    run_.columns[channel].push_back(read_ ? 0.0 : std::numeric_limits<double>::quiet_NaN());
  }
}

RunPlan begin_warm(const TestConditions& at) { return begin_cold(at).roll(kWarmUp_min, at.load_N, kUsual_km_h, false); }

RunPlan begin_cold(const TestConditions& at) { return {at, kUsual_km_h}; }

TestConditions read_too(TestConditions at, const Quantity& channel) {
  const bool is_read = std::find(at.channels.begin(), at.channels.end(), channel) != at.channels.end();
  if (!is_read) at.channels.push_back(channel);
  return at;
}

TestConditions read_rim_too(TestConditions at) { return read_too(std::move(at), quantities::kRimTemperature); }

PlannedTest fit_rim_thermocouple(PlannedTest test) {
  test.hours += find_rig_sensor(quantities::kRimTemperature).hours;
  test.extra.sensors = {quantities::kRimTemperature};
  test.by_hand = {"Fit a thermocouple to the rim, with a slip ring or a logger on the wheel."};
  return test;
}

PlannedTest make_test(const char* id, std::string description, int soaks, std::vector<RunPlan> runs) {
  PlannedTest test{id, std::move(description), kSetUp_h + soaks * kSoak_h, {}, {}, false, soaks > 0};
  for (RunPlan& plan : runs) {
    measurements::MeasuredRun run = plan.finish();
    run.id = fmt::format("{}-{}", id, test.runs.size() + 1);
    run.session = run.reversed ? "next, reversed" : "next";
    test.hours += run.time_s.back() / 3600.0;
    test.runs.push_back(std::move(run));
  }
  return test;
}

}  // namespace rollrig::diagnosis
