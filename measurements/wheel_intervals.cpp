#include "measurements/wheel_intervals.h"

#include <cmath>

namespace rollrig::measurements {
namespace {

constexpr double kLongest_s = 2.5;

/// Inputs at a share of the way from one row to the next.
class RowPair {
 public:
  RowPair(const MeasuredRun& run, std::size_t row) : run_(run), row_(row) {}

  double at(const char* column, double share) const {
    const std::vector<double>& values = run_.columns.at(column);
    return values[row_] + share * (values[row_ + 1] - values[row_]);
  }
  double change(const char* column) const { return at(column, 1.0) - at(column, 0.0); }

 private:
  const MeasuredRun& run_;
  std::size_t row_;
};

double find_slope(const RowPair& rows, double duration_s) {
  constexpr double kSlowest_m_s = 1.0;  // Assumed: below it the way is too short to tell
  const double speed_m_s = rows.at("speed_km_h", 0.5);
  return speed_m_s < kSlowest_m_s ? 0.0 : rows.change("elevation_m") / (speed_m_s * duration_s);
}

/// Root mean square of a force that runs linearly by `change` about `middle`, with the sign of its middle.
double calc_rms_with_sign(double middle, double change) {
  return std::copysign(std::sqrt(middle * middle + change * change / 12.0), middle);
}

}  // namespace

std::vector<WheelInterval> make_wheel_intervals(const MeasuredRun& run) {
  std::vector<WheelInterval> intervals;
  for (std::size_t row = 0; row + 1 < run.time_s.size(); ++row) {
    const RowPair rows(run, row);
    const double between_s = run.time_s[row + 1] - run.time_s[row];
    auto parts = static_cast<int>(std::ceil(between_s / kLongest_s - 1e-9));
    if (parts > 1) parts += parts % 2;  // so that none lies across the middle
    WheelInterval part;
    part.duration_s = between_s / parts;
    part.acceleration_m_s2 = rows.change("speed_km_h") / between_s;
    part.row = row;
    if (run.has("load_N")) part.load_N = run.columns.at("load_N")[row];
    if (run.has("elevation_m")) part.slope = find_slope(rows, between_s);
    for (int i = 0; i < parts; ++i) {
      const double share = (i + 0.5) / parts;
      part.speed_m_s = rows.at("speed_km_h", share);
      part.ambient_K = rows.at("ambient_degC", share);
      part.surface_K =
          run.has("surface_temperature_degC") ? rows.at("surface_temperature_degC", share) : part.ambient_K;
      if (run.has("longitudinal_force_N")) {
        part.longitudinal_force_N =
            calc_rms_with_sign(rows.at("longitudinal_force_N", share), rows.change("longitudinal_force_N") / parts);
      }
      part.share_of_row = parts == 1 ? 0.5 : (share < 0.5 ? 1.0 : 0.0);
      intervals.push_back(part);
    }
  }
  return intervals;
}

}  // namespace rollrig::measurements
