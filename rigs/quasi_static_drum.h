#pragma once
/// The drum rig, or the belt, with its mechanics in equilibrium: thermal and effect states alone, and the speed when
/// the motor is off.

#include "rigs/drum_channels.h"
#include "rigs/quasi_static_rig.h"

namespace rollrig::rigs {

/// Equation  torque = R (F_rr + F_par + m_eff a + s m_w a),  m_eff = j m_r + m_w;  off: a = -(F_rr + F_par)/m_eff;
///           the wheel: models/wheel/rolling_wheel.h without a force of its hub
/// Symbols   R torque over force at the surface [m], 1 of a belt, m_r equivalent mass of the drum, j factor on it
///           (1 in the baseline), m_w of the wheel's spin [kg], a acceleration of the surface [m/s2],
///           s slip [1]
/// Validity  slow against the load cylinder's and the speed controller's settling (a few seconds)
/// Energy    at a knot where load or speed jump, kinetic and spring energy jump; that is the term
///           "load_changes" of the mechanical audit
/// Source    momentum of the wheel and of the surface under it; §3.2.3.2
/// Checked   tests/rigs/fidelities_test.cpp
template <class S>
class QuasiStaticDrum : public QuasiStaticRig<S> {
 public:
  QuasiStaticDrum(models::Corner<S>& corner, RigStart<S> start, bool surface_recorded, Detail detail);

  void initialize(const sim::Segment& first, double time_s, S* state) override;
  void begin_segment(const sim::Segment& segment, double time_s, S* state, S* integrals) override;
  void evaluate(double time_s, const S* state, S* rates, S* integrands) override;
  void observe(double time_s, const S* state, S* values) override;
  void calc_stored(double time_s, const S* state, S* stored_J) override;

 private:
  using Base = QuasiStaticRig<S>;
  using Base::present_;
  using Base::wheels_;
  static constexpr std::size_t kSpeedState = 0;

  models::Instant<S>& apply_inputs_at(double time_s, const S* state);
  void find_motion(double time_s, const S* state);
  void fill_integrands(S* integrands) const;
  S calc_effective_mass_kg() const;
  S calc_kinetic_J() const;
  S calc_spring_J() const;
  S find_recorded_speed_m_s(double time_s, const S* state) override;

  const models::Context<S>& context() const { return wheels_.front().corner->context(); }
  models::Instant<S>& now() { return wheels_.front().now; }
  const models::Instant<S>& now() const { return wheels_.front().now; }

  Detail detail_;
  S motor_torque_Nm_{};
};

extern template class QuasiStaticDrum<double>;
extern template class QuasiStaticDrum<Jet>;

}  // namespace rollrig::rigs
