#include "validation/generator/campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cmath>

namespace rollrig::generator {

using boost::math::constants::two_pi;

double Leg::slope() const {
  const double way_m = mean_m_s() * duration_s;
  return way_m > 0.0 ? (end_elevation_m - start_elevation_m) / way_m : 0.0;
}

void SpeedTrace::add(double speed_m_s) {
  // To what a file holds: the truth runs through the recorded values.
  speeds_m_s_.push_back(std::round(std::max(0.0, speed_m_s) * 3.6e4) / 3.6e4);
}

void SpeedTrace::hold(double seconds) {
  const double speed = speed_m_s();
  for (int i = 0; i < static_cast<int>(seconds); ++i) add(speed);
}

void SpeedTrace::ramp(double speed_km_h, double rate_m_s2) {
  const double from = speed_m_s();
  const double to = speed_km_h / 3.6;
  const int steps = static_cast<int>(std::ceil(std::abs(to - from) / rate_m_s2));
  for (int i = 1; i <= steps; ++i) add(from + (to - from) * i / steps);
}

void SpeedTrace::cycle(const std::vector<double>& speeds_km_h) {
  for (std::size_t i = 1; i < speeds_km_h.size(); ++i) add(speeds_km_h[i] / 3.6);
}

double Air::at(double time_s) const {
  return mean_degC + swing_dK * std::sin(two_pi<double>() * time_s / period_s + phase) + slope_K_per_s * time_s;
}

void add_runs(std::vector<RunPlan> further, Campaign& campaign) {
  for (RunPlan& run : further) {
    run.index = campaign.runs.size();
    campaign.runs.push_back(std::move(run));
  }
}

Air draw_air(Draws& draws, double mean_degC) {
  Air air;
  air.mean_degC = mean_degC + draws.uniform(-0.6, 0.6);
  air.swing_dK = draws.uniform(0.1, 0.5);
  air.period_s = draws.uniform(900.0, 2500.0);
  air.phase = draws.uniform(0.0, two_pi<double>());
  air.slope_K_per_s = draws.uniform(-0.7, 0.7) / 3600.0;
  return air;
}

bool RunPlan::is_read(double time_s) const {
  return std::none_of(unread_s.begin(), unread_s.end(),
                      [time_s](const auto& span) { return time_s >= span.first && time_s < span.second; });
}

double RunPlan::find_hung(double time_s) const {
  double hanging = 0.0;
  for (const auto& [from_s, hangs_then] : hung) {
    if (time_s >= from_s) hanging = hangs_then;
  }
  return hanging;
}

namespace {

/// A run as it starts, without its legs.
RunPlan start_run(Draws& own, std::size_t index, const RunKind& what, const Cooling& cooling,
                  const Specimen& specimen) {
  RunPlan run;
  run.id = fmt::format("{}-{}", index + 1, what.kind);
  std::replace(run.id.begin(), run.id.end(), ' ', '-');
  run.index = index;
  run.session = what.session;
  run.cold_pressure_kPa = what.pressure_kPa > 0.0 ? what.pressure_kPa : specimen.reference_pressure_kPa;
  run.air = draw_air(own, what.ambient_degC != 0.0 ? what.ambient_degC : specimen.ambient_degC);
  double warm_dK = 0.0;
  if (what.rest_before_min > 0.0) {
    run.rest_before_min = std::round(what.rest_before_min * own.uniform(0.7, 1.3));
    warm_dK =
        own.uniform(cooling.least_dK, cooling.most_dK) * std::exp(-*run.rest_before_min / cooling.time_constant_min);
  }
  run.initial_degC = std::round(10.0 * (run.air.at(0.0) + warm_dK)) / 10.0;
  return run;
}

}  // namespace

Campaign draw_runs(const CampaignOrder& order, const CampaignKind& kind, const Cooling& cooling,
                   const Specimen& specimen,
                   const std::function<std::vector<Leg>(Draws& own, const RunKind& what)>& draw_legs) {
  Campaign campaign{kind.name, {}};
  for (std::size_t i = 0; i < std::min(static_cast<std::size_t>(order.runs), kind.runs.size()); ++i) {
    RunKind what = kind.runs[i];
    if (!order.run_kind.empty()) what.kind = order.run_kind.c_str();
    Draws own(order.seed, fmt::format("run/{}", i));
    RunPlan run = start_run(own, i, what, cooling, specimen);
    run.legs = draw_legs(own, what);
    campaign.runs.push_back(std::move(run));
  }
  return campaign;
}

}  // namespace rollrig::generator
