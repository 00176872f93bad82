#include "rigs/simbody_system.h"

#include <algorithm>
#include <utility>

namespace rollrig::rigs {

SimbodySystem::SimbodySystem(std::vector<sim::Integral> integrals, std::vector<sim::Store> stores,
                             std::vector<sim::Channel> channels)
    : matter_(system_),
      forces_(system_),
      gravity_(forces_, matter_, SimTK::Vec3(0, -kStandardGravity_m_s2, 0)),
      integrals_(std::move(integrals)),
      stores_(std::move(stores)),
      channels_(std::move(channels)) {
  matter_.setShowDefaultGeometry(false);
}

void SimbodySystem::realize_topology() {
  state_ = system_.realizeTopology();
  system_.realizeModel(state_);
}

void SimbodySystem::evaluate(double time_s, const double* y, double* rates, double* integrands) {
  set_state(time_s, y);
  if (rates != nullptr) {
    system_.realize(state_, SimTK::Stage::Acceleration);
    const SimTK::Vector& y_dot = state_.getYDot();
    std::copy(&y_dot[0], &y_dot[0] + y_dot.size(), rates);
  }
  if (integrands != nullptr) {
    system_.realize(state_, SimTK::Stage::Dynamics);
    fill_integrands(integrands);
  }
}

void SimbodySystem::take_segment(const sim::Segment& segment, double time_s) {
  segment_ = segment;
  segment_start_s_ = time_s;
  state_.invalidateAllCacheAtOrAbove(SimTK::Stage::Time);
}

void SimbodySystem::set_state(double time_s, const double* y) {
  const SimTK::Vector& present = state_.getY();
  if (state_.getTime() == time_s && std::equal(y, y + present.size(), &present[0])) return;
  state_.setTime(time_s);
  SimTK::Vector& all = state_.updY();
  std::copy(y, y + all.size(), &all[0]);
}

void SimbodySystem::copy_state(double* y) const {
  const SimTK::Vector& all = state_.getY();
  std::copy(&all[0], &all[0] + all.size(), y);
}

}  // namespace rollrig::rigs
