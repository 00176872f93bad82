#pragma once
/// Whether times and speeds of coastdowns are in the units of their columns.

#include <string>

#include "estimation/road_load/coastdown_file.h"

namespace rollrig::estimation {

/// Throws InputError where the runs of a file do not slow down as coasting road vehicles do: their times or speeds are
/// in another unit.
/// Equation  median of the decelerations of the runs over the middle half of their speeds
/// Checked   tests/estimation/coastdown_units_test.cpp
void require_coasting_decelerations(const CoastdownFile& file);

/// Which of two speed columns looks as if it were in another unit than km/h, if one is `ratio` times the other:
/// "; speed_km_h looks as if it were in mph". Empty where no unit explains the ratio to the relative tolerance.
/// Checked   tests/estimation/coastdown_units_test.cpp
std::string guess_speed_unit(double ratio, const std::string& column, const std::string& other, double tolerance);

}  // namespace rollrig::estimation
