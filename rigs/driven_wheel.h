#pragma once
/// One wheel of another program's vehicle: that program gives its motion, load, drive and surroundings.

#include <array>

#include "rigs/recorded_roller.h"

namespace rollrig::rigs {

/// One wheel on a roller, a drum, a belt or the road, driven by a force of its hub. Inputs are those of a
/// RecordedRoller, but its longitudinal force is that of the hub: torque divided by the loaded radius; positive when it
/// drives.
///
/// Equation  force of the surface on the wheel  X = F_rr/(1 + r_l k) + I_spin a/r_l^2 - D;  all else RecordedRoller
/// Symbols   D force of the hub [N]; as in models/wheel/rolling_wheel.h
/// Validity  slip well below 1: what it adds to the equivalent mass of the spin is left out
/// Source    balance of the wheel's spin
/// Checked   tests/fmu/model_exchange_test.cpp
template <class S>
class DrivenWheel : public RecordedRoller<S> {
 public:
  using RecordedRoller<S>::RecordedRoller;

  /// What is given beside the program: the acceleration, and derivatives of inputs.
  struct Given {
    S acceleration_m_s2{};
    std::array<S, kRollerInputCount> seeds{};  // of value 0, in the order of the inputs
  };
  void set_given(const Given& given) { given_ = given; }

  /// Everything as evaluate() left it.
  const models::Instant<S>& now() const { return this->wheel().now; }
  /// F_rr, parasitic loss and slip; RecordedRoller's loss_force.
  const S& loss_force_N() const { return this->force_N_; }

 private:
  void read_inputs(double time_s, std::size_t wheel, models::InputPort<S>& inputs) const override;
  void find_force() override;

  Given given_;
};

extern template class DrivenWheel<double>;
extern template class DrivenWheel<Jet>;

}  // namespace rollrig::rigs
