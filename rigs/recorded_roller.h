#pragma once
/// One measured wheel of a vehicle on the roller of a dynamometer, simulated again.

#include "rigs/drum_channels.h"
#include "rigs/recorded_wheel.h"

namespace rollrig::rigs {

/// Input of a roller's program after those of a drum: force of the wheel on the roller.
constexpr std::size_t kLongitudinalForceInput = kDrumInputCount;
constexpr std::size_t kRollerInputCount = kDrumInputCount + 1;

/// One wheel on the roller of a dynamometer. Its detail is measured: loss_force, readings of the tire, of the rim where
/// an effect has one, load under the wheel and surface speed as they are.
///
/// Equation  the wheel: models/wheel/rolling_wheel.h with X = -Fx, loss_force its calc_loss_force_N. Power of the hub
///           D v + X s v, of the roller (F_rr - F_rr/(1 + r_l k) + F_par + j m_r a + X) v; s left out of D
/// Symbols   as in rolling_wheel.h; Fx recorded force of the wheel on its roller, which is that of the contact; m_r
///           equivalent mass of the roller, j factor on it (1 in the baseline)
/// Source    momentum of the wheel and of the surface under it; §3.2.3.2
template <class S>
class RecordedRoller : public RecordedWheel<S> {
 public:
  RecordedRoller(models::Corner<S>& corner, RigStart<S> start, bool surface_recorded, Detail detail);

 protected:
  /// Force of the surface on the wheel, its slip, and what is measured.
  void put_force(const S& contact_N);
  void read_inputs(double time_s, std::size_t wheel, models::InputPort<S>& inputs) const override;

 private:
  void find_force() override;
  RecordedPowers<S> find_powers() const override;
};

extern template class RecordedRoller<double>;
extern template class RecordedRoller<Jet>;

}  // namespace rollrig::rigs
