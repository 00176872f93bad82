#pragma once
/// The equations of a warm wheel for one scalar.

#include "fmu/wheel_model.h"
#include "rigs/driven_wheel.h"

namespace rollrig::fmu {

template <class S>
struct WheelEquations {
  explicit WheelEquations(const WheelModel& model)
      : corner(models::convert_context<S>(model.context), model.effects),
        wheel(corner, make_start(model), true, rigs::Detail::kFull),
        states(corner.state_count()),
        rates(corner.state_count()),
        integrals(wheel.integrals().size()) {}
  WheelEquations(const WheelEquations&) = delete;  // the wheel refers to the corner
  WheelEquations& operator=(const WheelEquations&) = delete;

  /// Fills rates and integrals, at the start of a segment.
  void evaluate(const sim::Segment& segment, double time_s) {
    wheel.begin_segment(segment, time_s, states.data(), integrals.data());
    wheel.evaluate(time_s, states.data(), rates.data(), integrals.data());
  }

  models::Corner<S> corner;
  rigs::DrivenWheel<S> wheel;
  std::vector<S> states, rates, integrals;

 private:
  static rigs::RigStart<S> make_start(const WheelModel& model) {
    rigs::RigStart<S> start;
    start.tire_temperature_K = S(model.tire_temperature_K);
    start.cold_pressure_Pa = S(model.cold_pressure_Pa);
    start.ambient_pressure_Pa = S(model.ambient_pressure_Pa);
    return start;
  }
};

}  // namespace rollrig::fmu
