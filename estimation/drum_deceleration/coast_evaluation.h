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

/// Everything at one speed but the ratios.
SpeedPoint evaluate_speed(const CoastSet& set, const Tables& tables, const DrumCoastdownFit& fit, std::size_t index);

/// Ratio of every level to the reference pressure and speed; a warning where there is no reference.
void add_ratios(const CoastSet& set, const Tables& tables, DrumCoastdownFit& fit);

}  // namespace rollrig::estimation
