#pragma once
/// One wheel that rolls in equilibrium on a drum, a roller or a flat surface: what every quasi-static rig takes its
/// wheels for, and by which the multibody ones record theirs.

#include "models/ports.h"

namespace rollrig::models {

/// Sum of the turning of wheel and surface, (w_wheel + w_surface) r_l, over the surface's speed, without slip.
/// Equation  1 + r_l k
/// Symbols   r_l loaded radius [m], k curvature of the surface [1/m], 0 of a flat one
template <class S>
S calc_rolling_ratio(const S& loaded_radius_m, const S& curvature_per_m) {
  return S(1.0) + loaded_radius_m * curvature_per_m;
}

/// Couple by which rolling resistance acts on wheel and surface, equal and opposite.
/// Equation  M = F_rr r_l / (1 + r_l k),  so that M (w_wheel + w_surface) = F_rr v without slip
/// Symbols   F_rr [N], r_l loaded radius [m], k curvature of the surface [1/m]
/// Source    power balance without slip: w_wheel = v/r_l, w_surface = v k, and all of F_rr v is heat ((3.8))
template <class S>
S calc_resistance_couple_Nm(const S& rolling_resistance_N, const S& loaded_radius_m, const S& curvature_per_m) {
  return rolling_resistance_N * loaded_radius_m / calc_rolling_ratio(loaded_radius_m, curvature_per_m);
}

/// Kinetic energy [J].
template <class S>
S calc_kinetic_J(const S& mass_kg, const S& speed_m_s) {
  return S(0.5) * mass_kg * speed_m_s * speed_m_s;
}

/// Energy in the spring of a tire that stands under a load, Fz^2/(2 k_z) [J].
template <class S>
S calc_tire_spring_J(const TireParameters<S>& tire, const S& load_N) {
  return S(0.5) * load_N * load_N / tire.stiffness.vertical_N_per_m;
}

/// What of a wheel does not depend on the force at its contact.
///
/// Equation  balance of its spin: X + D = F_rr/(1 + r_l k) + F_hub + I_spin a/(r_l^2 (1 - s));
///           slip s = X/C
/// Symbols   X force of the surface on the wheel, in the direction of the surface's motion; D force of the hub, torque
///           over r_l, positive when it drives; F_rr rolling resistance; F_hub loss in the hub's own bearings and
///           brake pads [N]; r_l loaded radius, which is the rolling radius as well [m]; k curvature of the surface
///           [1/m]; I_spin inertia of the wheel [kg m2]; a acceleration of the surface [m/s2]; C slip stiffness [N],
///           infinite in the baseline
/// Validity  |s| well below 1; load and speed change slowly against the tire's bounce and the wheel's spin
/// Source    the couple of rolling resistance; relaxation model of contact_law.h at rest
/// Checked   tests/models/rolling_wheel_test.cpp
template <class S>
struct RollingWheel {
  S loaded_radius_m{};
  S rolling_ratio{};    // 1 + r_l k
  S spin_mass_kg{};     // I_spin/r_l^2; none of a lifted wheel, which the surface does not turn
  S loss_at_wheel_N{};  // F_rr/(1 + r_l k); the rest of F_rr brakes the surface

  /// Equivalent mass of the spin as X feels it. X works at a rim that slip makes slower; the energy of the spin is
  /// that without slip.
  /// Equation  I_spin/(r_l^2 (1 - s))
  S calc_carried_mass_kg(const S& slip) const { return spin_mass_kg / (S(1.0) - slip); }

  /// X + D.
  S calc_balance_N(const S& hub_loss_N, const S& acceleration_m_s2, const S& slip) const {
    return loss_at_wheel_N + hub_loss_N + calc_carried_mass_kg(slip) * acceleration_m_s2;
  }
};

/// A wheel whose losses have been found (Corner::calc_losses).
template <class S>
RollingWheel<S> find_rolling_wheel(const Instant<S>& now) {
  const Context<S>& context = *now.context;
  const bool touches = value_of(now.motion.load_N) > 0.0;
  RollingWheel<S> wheel;
  wheel.loaded_radius_m = calc_loaded_radius_m(context.tire, now.motion.load_N);
  wheel.rolling_ratio = calc_rolling_ratio(wheel.loaded_radius_m, context.surface_curvature_per_m);
  wheel.spin_mass_kg = touches ? calc_spin_mass_kg(context.tire, wheel.loaded_radius_m) : zero<S>();
  wheel.loss_at_wheel_N = now.rolling_resistance_N / wheel.rolling_ratio;
  return wheel;
}

/// Slip of a wheel against its surface, positive when the surface drags it.
/// Equation  s = X/C
template <class S>
S calc_slip(const Instant<S>& now) {
  return now.motion.longitudinal_force_N * now.contact.slip_compliance_per_N;
}

/// What slip makes of a motion whose force at the contact is known.
/// Equation  power X s v; rolling resistance works over (w_wheel + w_surface) r_l/(1 + r_l k) = v (1 - s/(1 + r_l k))
template <class S>
void put_slip(const RollingWheel<S>& wheel, const S& slip, Motion<S>& motion) {
  motion.slip_power_W = motion.longitudinal_force_N * slip * motion.speed_m_s;
  motion.rolling_speed_m_s = motion.speed_m_s * (S(1.0) - slip / wheel.rolling_ratio);
}

/// Loss between hub and surface as a dynamometer measures it, which takes the nominal inertia of its roller off.
/// Equation  F_rr + F_par + P_slip/v + (j - 1) m_r a
/// Symbols   F_par parasitic loss [N], P_slip/v what slip costs [N], m_r equivalent mass of the machine [kg], j factor
///           on it (1 in the baseline), a acceleration of the surface [m/s2]
template <class S>
S calc_loss_force_N(const Instant<S>& now, const S& slip_loss_N, const S& acceleration_m_s2) {
  return now.rolling_resistance_N + now.parasitic_N + slip_loss_N +
         (now.contact.machine_inertia_factor - S(1.0)) * now.context->machine_mass_kg * acceleration_m_s2;
}

}  // namespace rollrig::models
