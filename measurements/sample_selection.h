#pragma once
/// Which samples of a measured run a comparison may use.

#include <vector>

#include "measurements/measurement_set.h"

namespace rollrig::measurements {

constexpr double kSettling_s = 30.0;               // Assumed: by then load cylinder and speed controller rest
constexpr double kLoadedShare = 0.2;               // Assumed: above this share of the reference load a tire is loaded
constexpr double kSteadyAcceleration_m_s2 = 0.05;  // Assumed
constexpr double kTrustedSpeed_m_s = 20.0 / 3.6;   // §4.2.1: the source trusts its law from 20 km/h up

/// Whether the load at a row is another than at the row before, by more than load control holds it (1 %).
bool is_load_change(const MeasuredRun& run, std::size_t row);

/// Acceleration between a row and the next.
double find_acceleration(const MeasuredRun& run, std::size_t row);

/// Rows whose torque is free of the settling of load cylinder and speed controller: 30 s after each load
/// change and each kink of the speed, and faster than 20 km/h.
std::vector<bool> find_settled_rows(const MeasuredRun& run);

/// Rows of a channel that a comparison uses: those with a sample; of the torque, those that are settled.
std::vector<std::size_t> find_compared_rows(const MeasuredRun& run, const Quantity& channel);

/// Mean time between the rows of a run.
double calc_mean_interval_s(const MeasuredRun& run);

/// Times of these rows.
std::vector<double> find_times(const MeasuredRun& run, const std::vector<std::size_t>& rows);

}  // namespace rollrig::measurements
