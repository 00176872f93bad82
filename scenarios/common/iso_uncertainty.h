#pragma once
/// The coefficient of an ISO 28580 test as a measurement, for its uncertainty.

#include <functional>
#include <optional>
#include <vector>

#include "estimation/uncertainty/measurement_model.h"
#include "scenarios/common/iso_methods.h"
#include "scenarios/common/readings.h"

namespace rollrig::scenarios {

/// Accuracies of the instruments, half-widths of rectangular distributions, as their certificates have them. What is
/// absent is assumed.
struct IsoAccuracies {
  std::optional<double> gain;
  std::optional<double> load;
  std::optional<double> drum_diameter_m;
  std::optional<double> ambient_K;
  std::optional<double> speed_m_s;
  std::optional<double> pressure_Pa;
  std::optional<double> force_cell_angle_rad;
  std::optional<double> inertia;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"gain_accuracy_percent", between(0.0, 50.0),
                "Half-width of the gain error of torque, force or power (default 0.5, assumed) or, of the deceleration "
                "method, of dv/dt (default 0.1, assumed)"},
          p.gain);
    visit(Field{"load_accuracy_percent", between(0.0, 50.0), "Likewise of the load. Default: 0.5, assumed"}, p.load);
    visit(Field{"drum_diameter_accuracy_m", between(0.0, 1.0), "Likewise. Default: 0.001, assumed"}, p.drum_diameter_m);
    visit(Field{"ambient_accuracy_K", between(0.0, 20.0), "Likewise of the air temperature. Default: 0.2, assumed"},
          p.ambient_K);
    visit(Field{"speed_accuracy_km_h", between(0.0, 20.0), "Likewise. Default: 0.1, assumed"}, p.speed_m_s);
    visit(Field{"pressure_accuracy_kPa", between(0.0, 100.0),
                "Likewise of the pressure as set. Default: by the sensor of the cavity pressure, else 1, assumed"},
          p.pressure_Pa);
    visit(Field{"force_cell_angle_accuracy_mrad", between(0.0, 20.0),
                "Of the force method: +- of the angle of the force cell to the load. Default: 0.05, assumed"},
          p.force_cell_angle_rad);
    visit(Field{"inertia_accuracy_percent", between(0.0, 50.0),
                "Of the deceleration method: +- of the inertias of drum and wheel. Default: 0.5, assumed"},
          p.inertia);
  }
};

/// F_r of the test at another speed [m/s] and another cold pressure [Pa], without errors of sensors.
using IsoSimulation = std::function<double(double speed_m_s, double pressure_Pa)>;

/// RRc of the last cycle by the method of the readings, corrected to 25 degC and the 2 m drum, as correct_rrc() has it,
/// and RRc as measured.
/// Equation  RRc = F_r/L K_r(R) (1 + K_t (T_amb - 25 degC)),  F_r = (1 + g) [c_t (X_t + e + o) - c_s (X_s + o)] q(v, p);
///           torque        c = 1/R
///           force         c = 1 + r/R, and L sin d is added to X
///           power         c = 1/v, v in proportion to R
///           deceleration  c = (1 + i) (I_D/R^2 + I_T/r^2) R/R_0
/// Symbols   indices t, s: loaded and in the skim test; X reading: torque [Nm], of a belt force [N] with R = 1, force of
///           the spindle [N], power [W], deceleration [m/s2]; o zero of both readings, which cancels where c_t = c_s; g
///           relative error of their gain; e error of their difference from noise, drift and resolution, or from cycle
///           to cycle; L load [N]; v speed [m/s]; R radius of the drum [m], R_0 that of the rig's file, by which a
///           speed was found; r loaded radius [m]; d angle of the force cell to the load [rad]; I_D, I_T inertias of
///           drum, and of tire and wheel [kg m2], i their relative error; q(v, p) = F_r(v, p)/F_r(v_0, p_0), by
///           simulation in second order; K_r, K_t of correct_rrc()
/// Validity  errors of instruments, not of the procedure: a tire that is not warm is in `unsettled`
/// Source    the equations of readings.h. Uncertainties: `accuracies`, sensors of the run, else usual ones of the
///           machine, else "Assumed", which the budget marks
/// Checked   tests/scenarios/iso_uncertainty_test.cpp
/// `cycles` are those of evaluate_by_method().
estimation::MeasurementModel make_iso_model(const RunSpec& spec, const std::vector<Cycle>& cycles,
                                            const MethodReadings& readings, double pressure_Pa,
                                            const IsoAccuracies& accuracies, const IsoSimulation& simulate);

}  // namespace rollrig::scenarios
