#pragma once
/// The drum rig with its mechanics in equilibrium: thermal and effect states alone, and the speed when
/// the motor is off.

#include <vector>

#include "models/corner.h"
#include "models/wheel/rolling_wheel.h"
#include "rigs/drum_channels.h"
#include "sim/ode_system.h"

namespace rollrig::rigs {

/// Equation  torque = R (F_rr + F_par + m_eff a + s m_w a),  m_eff = j m_r + m_w;  off: a = -(F_rr + F_par)/m_eff;
///           the wheel: models/wheel/rolling_wheel.h without a force of its hub
/// Symbols   R torque over force at the surface [m], m_r equivalent mass of the drum, j factor on it (1 in the
///           baseline), m_w of the wheel's spin [kg], a acceleration of the surface [m/s2], s slip [1]
/// Validity  slow against the load cylinder's and the speed controller's settling (a few seconds)
/// Energy    at a knot where load or speed jump, kinetic and spring energy jump; that is the term
///           "load_changes" of the mechanical audit
/// Source    baseline.md, "Rig"
/// Checked   tests/rigs/fidelities_test.cpp, tests/rigs/fidelities_test.cpp
template <class S>
class QuasiStaticDrum : public sim::OdeSystem<S> {
 public:
  QuasiStaticDrum(models::Corner<S>& corner, DrumStart<S> start, bool surface_recorded, Detail detail);

  std::size_t state_count() const override { return kFirstCornerState + corner_.state_count(); }
  std::vector<double> state_tolerances() const override;
  const std::vector<sim::Integral>& integrals() const override { return integrals_; }
  const std::vector<sim::Store>& stores() const override { return stores_; }
  const std::vector<sim::Channel>& channels() const override { return channels_; }

  void initialize(const sim::Segment& first, double time_s, S* state) override;
  void begin_phase(const sim::Phase& phase, double time_s, S* state) override;
  void begin_segment(const sim::Segment& segment, double time_s, S* state, S* integrals) override;
  void evaluate(double time_s, const S* state, S* rates, S* integrands) override;
  void require_possible(const S* state) const override;
  S watch(const std::string& name, double time_s, const S* state) override;
  void observe(double time_s, const S* state, S* values) override;
  void calc_stored(double time_s, const S* state, S* stored_J) override;

  const models::Inflation<S>& inflation() const { return now_.inflation; }

 private:
  static constexpr std::size_t kSpeedState = 0;
  static constexpr std::size_t kFirstCornerState = 1;

  void find_motion(double time_s, const S* state);
  void fill_integrands(S* integrands) const;
  S calc_effective_mass_kg() const;
  S find_recorded_speed_m_s() const {
    return models::calc_recorded_speed_m_s(now_.motion.speed_m_s, now_.recorded, now_.acting);
  }
  S calc_mechanical_J() const;

  models::Corner<S>& corner_;
  DrumStart<S> start_;
  bool surface_recorded_;
  Detail detail_;
  std::vector<sim::Integral> integrals_;
  std::vector<sim::Store> stores_;
  std::vector<sim::Channel> channels_;

  sim::Segment segment_;
  double segment_start_s_ = 0.0;
  bool motor_on_ = true;
  models::Instant<S> now_;
  models::RollingWheel<S> wheel_;
  S drum_torque_Nm_{};
};

extern template class QuasiStaticDrum<double>;
extern template class QuasiStaticDrum<Jet>;

}  // namespace rollrig::rigs
