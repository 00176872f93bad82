#include "validation/generator/speed_trace.h"

#include <algorithm>
#include <cmath>

namespace rollrig::generator {

void SpeedTrace::add(double speed_m_s) {
  // To what a file holds: the truth runs through the recorded values.
  speeds_m_s_.push_back(std::round(std::max(0.0, speed_m_s) * 3.6e4) / 3.6e4);
}

void SpeedTrace::hold(double seconds) {
  const double speed = speed_m_s();
  for (int i = 0; i < static_cast<int>(seconds); ++i) add(speed);
}

void SpeedTrace::ramp(double speed_km_h, double rate_m_s2) {
  const double from = speed_m_s();
  const double to = speed_km_h / 3.6;
  const int steps = static_cast<int>(std::ceil(std::abs(to - from) / rate_m_s2));
  for (int i = 1; i <= steps; ++i) add(from + (to - from) * i / steps);
}

void SpeedTrace::cycle(const std::vector<double>& speeds_km_h) {
  for (std::size_t i = 1; i < speeds_km_h.size(); ++i) add(speeds_km_h[i] / 3.6);
}

}  // namespace rollrig::generator
