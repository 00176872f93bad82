#pragma once
/// Deceleration of a coasting body at one speed, with its uncertainty.

#include <string>

#include "estimation/drum_deceleration/coast_cleaning.h"

namespace rollrig::estimation {

/// A range of speed that is left out of fits.
struct SpeedRange {
  double from_m_s = 0.0;
  double to_m_s = 0.0;
  bool contains(double speed_m_s) const { return speed_m_s >= from_m_s && speed_m_s <= to_m_s; }
};
/// Whether a speed lies in one of these.
bool is_left_out(const std::vector<SpeedRange>& ranges, double speed_m_s);

struct FittedRow {
  double time_s = 0.0;
  double speed_m_s = 0.0;
  double fitted_m_s = 0.0;
  double weight = 0.0;  // 0 left out by the robust fit, 1 wholly in
};

struct DecelerationFit {
  bool available = false;
  std::string why;           // when it is not
  double value_m_s2 = 0.0;   // -dv/dt at the speed
  double sd_m_s2 = 0.0;      // from the scatter of this run's rows, their correlation counted
  double scatter_m_s = 0.0;  // robust standard deviation of the rows
  std::size_t rows = 0;
  std::vector<FittedRow> residuals;
};

/// Fits the speed over time about one speed.
/// Equation  dv/dt = -(a_0 + a_1 x + a_2 x^2), x = (v - v_0)/h, its solution fitted to the rows with v_0 - h < v <
///           v_0 + h by least squares with Tukey's weights (c = 4.685 robust standard deviations, Huber's first);
///           a_0 is the deceleration at v_0. Ranges left out split the rows; each part begins at a speed of its own.
/// Symbols   h half the band, at most 0.75 v_0
/// Validity  rows on both sides of v_0; standard deviation by Newey and West's estimator, since rows of one turn
///           of the drum are not independent
/// Source    Holland and Welsch, Communications in Statistics A6 (1977) 813 (the weights); Newey and West,
///           Econometrica 55 (1987) 703; the same, Review of Economic Studies 61 (1994) 631 (how many rows are taken
///           as correlated). Assumed: the law is a quadratic within the band.
/// Checked   tests/estimation/deceleration_fit_test.cpp
DecelerationFit fit_deceleration(const Coast& coast, double speed_m_s, double half_band_m_s,
                                 const std::vector<SpeedRange>& left_out);

}  // namespace rollrig::estimation
