/// Wind along the road, in gusts or by the turns of the road, and a slope that the map does not have.
#include <array>
#include <cmath>

#include "sim/core/units.h"
#include "validation/generator/effect.h"

namespace rollrig::generator::wind_and_grade {

/// What comes with the wind beside its speed: drag of its side part and a slope, in proportion to its strength.
auto draw_side_and_slope(Making& of) {
  const double slope = 0.01 * of.draws.uniform(-0.25, 0.25);
  of.note("slope_percent_at_5_m_s", 100.0 * slope);
  const double side = of.draw("drag_of_side_wind", uniform(0.0, 0.05));
  const double strength = std::abs(of.size) / 5.0;
  return [=](Instant& now) {
    now.drag_factor *= 1.0 + side * strength;
    now.body_force_N += now.specimen->truth(Base::kMass) * kStandardGravity_m_s2 * slope * strength;
  };
}

template <std::size_t count>
std::array<double, count> draw_phases(Making& of) {
  std::array<double, count> phases{};
  for (double& phase : phases) phase = of.draws.uniform(0.0, 6.2831853);
  return phases;
}

void make_gusts(Making& of) {
  static constexpr std::array<double, 5> kPeriods_s{4.0, 9.0, 21.0, 47.0, 110.0};  // over 2 pi
  const double wind_m_s = of.size;
  const double gusts_share = of.draw("gusts_share", uniform(0.1, 0.3));
  const double days_share = of.draw("days_share", uniform(0.0, 0.3));
  const auto add_side_and_slope = draw_side_and_slope(of);
  const auto phases = draw_phases<kPeriods_s.size()>(of);
  of.effect.state_count = 1;
  of.effect.start = [=](const RunStart& start, double* run) {
    run[0] = 1.0 + days_share * std::sin(2.4 * static_cast<double>(start.index) + phases[0]);
  };
  of.effect.act = [=](const double* run, Instant& now) {
    double gusts = 0.0;
    for (std::size_t i = 0; i < phases.size(); ++i) {
      gusts += std::sin(now.time_s / kPeriods_s[i] + phases[i]) / std::sqrt(0.5 * static_cast<double>(phases.size()));
    }
    now.wind_m_s += wind_m_s * run[0] * (1.0 + gusts_share * gusts);
    add_side_and_slope(now);
  };
}

/// Wind that the turns of the road bring more or less against the vehicle: sines of the distance.
void make_turning_road(Making& of) {
  static constexpr std::array<double, 4> kLengths_m{90.0, 250.0, 700.0, 1800.0};  // over 2 pi; Assumed
  const double wind_m_s = of.size;
  const double turning_share = of.draw("turning_share", uniform(0.2, 0.5));
  const auto add_side_and_slope = draw_side_and_slope(of);
  const auto phases = draw_phases<kLengths_m.size()>(of);
  of.effect.state_count = 1;
  of.effect.start = [](const RunStart& start, double* run) { run[0] = 2.4 * static_cast<double>(start.index); };
  of.effect.act = [=](const double* run, Instant& now) {
    double turns = 0.0;
    for (std::size_t i = 0; i < phases.size(); ++i) {
      turns += std::sin(now.distance_m / kLengths_m[i] + phases[i] + run[0]);
    }
    now.wind_m_s += wind_m_s * (1.0 + turning_share * turns / std::sqrt(0.5 * static_cast<double>(phases.size())));
    add_side_and_slope(now);
  };
}

const EffectKind kind{
    "wind_and_grade",
    {"m/s", "mean wind against the vehicle", 0.0, -20.0, 20.0, normal(-5.0, 5.0, -8.0, 8.0), false, 0.8},
    {{"gusts",
      "mean wind with gusts of five periods and a spread over the trips, drag of its side part, and a slope in "
      "proportion",
      make_gusts},
     {"turning_road",
      "mean wind that the turns of the road bring more or less against the vehicle, by distance, drag of its side "
      "part, and a slope in proportion",
      make_turning_road}},
    on_roads,
    on_roads};

}  // namespace rollrig::generator::wind_and_grade
