#pragma once
/// Speeds at whole seconds, from standstill on: what a driver on a dyno or on the road does.

#include <vector>

namespace rollrig::generator {

class SpeedTrace {
 public:
  double now_s() const { return static_cast<double>(speeds_m_s_.size()) - 1.0; }
  double speed_m_s() const { return speeds_m_s_.back(); }
  const std::vector<double>& speeds_m_s() const { return speeds_m_s_; }

  /// The speed one second later.
  void add(double speed_m_s);
  void hold(double seconds);
  void ramp(double speed_km_h, double rate_m_s2);
  /// A cycle as published, which starts and ends at rest.
  void cycle(const std::vector<double>& speeds_km_h);

 private:
  std::vector<double> speeds_m_s_{0.0};
};

}  // namespace rollrig::generator
