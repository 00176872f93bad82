#pragma once
/// How fast the states of a warm wheel can change by themselves, which bounds the step of an integrator.

#include "fmu/wheel_equations.h"
#include "sim/program.h"

namespace rollrig::fmu {

/// Equation  the spectral radius of J = d(dx/dt)/dx [1/s]
/// Symbols   x states of models/corner.h
/// Accuracy  J is exact (dual numbers)
/// Checked   tests/fmu/stable_step_test.cpp
class FastestRate {
 public:
  explicit FastestRate(const WheelModel& model);

  /// With the inputs at the start of `inputs`, at these states, which are those of the corner.
  double calc_per_s(const sim::Segment& inputs, double acceleration_m_s2, const double* states);
  /// Without drive, at standstill or at the highest speed, whichever is faster. It depends on the parameters alone.
  double usual_per_s() const { return usual_per_s_; }

 private:
  WheelEquations<Jet> equations_;
  double usual_per_s_ = 0.0;
};

/// Of the parameters of a wheel the one that a rate follows most. Those that differ from the original wheel come first,
/// since somebody has set them.
struct Culprit {
  std::string name;
  Field field;
  double value_SI = 0.0;
  double exponent = 0.0;  // the rate grows with this power of the value
};
Culprit find_culprit(const WheelModel& model, const WheelModel& original);

}  // namespace rollrig::fmu
