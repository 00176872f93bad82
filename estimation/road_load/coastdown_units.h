#pragma once
/// Whether times and speeds of coastdowns are in the units of their columns.

#include <optional>
#include <string>
#include <vector>

#include "estimation/road_load/coastdown_file.h"

namespace rollrig::estimation {

/// Throws InputError where the runs of a file do not slow down as coasting road vehicles do: their times or speeds are
/// in another unit.
/// Equation  median of the decelerations of the runs over the middle half of their speeds
/// Checked   tests/estimation/coastdown_units_test.cpp
void require_coasting_decelerations(const CoastdownFile& file);

/// A question about speeds that end where those of a car in m/s do, and whose decelerations fall as only those of high
/// speeds in km/h do. It needs no wind and no mass.
/// Equation  r = a_1/a_2, mean decelerations from 95 to 75 % and from 45 to 25 % of the highest speed; median of runs
/// Assumed: below 60 km/h r is at most 1.6 of road vehicles, and 2 to 4 from 130 km/h on; doubted above 1.9
/// Checked   tests/estimation/coastdown_units_test.cpp
std::optional<std::string> doubt_speeds_in_m_s(const CoastdownData& data);

/// Puts that question before all warnings, unless one of them says the same.
void put_speed_unit_doubt(const CoastdownData& data, std::vector<std::string>& warnings);

/// Which of two speed columns looks as if it were in another unit than km/h, if one is `ratio` times the other:
/// "; speed_km_h looks as if it were in mph". Empty where no unit explains the ratio to the relative tolerance.
/// Checked   tests/estimation/coastdown_units_test.cpp
std::string guess_speed_unit(double ratio, const std::string& column, const std::string& other, double tolerance);

}  // namespace rollrig::estimation
