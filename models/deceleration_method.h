#pragma once
/// Rolling resistance from coast-downs of a drum, tire loaded and lifted.

namespace rollrig::models {

/// Decelerations at one speed, each of the surface: R |dw/dt| of the drum, R_r |dw/dt| of the wheel.
template <class S>
struct CoastDecelerations {
  S loaded_m_s2{};       // drum and tire together
  S drum_alone_m_s2{};   // tire lifted
  S wheel_alone_m_s2{};  // tire lifted
};

/// Rolling resistance per effective mass of the drum.
/// Equation  F_r = (I_D/R + R I_T/R_r^2) dw/dt - F_pl,  F_pl = I_D/R dw_D0/dt + I_T/R_r dw_T0/dt,
///           with a = R dw/dt (wheel alone: R_r dw_T0/dt), divided by I_D/R^2:
///           F_r/(I_D/R^2) = (1 + mu) a - a_D0 - mu a_T0
/// Symbols   I_D, I_T inertia of drum, and of tire, wheel and spindle [kg m^2]; R drum radius, R_r rolling
///           radius of the tire [m]; mu = (I_T/R_r^2)/(I_D/R^2) [1]; a decelerations at one speed [m/s^2]
/// Validity  no slip between tire and drum; losses of drum and wheel the same loaded and lifted. With mu = 0
///           the wheel's own bearing and air losses stay in F_r.
/// Source    deceleration method of ISO 28580 as in UN Regulation No. 117, Annex 6, F_pl of paragraph 5.1.5
/// Checked   tests/estimation/drum_coastdown_test.cpp
template <class S>
S calc_net_deceleration(const CoastDecelerations<S>& a, const S& mass_ratio) {
  return (S(1.0) + mass_ratio) * a.loaded_m_s2 - a.drum_alone_m_s2 - mass_ratio * a.wheel_alone_m_s2;
}

}  // namespace rollrig::models
