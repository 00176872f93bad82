#include "validation/generator/campaign.h"

#include <algorithm>
#include <cmath>

namespace blind {

double Leg::slope() const {
  const double way_m = mean_m_s() * duration_s;
  return way_m > 0.0 ? (end_elevation_m - start_elevation_m) / way_m : 0.0;
}

double Air::at(double time_s) const {
  constexpr double kPi = 3.14159265358979323846;
  return mean_degC + swing_dK * std::sin(2.0 * kPi * time_s / period_s + phase) + slope_K_per_s * time_s;
}

Air draw_air(Draws& draws, double mean_degC) {
  constexpr double kPi = 3.14159265358979323846;
  Air air;
  air.mean_degC = mean_degC + draws.uniform(-0.6, 0.6);
  air.swing_dK = draws.uniform(0.1, 0.5);
  air.period_s = draws.uniform(900.0, 2500.0);
  air.phase = draws.uniform(0.0, 2.0 * kPi);
  air.slope_K_per_s = draws.uniform(-0.7, 0.7) / 3600.0;
  return air;
}

bool RunPlan::is_read(double time_s) const {
  return std::none_of(unread_s.begin(), unread_s.end(),
                      [time_s](const auto& span) { return time_s >= span.first && time_s < span.second; });
}

double RunPlan::hung_at(double time_s) const {
  double torque_Nm = 0.0;
  for (const auto& [from_s, torque_then_Nm] : hung_Nm) {
    if (time_s >= from_s) torque_Nm = torque_then_Nm;
  }
  return torque_Nm;
}

Campaign draw_campaign(std::uint64_t seed, const Specimen& specimen, int runs, DynoRuns dyno_runs) {
  if (specimen.kind == Kind::kDyno) return draw_dyno_campaign(seed, specimen, runs, dyno_runs);
  if (specimen.kind == Kind::kRoad) return draw_road_campaign(seed, specimen, runs);
  return draw_drum_campaign(seed, specimen, runs);
}

}  // namespace blind
