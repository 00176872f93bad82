#pragma once
/// From decelerations of runs to what is asked for at each speed: levels, ratios, exponents, directions.

#include "estimation/drum_deceleration/coast_statistics.h"

namespace rollrig::estimation {

/// Tables of all states and bodies, and what is the same at every speed.
struct Tables {
  RunTable loaded, drum_alone, wheel_alone;
  Levels levels;
  double mass_ratio = 0.0;
};

/// Tables of the fit's decelerations.
Tables make_tables(const CoastSet& set, const DrumCoastdownFit& fit);

/// Slope of ln(net) over ln(p) through the levels, and what each level's ln(net) counts in it.
struct PowerLaw {
  double slope = 0.0;
  std::vector<double> weights;
  double residual_variance = 0.0;
  double weights_squared = 0.0;
};
PowerLaw fit_power_law(const std::vector<double>& pressures_Pa, const std::vector<double>& net_m_s2);

/// Everything at one speed but the ratios.
SpeedPoint evaluate_speed(const CoastSet& set, const Tables& tables, const DrumCoastdownFit& fit, std::size_t index);

/// Index of the speed asked for that is nearest to the reference.
std::size_t find_reference_speed(const CoastSet& set);

/// Ratio of every level to the reference pressure and speed; a warning where there is no reference.
void add_ratios(const CoastSet& set, const Tables& tables, DrumCoastdownFit& fit);

}  // namespace rollrig::estimation
