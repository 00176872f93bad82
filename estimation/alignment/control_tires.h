#pragma once
/// Control tires: whether a machine drifts, and whether a measurement falls out of the others.

#include <optional>
#include <string>
#include <vector>

#include "estimation/alignment/alignment_file.h"
#include "estimation/alignment/line_fit.h"

namespace rollrig::estimation {

/// From when on a control tire, or all of them, have another mean.
struct ControlShift {
  double from_s = 0.0;
  double by_N_per_kN = 0.0;
  double p_value = 1.0;  // Bonferroni
};

/// One control tire.
struct ControlChart {
  std::string tire;
  std::vector<double> time_s;
  std::vector<double> rrc_N_per_kN;
  double center_N_per_kN = 0.0;  // mean of all
  double sd_N_per_kN = 0.0;      // of one measurement, from the differences of neighbors in time
  double low_N_per_kN = 0.0;     // center - 3 sd - half a step of the values
  double high_N_per_kN = 0.0;
  std::vector<std::size_t> outside;  // indices beyond these limits
  std::size_t longest_run = 0;       // measurements in a row on one side of the center, by more than half a step
  std::optional<ControlShift> shift;
  double largest_gap_days = 0.0;
};

/// Slope over time that all control tires have in common.
struct ControlDrift {
  double N_per_kN_per_year = 0.0;
  double low_95 = 0.0, high_95 = 0.0;
  double degrees_of_freedom = 0.0;
  double p_value = 1.0;
  double over_time_N_per_kN = 0.0;  // from the first to the last measurement
};

struct ControlMonitoring {
  std::vector<ControlChart> charts;
  std::optional<ControlDrift> drift;  // where there are measurements enough
  std::optional<ControlShift> shift;  // of all tires, where it is significant and likelier than a drift
};

inline constexpr std::size_t kLeastControlMeasurements = 5;  // Assumed: of a chart of its own
inline constexpr std::size_t kMostOnOneSide = 8;             // Western Electric rule 4. Second-hand
inline constexpr double kDriftLevel = 0.005;                 // Assumed: of significance; 0.01 of drift and shift
inline constexpr double kShiftLevel = 0.005;                 // Assumed: of a shift

/// Charts of individual values, and the drift.
///
/// Equation  sd = mean |x_i - x_(i-1)|/1.128; limits center +- (3 sd + step/2), since a value may be half
///           a step nearer before its rounding;
///           x = level of the tire + slope t, least squares over all tires with one slope; t test of it;
///           sd, and that about the slope, not below the rounding of the values, step/sqrt(12) of all tires;
///           shift: the same with 1 from a day on, else 0, for t; the day, with two measurements on each side at least,
///           of the greatest t; Bonferroni over the days. Of drift and shift, the one of the smaller p. A chart has the
///           shift of its tire alone, the monitoring the one that all tires have in common
/// Validity  a common slope: a machine that drifts by a share moves tires of different RRc by different amounts, of
///           which this is the mean. A tire that ages drifts as well: several control tires tell it from the machine
/// Source    ISO 7870-2, charts of individuals and moving ranges (1.128 = d2 of two values). Second-hand
/// Checked   tests/estimation/control_tires_test.cpp
ControlMonitoring watch_control_tires(const std::vector<ControlTire>& tires);

/// Whether a drift or a shift of all control tires is significant, or a chart is out of control.
bool has_drift(const ControlMonitoring& monitoring);
bool is_out_of_control(const ControlChart& chart);

}  // namespace rollrig::estimation
