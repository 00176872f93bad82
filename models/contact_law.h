#pragma once
/// Forces between a wheel and the surface under it: radial spring and damper, longitudinal slip with a
/// deflection as its state.

#include "models/ports.h"

namespace rollrig::models {

template <class S>
struct ContactParameters {
  S vertical_N_per_m{};
  S vertical_damping_N_s_per_m{};
  S slip_spring_N_per_m{};     // k, slip stiffness per relaxation length
  S slip_damping_N_s_per_m{};  // d
  S relaxation_length_m{};
  S friction_coefficient{};
};

/// Normal force of a tire pressed in by `deflection_m`.
/// Equation  Fz = max(0, k_z delta + c_z d(delta)/dt) for delta > 0, else 0
/// Source    Assumed: linear spring and damper, hence r_l = D/2 - Fz/k_z at rest
template <class S>
S calc_normal_force_N(const ContactParameters<S>& p, const S& deflection_m, const S& deflection_rate_m_s) {
  if (value_of(deflection_m) <= 0.0) return quantity<S>(0.0, dimension::kForce);
  return positive_part(p.vertical_N_per_m * deflection_m + p.vertical_damping_N_s_per_m * deflection_rate_m_s);
}

/// Longitudinal force on the wheel, and what becomes of the deflection.
template <class S>
struct SlipForce {
  S deflection_rate_m_s{};
  S force_N{};
  S dissipated_W{};
};

/// Eighth-power mean of the rates at which rolling and sliding let the contact's deflection go; about the larger.
template <class S>
S calc_relaxation_per_s(const S& rolling_per_s, const S& sliding_per_s) {
  using std::pow;
  const bool rolls = value_of(rolling_per_s) > value_of(sliding_per_s);
  const S& larger_per_s = rolls ? rolling_per_s : sliding_per_s;
  if (value_of(larger_per_s) <= 0.0) return larger_per_s;
  const S ratio = (rolls ? sliding_per_s : rolling_per_s) / larger_per_s;
  return larger_per_s * pow(S(1.0) + pow(ratio, S(8.0)), S(0.125));
}

/// Force through the deflection u of the contact.
/// Equation  du/dt = V_s - r u, r = ((|V|/sigma)^8 + (|V_s| k/(mu Fz))^8)^(1/8);  Fx = k u + d g(V_s) du/dt;
///           g = 1/(1 + (V_s/V_0)^2);  dissipated: Fx V_s - k u du/dt
/// Symbols   V speed of the surface past the contact [m/s], V_s slip speed: of the surface over the tire
///           [m/s], sigma relaxation length [m], k spring [N/m], d damping [N s/m], mu friction
///           coefficient [1], Fz normal force [N], V_0 = 0.1 m/s
/// Validity  any speed, standstill as well; Fx = k sigma V_s/|V|, in proportion to the slip, to 1e-4 up to
///           0.4 mu Fz; |Fx| settles at mu Fz in full sliding; no force when lifted
/// Energy    never dissipates less than nothing while d g r <= 4 k
/// Source    single contact point with a relaxation length, usual in tire dynamics; damping gated as usual in LuGre
///           friction. Assumed: V_0, the power 8, so that a tire within its grip costs the Fx^2/C of effect slip_loss
/// Checked   tests/models/contact_law_test.cpp
template <class S>
SlipForce<S> calc_slip_force(const ContactParameters<S>& p, const S& speed_m_s, const S& slip_speed_m_s,
                             const S& normal_N, const S& deflection_m) {
  using std::abs;
  const S gate_m_s = quantity<S>(0.1, dimension::kSpeed);
  const S least_normal_N = quantity<S>(1.0, dimension::kForce);
  const S normal_or_least_N = normal_N > least_normal_N ? normal_N : least_normal_N;
  const S relaxation_per_s = calc_relaxation_per_s(
      S(abs(speed_m_s) / p.relaxation_length_m),
      S(abs(slip_speed_m_s) * p.slip_spring_N_per_m / (p.friction_coefficient * normal_or_least_N)));
  const S spring_N = p.slip_spring_N_per_m * deflection_m;
  SlipForce<S> slip;
  if (value_of(normal_N) <= 0.0) {  // lifted: the deflection springs back, and its energy is lost
    slip.deflection_rate_m_s = -relaxation_per_s * deflection_m;
    slip.force_N = quantity<S>(0.0, dimension::kForce);
    slip.dissipated_W = -spring_N * slip.deflection_rate_m_s;
    return slip;
  }
  const S slip_ratio = slip_speed_m_s / gate_m_s;
  const S damping_N_s_per_m = p.slip_damping_N_s_per_m / (S(1.0) + slip_ratio * slip_ratio);
  slip.deflection_rate_m_s = slip_speed_m_s - relaxation_per_s * deflection_m;
  slip.force_N = spring_N + damping_N_s_per_m * slip.deflection_rate_m_s;
  slip.dissipated_W = slip.force_N * slip_speed_m_s - spring_N * slip.deflection_rate_m_s;
  return slip;
}

/// Energy of a linear spring [J].
template <class S>
S calc_spring_J(const S& stiffness_N_per_m, const S& deflection_m) {
  return S(0.5) * stiffness_N_per_m * deflection_m * deflection_m;
}

/// Contact parameters of a tire. Without slip compliance the contact is as stiff in slip as the numerics
/// allow; with it (effect slip_loss), it has that stiffness and the tire's relaxation length.
/// Assumed: 2e7 N and 0.02 m in the stiff case (dissipation Fx^2/C is 0.05 N at 1 kN), critical damping
/// of the wheel's spin against the spring.
template <class S>
ContactParameters<S> make_contact_parameters(const TireParameters<S>& tire, const S& slip_compliance_per_N) {
  using std::sqrt;
  const bool stiff = value_of(slip_compliance_per_N) <= 0.0;
  ContactParameters<S> p;
  p.vertical_N_per_m = tire.stiffness.vertical_N_per_m;
  p.vertical_damping_N_s_per_m = tire.stiffness.vertical_damping_N_s_per_m;
  p.relaxation_length_m = stiff ? quantity<S>(0.02, dimension::kLength) : tire.stiffness.relaxation_length_m;
  const S stiffness_N = stiff ? quantity<S>(2e7, dimension::kForce) : S(1.0) / slip_compliance_per_N;
  p.slip_spring_N_per_m = stiffness_N / p.relaxation_length_m;
  const S spin_mass_kg = calc_spin_mass_kg(tire, S(tire.geometry.outer_diameter_m / S(2.0)));
  p.slip_damping_N_s_per_m = S(2.0) * sqrt(p.slip_spring_N_per_m * spin_mass_kg);
  p.friction_coefficient = tire.stiffness.friction_coefficient;
  return p;
}

}  // namespace rollrig::models
